// SPDX-License-Identifier: Apache-2.0
#include "motion/effects_parameters.h"

#include <stdio.h>

typedef enum member {
  WHEELBASE,
  TRAIL,
  TILT,
  REAR_RADIUS,
  FRONT_RADIUS,
  GRAVITY,
  DAMPING,
  MASS, // from here on of a part
  FORWARD,
  UP,
  AXIAL,     // of a wheel, about its hub
  DIAMETRAL, // of a wheel, Ixx = Izz
  XX,
  YY,
  ZZ,
  XZ
} member;

typedef struct entry {
  member what;
  int part; // -1: none
} entry;

static const char *const names[] = {
    "wheelbase", "trail", "tilt", "rear radius", "front radius", "gravity", "steer damping", "mass",
    "forward",   "up",    "Iyy",  "Ixx = Izz",   "Ixx",          "Iyy",     "Izz",           "Ixz"};
static const char *const units[] = {"m",         "m",      "rad",    "m",     "m",      "m/s^2",
                                    "N m s/rad", "kg",     "m",      "m",     "kg m^2", "kg m^2",
                                    "kg m^2",    "kg m^2", "kg m^2", "kg m^2"};

static const member of_frame[] = {MASS, FORWARD, UP, XX, YY, ZZ, XZ};
static const member of_wheel[] = {MASS, AXIAL, DIAMETRAL};
enum { FRAME_COUNT = 7, WHEEL_COUNT = 3 };

// Parts of bike_from_meijaard.
enum { PART_B, PART_R, PART_H, PART_F };

// In the order of bike_meijaard_symbols, the damper after them.
static const entry literature_list[BIKE_MEIJAARD_COUNT + 1] = {
    {WHEELBASE, -1},     {TRAIL, -1},     {TILT, -1},          {GRAVITY, -1},
    {REAR_RADIUS, -1},   {MASS, PART_R},  {DIAMETRAL, PART_R}, {AXIAL, PART_R},
    {FORWARD, PART_B},   {UP, PART_B},    {MASS, PART_B},      {XX, PART_B},
    {YY, PART_B},        {ZZ, PART_B},    {XZ, PART_B},        {FORWARD, PART_H},
    {UP, PART_H},        {MASS, PART_H},  {XX, PART_H},        {YY, PART_H},
    {ZZ, PART_H},        {XZ, PART_H},    {FRONT_RADIUS, -1},  {MASS, PART_F},
    {DIAMETRAL, PART_F}, {AXIAL, PART_F}, {DAMPING, -1}};

static bool is_wheel(const vary_part *part) {
  return part->assembly == BIKE_REAR_WHEEL || part->assembly == BIKE_FRONT_WHEEL;
}

// False beyond the end of the list.
static bool find_entry(entry *out, const vary_bicycle *b, int index, bool literature) {
  if (literature) {
    if (index > BIKE_MEIJAARD_COUNT) return false;
    *out = literature_list[index];
    return true;
  }
  if (index < BIKE_FRAME_PARAMETERS) {
    *out = (entry){(member)index, -1};
    return true;
  }
  index -= BIKE_FRAME_PARAMETERS;
  for (int i = 0; i < b->part_count; i++) {
    bool wheel = is_wheel(&b->parts[i]);
    int count = wheel ? WHEEL_COUNT : FRAME_COUNT;
    if (index < count) {
      *out = (entry){wheel ? of_wheel[index] : of_frame[index], i};
      return true;
    }
    index -= count;
  }
  return false;
}

static number *frame_place(vary_bicycle *b, member what) {
  number *const places[] = {&b->wheelbase, &b->trail,   &b->tilt,         &b->R_r,
                            &b->R_f,       &b->gravity, &b->steer_damping};
  return places[what];
}

static number *part_place(vary_part *p, member what) {
  static const int tensor[] = {[AXIAL - AXIAL] = 1, [DIAMETRAL - AXIAL] = 0, [XX - AXIAL] = 0,
                               [YY - AXIAL] = 1,    [ZZ - AXIAL] = 2,        [XZ - AXIAL] = 4};
  if (what == MASS) return &p->mass;
  if (what == FORWARD) return &p->x;
  if (what == UP) return &p->up;
  return &p->inertia[tensor[what - AXIAL]];
}

// The literature's z axis points down: heights and products change their sign.
static double sign_of(const entry *e, bool literature) {
  return literature && (e->what == UP || e->what == XZ) ? -1 : 1;
}

// A wheel's hub follows the lengths; its tensor stays symmetric about the hub axis.
static void keep_wheels(vary_bicycle *b, const entry *e) {
  if (e->what == DIAMETRAL) b->parts[e->part].inertia[2] = b->parts[e->part].inertia[0];
  for (int i = 0; i < b->part_count; i++) {
    vary_part *p = &b->parts[i];
    if (p->assembly == BIKE_FRONT_WHEEL) {
      p->x = b->wheelbase;
      p->up = b->R_f;
    }
    if (p->assembly == BIKE_REAR_WHEEL) p->up = b->R_r;
  }
}

void parameters_add(vary_bicycle *b, int index, bool literature, number change) {
  entry e;
  if (!find_entry(&e, b, index, literature)) return;
  number *place = e.part < 0 ? frame_place(b, e.what) : part_place(&b->parts[e.part], e.what);
  *place += sign_of(&e, literature) * change;
  keep_wheels(b, &e);
}

static void name_parameter(bike_parameter *out, const entry *e, const bike_bicycle *bicycle) {
  if (e->part < 0)
    snprintf(out->name, sizeof out->name, "%s", names[e->what]);
  else
    snprintf(out->name, sizeof out->name, "%s: %s", bicycle->parts[e->part].name, names[e->what]);
}

int parameters_list(bike_parameter *out, const bike_bicycle *bicycle,
                    const bike_meijaard *literature) {
  vary_bicycle b;
  entry e;
  int count = 0;
  if (vary_read(&b, bicycle)) return 0;
  for (; find_entry(&e, &b, count, literature != NULL); count++) {
    bike_parameter *p = &out[count];
    const number *place =
        e.part < 0 ? frame_place(&b, e.what) : part_place(&b.parts[e.part], e.what);
    *p = (bike_parameter){.unit = units[e.what],
                          .value = sign_of(&e, literature != NULL) * creal(*place)};
    name_parameter(p, &e, bicycle);
    if (!literature || count >= BIKE_MEIJAARD_COUNT) continue;
    snprintf(p->name, sizeof p->name, "%s", bike_meijaard_symbols()[count]);
    p->value = literature->value[count];
    p->sigma = literature->sigma[count];
  }
  return count;
}
