// SPDX-License-Identifier: Apache-2.0
// From parts to two rigid bodies, once.
#include <bicycle/error.h>
#include <bicycle/model.h>
#include <math.h>
#include <string.h>

#include "equations/upright_axes.h"

// Adds m (|r|^2 1 - r r^T) to J = (xx, yy, zz, xy, xz, yz).
static void add_steiner(double J[6], double m, const double r[3]) {
  J[0] += m * (r[1] * r[1] + r[2] * r[2]);
  J[1] += m * (r[0] * r[0] + r[2] * r[2]);
  J[2] += m * (r[0] * r[0] + r[1] * r[1]);
  J[3] -= m * r[0] * r[1];
  J[4] -= m * r[0] * r[2];
  J[5] -= m * r[1] * r[2];
}

static bool belongs(const bike_part *part, bool front) {
  bool part_is_front = part->assembly == BIKE_FRONT_FRAME || part->assembly == BIKE_FRONT_WHEEL;
  return part_is_front == front;
}

// A wheel's axial inertia (about N, its hub axis) is kept apart: it spins.
static void add_tensor(bike_body *body, const bike_part *part, const upright_axes *axes) {
  double J[6];
  upright_tensor(J, axes, part->inertia);
  if (part->assembly == BIKE_REAR_WHEEL || part->assembly == BIKE_FRONT_WHEEL) {
    body->spin_inertia += part->inertia[1];
    J[0] = J[3] = J[4] = 0;
  }
  for (int i = 0; i < 6; i++) body->inertia[i] += J[i];
}

static void lump(bike_body *body, const bike_bicycle *bicycle, const upright_axes *axes,
                 bool front) {
  memset(body, 0, sizeof *body);
  for (int i = 0; i < bicycle->part_count; i++) {
    const bike_part *part = &bicycle->parts[i];
    if (!belongs(part, front)) continue;
    double r[3];
    upright_place(r, axes, part->position, front);
    body->mass += part->mass;
    for (int k = 0; k < 3; k++) body->moment[k] += part->mass * r[k];
    add_steiner(body->inertia, part->mass, r);
    add_tensor(body, part, axes);
  }
  for (int k = 0; k < 3; k++) body->centre[k] = body->moment[k] / body->mass;
}

static void find_rider(bike_model *model, const bike_bicycle *bicycle, const upright_axes *axes) {
  for (int i = 0; i < bicycle->part_count; i++) {
    const bike_part *part = &bicycle->parts[i];
    if (!part->rider) continue;
    model->rider_mass = part->mass;
    upright_place(model->rider_place, axes, part->position, false);
  }
}

int bike_model_init(bike_model *out, const bike_bicycle *bicycle) {
  if (!out || !bicycle) return BIKE_ERROR_ARGUMENT;
  int code = bike_check(bicycle, NULL, NULL);
  if (code) return code;
  bike_upright upright;
  code = bike_upright_position(&upright, &bicycle->geometry);
  if (code) return code;

  upright_axes axes = upright_axes_of(&bicycle->geometry, &upright);
  bike_model model = {.geometry = bicycle->geometry,
                      .gravity = bicycle->gravity,
                      .steer_damping = bicycle->steer_damping,
                      .tilt = upright.tilt,
                      .s_tilt = axes.s,
                      .c_tilt = axes.c,
                      .tilt_gain = upright.trail * axes.c / upright.wheelbase,
                      .newton_scale = 1 / sqrt(2 * upright.wheelbase),
                      .over_R_r = 1 / bicycle->geometry.R_r,
                      .over_R_f = 1 / bicycle->geometry.R_f};
  model.reach = geometry_reach(&bicycle->geometry);
  lump(&model.rear, bicycle, &axes, false);
  lump(&model.front, bicycle, &axes, true);
  find_rider(&model, bicycle, &axes);
  model.total_mass = model.rear.mass + model.front.mass;
  *out = model;
  return BIKE_OK;
}
