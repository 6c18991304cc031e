// SPDX-License-Identifier: Apache-2.0
// Upright position of a bicycle, and the rules that its description must obey.
#include <bicycle/bicycle.h>
#include <bicycle/error.h>
#include <math.h>
#include <string.h>

#include "equations/upright_axes.h"

// m  of a wheelbase and of a wheel's radius, whose reciprocals the equations hold; and of both as
// shares of the bicycle's reach, and of the cosine of the tilt: below, roundings of the longest
// length decide where the wheels stand.
static const double SMALLEST_LENGTH = 1 / BIKE_LARGEST, SMALLEST_SHARE = 1e-9;

bike_bicycle bike_default_bicycle(void) {
  return (bike_bicycle){.gravity = 9.81};
}

bike_geometry bike_geometry_from_wheelbase(double wheelbase, double trail, double tilt, double R_r,
                                           double R_f) {
  double s = sin(tilt), c = cos(tilt);
  // (6) and (5) solved for L_r, L_f; (4) upright for L_s
  bike_geometry g = {.R_r = R_r, .R_f = R_f};
  g.L_r = (wheelbase + trail) * c - R_r * s;
  g.L_f = R_f * s - trail * c;
  g.L_s = (g.L_r + g.L_f) * (s / c) + (R_r - R_f) / c;
  return g;
}

int bike_upright_position(bike_upright *out, const bike_geometry *g) {
  if (!out || !g) return BIKE_ERROR_ARGUMENT;
  double length = g->L_r + g->L_f, difference = g->R_r - g->R_f;
  double span = hypot(length, g->L_s);
  if (!isfinite(span) || !isfinite(difference)) return BIKE_ERROR_NOT_FINITE;
  if (!(fabs(difference) < span)) return BIKE_ERROR_IMPOSSIBLE;
  // (4) with phi = kappa = 0
  double tilt = atan2(g->L_s, length) - asin(difference / span);
  double s = sin(tilt), c = cos(tilt), t = s / c;
  // the wheels stand below their hubs, the front one before the rear one
  if (!(c > SMALLEST_SHARE)) return BIKE_ERROR_IMPOSSIBLE;
  double trail = g->R_f * t - g->L_f / c, axis_ground = g->L_r / c + g->R_r * t;
  double wheelbase = axis_ground - trail;
  if (!(wheelbase >= SMALLEST_LENGTH && wheelbase > SMALLEST_SHARE * geometry_reach(g)))
    return BIKE_ERROR_IMPOSSIBLE;
  double foot_height = g->L_r * t + g->R_r / c - g->L_s;
  if (!isfinite(wheelbase + trail + axis_ground + foot_height)) return BIKE_ERROR_NOT_FINITE;
  *out = (bike_upright){.tilt = tilt,
                        .wheelbase = wheelbase,
                        .trail = trail,
                        .axis_ground = axis_ground,
                        .foot_height = foot_height,
                        .rear_hub = {0, 0, g->R_r},
                        .front_hub = {wheelbase, 0, g->R_f}};
  return BIKE_OK;
}

// NaN is not.
static bool within(double most, const double *a, int n) {
  for (int i = 0; i < n; i++)
    if (!(fabs(a[i]) <= most)) return false;
  return true;
}

// Rank-1 tensors and tensors turned into these axes carry rounding of their largest entry; 64 of
// it is well above what a turn costs and well below what a person writes.
static const double ROUNDING = 64 * 2.220446049250313e-16;

static double largest_of(const double I[6]) {
  double largest = 0;
  for (int i = 0; i < 6; i++) largest = fmax(largest, fabs(I[i]));
  return largest;
}

// All principal minors of the tensor, in units of its largest entry, not negative.
static bool positive_semidefinite(const double inertia[6]) {
  double I[6], largest = largest_of(inertia), e = ROUNDING;
  for (int i = 0; i < 6; i++) I[i] = largest > 0 ? inertia[i] / largest : 0;
  double scale = fmax(fmax(fabs(I[0]), fabs(I[1])), fabs(I[2]));
  if (I[0] < -e || I[1] < -e || I[2] < -e) return false;
  double xy = I[0] * I[1] - I[3] * I[3], xz = I[0] * I[2] - I[4] * I[4];
  double yz = I[1] * I[2] - I[5] * I[5];
  if (xy < -e * scale || xz < -e * scale || yz < -e * scale) return false;
  double det = I[0] * yz - I[3] * (I[3] * I[2] - I[4] * I[5]) + I[4] * (I[3] * I[5] - I[4] * I[1]);
  return det >= -e * scale * scale;
}

static const char *broken_wheel_rule(const bike_part *part, const double hub[3]) {
  const double *I = part->inertia;
  double e = ROUNDING * largest_of(I);
  if (fabs(I[0] - I[2]) > e || fabs(I[3]) > e || fabs(I[4]) > e || fabs(I[5]) > e)
    return "inertia of a wheel must be symmetric about its hub axis: Ixx = Izz, products zero";
  // a nanometre: rounding of any sensible length, far below any real offset
  for (int k = 0; k < 3; k++)
    if (fabs(part->position[k] - hub[k]) > 1e-9) return "position of a wheel must be its hub";
  return NULL;
}

static const char *broken_part_rule(const bike_part *part, const bike_upright *upright) {
  if (!part->name[0] || !memchr(part->name, 0, BIKE_NAME_SIZE)) return "name must not be empty";
  if (part->assembly < BIKE_REAR_FRAME || part->assembly > BIKE_FRONT_WHEEL)
    return "assembly is unknown";
  if (!(part->mass > 0)) return "mass must be positive";
  if (!positive_semidefinite(part->inertia)) return "inertia must be positive semidefinite";
  if (part->rider && part->assembly != BIKE_REAR_FRAME) return "rider must sit on the rear frame";
  if (part->assembly == BIKE_REAR_WHEEL) return broken_wheel_rule(part, upright->rear_hub);
  if (part->assembly == BIKE_FRONT_WHEEL) return broken_wheel_rule(part, upright->front_hub);
  return NULL;
}

static const char *broken_bicycle_rule(const bike_bicycle *b) {
  if (!(b->geometry.R_r > 0) || !(b->geometry.R_f > 0)) return "wheel radius must be positive";
  double smaller = fmin(b->geometry.R_r, b->geometry.R_f);
  if (smaller < SMALLEST_LENGTH || smaller < SMALLEST_SHARE * geometry_reach(&b->geometry))
    return "wheel radius must be at least 1e-20 m, and a billionth of the bicycle's lengths";
  if (!(b->gravity > 0)) return "gravity must be positive";
  if (!(b->steer_damping >= 0)) return "steer_damping must not be negative";
  if (b->part_count < 1 || b->part_count > BIKE_MAX_PARTS) return "number of parts out of range";
  return NULL;
}

static bool all_within_range(const bike_bicycle *b, int *part) {
  const bike_geometry *g = &b->geometry;
  double own[] = {g->L_r, g->L_f, g->L_s, g->R_r, g->R_f, b->gravity, b->steer_damping};
  *part = -1;
  if (!within(BIKE_LARGEST, own, (int)(sizeof own / sizeof own[0]))) return false;
  for (int i = 0; i < b->part_count && i < BIKE_MAX_PARTS; i++) {
    const bike_part *p = &b->parts[i];
    *part = i;
    if (!within(BIKE_LARGEST, &p->mass, 1) || !within(BIKE_LARGEST, p->position, 3) ||
        !within(BIKE_LARGEST * BIKE_LARGEST, p->inertia, 6))
      return false;
  }
  *part = -1;
  return true;
}

// Rules between parts: both frames have mass, one rider at most, names differ.
static const char *broken_common_rule(const bike_bicycle *b, int *part) {
  bool rear = false, front = false, rider = false;
  for (int i = 0; i < b->part_count; i++) {
    const bike_part *p = &b->parts[i];
    *part = i;
    for (int k = 0; k < i; k++)
      if (!strcmp(p->name, b->parts[k].name)) return "name is used twice";
    if (p->rider && rider) return "rider is given twice";
    rider = rider || p->rider;
    rear = rear || p->assembly == BIKE_REAR_FRAME || p->assembly == BIKE_REAR_WHEEL;
    front = front || p->assembly == BIKE_FRONT_FRAME || p->assembly == BIKE_FRONT_WHEEL;
  }
  *part = -1;
  if (!rear || !front) return "both the rear and the front need a part with mass";
  return NULL;
}

int bike_check(const bike_bicycle *bicycle, int *part, const char **what) {
  int where = -1;
  const char *rule = NULL;
  if (!bicycle) return BIKE_ERROR_ARGUMENT;
  int code = BIKE_OK;
  bike_upright upright;
  if (!all_within_range(bicycle, &where)) {
    code = BIKE_ERROR_NOT_FINITE;
    rule = "numbers must be finite and at most 1e20, inertias 1e40";
  } else if ((rule = broken_bicycle_rule(bicycle))) {
    code = BIKE_ERROR_PARAMETER;
  } else if ((code = bike_upright_position(&upright, &bicycle->geometry))) {
    rule = "the wheels must be able to stand on the ground, the front one before the rear one";
  } else {
    for (int i = 0; i < bicycle->part_count && !rule; i++) {
      rule = broken_part_rule(&bicycle->parts[i], &upright);
      where = rule ? i : -1;
    }
    if (!rule) rule = broken_common_rule(bicycle, &where);
    if (rule) code = BIKE_ERROR_PARAMETER;
  }
  if (part) *part = where;
  if (what) *what = rule;
  return code;
}
