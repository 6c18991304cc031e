// SPDX-License-Identifier: Apache-2.0
#include "motion/variant_complex.h"

#include <bicycle/error.h>
#include <string.h>

static bool is_wheel(const vary_part *part) {
  return part->assembly == BIKE_REAR_WHEEL || part->assembly == BIKE_FRONT_WHEEL;
}

static void place_wheels(vary_bicycle *b) {
  for (int i = 0; i < b->part_count; i++) {
    vary_part *p = &b->parts[i];
    if (!is_wheel(p)) continue;
    bool front = p->assembly == BIKE_FRONT_WHEEL;
    p->x = front ? b->wheelbase : 0;
    p->up = front ? b->R_f : b->R_r;
  }
}

int vary_read(vary_bicycle *out, const bike_bicycle *bicycle) {
  bike_upright upright;
  int code = bike_upright_position(&upright, &bicycle->geometry);
  if (code) return code;
  *out = (vary_bicycle){.wheelbase = upright.wheelbase,
                        .trail = upright.trail,
                        .tilt = upright.tilt,
                        .R_r = bicycle->geometry.R_r,
                        .R_f = bicycle->geometry.R_f,
                        .gravity = bicycle->gravity,
                        .steer_damping = bicycle->steer_damping,
                        .part_count = bicycle->part_count};
  for (int i = 0; i < bicycle->part_count; i++) {
    const bike_part *p = &bicycle->parts[i];
    vary_part *q = &out->parts[i];
    *q = (vary_part){p->assembly, p->rider, p->mass, p->position[0], p->position[2], {0}};
    for (int k = 0; k < 6; k++) q->inertia[k] = p->inertia[k];
  }
  place_wheels(out);
  return BIKE_OK;
}

void vary_write(bike_bicycle *inout, const vary_bicycle *from) {
  inout->geometry =
      bike_geometry_from_wheelbase(creal(from->wheelbase), creal(from->trail), creal(from->tilt),
                                   creal(from->R_r), creal(from->R_f));
  inout->gravity = creal(from->gravity);
  inout->steer_damping = creal(from->steer_damping);
  for (int i = 0; i < from->part_count; i++) {
    const vary_part *p = &from->parts[i];
    bike_part *q = &inout->parts[i];
    q->mass = creal(p->mass);
    q->position[0] = creal(p->x);
    q->position[2] = creal(p->up);
    for (int k = 0; k < 6; k++) q->inertia[k] = creal(p->inertia[k]);
  }
}

// Spin inertia of the wheels of one side.
static number spin(const vary_bicycle *b, bike_assembly wheel) {
  number sum = 0;
  for (int i = 0; i < b->part_count; i++)
    if (b->parts[i].assembly == wheel) sum += b->parts[i].inertia[1];
  return sum;
}

// e_S . I e_S of the front frame's parts, each about its own centre; e_S = (-sin, 0, cos) of tilt.
static number steering_inertia(const vary_bicycle *b) {
  number s = csin(b->tilt), c = ccos(b->tilt), sum = 0;
  for (int i = 0; i < b->part_count; i++) {
    const number *J = b->parts[i].inertia;
    if (b->parts[i].assembly == BIKE_FRONT_FRAME)
      sum += s * s * J[0] + c * c * J[2] - 2 * s * c * J[4];
  }
  return sum;
}

static vary_part *find_rider(vary_bicycle *b) {
  for (int i = 0; i < b->part_count; i++)
    if (b->parts[i].rider) return &b->parts[i];
  return NULL;
}

static vary_part *find_front_frame(vary_bicycle *b) {
  for (int i = 0; i < b->part_count; i++)
    if (b->parts[i].assembly == BIKE_FRONT_FRAME) return &b->parts[i];
  return NULL;
}

int vary_value(number *out, const vary_bicycle *b, bike_variation variation) {
  vary_bicycle copy = *b;
  switch (variation) {
  case BIKE_VARY_TRAIL:
    *out = b->trail;
    return BIKE_OK;
  case BIKE_VARY_HEAD_ANGLE:
    *out = 0.5 * 3.14159265358979323846 - b->tilt;
    return BIKE_OK;
  case BIKE_VARY_WHEEL_INERTIA:
  case BIKE_VARY_FRONT_WHEEL_INERTIA:
    *out = spin(b, BIKE_FRONT_WHEEL);
    return creal(*out) > 0 ? BIKE_OK : BIKE_ERROR_PARAMETER;
  case BIKE_VARY_STEERING_INERTIA:
    *out = steering_inertia(b);
    return find_front_frame(&copy) ? BIKE_OK : BIKE_ERROR_PARAMETER;
  case BIKE_VARY_RIDER_FORWARD:
    *out = 0;
    return find_rider(&copy) ? BIKE_OK : BIKE_ERROR_NO_RIDER;
  case BIKE_VARY_STEER_DAMPING:
    *out = b->steer_damping;
    return BIKE_OK;
  default:
    return BIKE_ERROR_ARGUMENT;
  }
}

static void scale_spin(vary_bicycle *b, bike_assembly wheel, number factor) {
  for (int i = 0; i < b->part_count; i++)
    if (b->parts[i].assembly == wheel) b->parts[i].inertia[1] *= factor;
}

// Where the steering axis is: it meets the ground at x, and the perpendicular from the front hub
// meets it at foot_height along it.
typedef struct axis_place {
  number s, c, x, foot_height;
} axis_place;

static axis_place axis_of(const vary_bicycle *b) {
  number s = csin(b->tilt), c = ccos(b->tilt);
  // the hub seen from the axis' point on the ground, along e_S = (-s, c)
  return (axis_place){s, c, b->wheelbase + b->trail, b->trail * s + b->R_f * c};
}

// A tensor turned by the angle (s, c) from forward to up.
static void turn_tensor(number J[6], number s, number c) {
  number ff = J[0], uu = J[2], fl = J[3], fu = J[4], lu = J[5];
  J[0] = c * c * ff + s * s * uu - 2 * s * c * fu;
  J[2] = s * s * ff + c * c * uu + 2 * s * c * fu;
  J[4] = s * c * (ff - uu) + (c * c - s * s) * fu;
  J[3] = c * fl - s * lu;
  J[5] = s * fl + c * lu;
}

// The front frame's parts go with the steering axis from one place to another.
static void carry_front(vary_bicycle *b, const axis_place *from, const axis_place *to) {
  for (int i = 0; i < b->part_count; i++) {
    vary_part *p = &b->parts[i];
    if (p->assembly != BIKE_FRONT_FRAME) continue;
    number forward = p->x - from->x;
    number across = forward * from->c + p->up * from->s;
    number along = p->up * from->c - forward * from->s - from->foot_height + to->foot_height;
    p->x = to->x + across * to->c - along * to->s;
    p->up = across * to->s + along * to->c;
    turn_tensor(p->inertia, to->s * from->c - to->c * from->s, to->c * from->c + to->s * from->s);
  }
}

static void move_axis(vary_bicycle *b, bike_variation variation, number change,
                      bike_front_hold hold) {
  axis_place from = axis_of(b);
  if (variation == BIKE_VARY_TRAIL)
    b->trail += change;
  else
    b->tilt -= change;
  axis_place to = axis_of(b);
  if (hold == BIKE_FRONT_ON_AXIS) carry_front(b, &from, &to);
}

// Adds an inertia about the steering axis alone: T e_S e_S^T.
static void add_about_axis(vary_part *part, number tilt, number T) {
  number s = csin(tilt), c = ccos(tilt);
  part->inertia[0] += T * s * s;
  part->inertia[2] += T * c * c;
  part->inertia[4] -= T * s * c;
}

int vary_apply(vary_bicycle *b, bike_variation variation, number value, bike_front_hold hold) {
  number now;
  int code = vary_value(&now, b, variation);
  if (code) return code;
  switch (variation) {
  case BIKE_VARY_WHEEL_INERTIA:
    scale_spin(b, BIKE_REAR_WHEEL, value / now);
    scale_spin(b, BIKE_FRONT_WHEEL, value / now);
    break;
  case BIKE_VARY_FRONT_WHEEL_INERTIA:
    scale_spin(b, BIKE_FRONT_WHEEL, value / now);
    break;
  case BIKE_VARY_STEERING_INERTIA:
    add_about_axis(find_front_frame(b), b->tilt, value - now);
    break;
  case BIKE_VARY_RIDER_FORWARD:
    find_rider(b)->x += value;
    break;
  case BIKE_VARY_STEER_DAMPING:
    b->steer_damping = value;
    break;
  default:
    move_axis(b, variation, value - now, hold);
  }
  return BIKE_OK;
}
