// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_forces.h"

#include <bicycle/error.h>
#include <bicycle/state.h>

#include "equations/number_double.h"
#include "equations/rear_angle.h"
#include "motion/turn_kernel.h"

int turn_bicycle_init(turn_bicycle *out, const bike_model *model, double torque) {
  bike_state standing = {0};
  double mass[9];
  int code = bike_mass_matrix(mass, model, &standing, 0);
  if (code) return code;
  *out = (turn_bicycle){.model = model, .weightless = *model, .torque = torque};
  out->weightless.gravity = 0;
  out->per_inertia[TURN_LEAN_ROW] = 1 / mass[0];
  out->per_inertia[TURN_STEER_ROW] = 1 / mass[4];
  return BIKE_OK;
}

int turn_rear_angle(double out[2], const bike_model *model, double lean, double steer) {
  start from = guessed(model, steer, lean);
  position at;
  locate(&at, &model->geometry, from, steer, lean);
  if (!rear_angle_found(root_checks_of(&at), model)) {
    int code = rear_angle_continued(&from, model, steer, lean);
    if (code) return code;
    locate(&at, &model->geometry, from, steer, lean);
    if (!rear_angle_found(root_checks_of(&at), model)) return BIKE_ERROR_GEOMETRY;
  }
  // the yaw rate's denominator (13): where it vanishes the bicycle turns on the spot, and beyond
  // there is no way from riding
  if (!(at.D > 0)) return BIKE_ERROR_GEOMETRY;
  out[0] = at.s_br;
  out[1] = at.c_br;
  return BIKE_OK;
}

int turn_forces_at(turn_forces *out, const turn_bicycle *b, double lean, double steer,
                   double offset) {
  double rear[2];
  int code = turn_rear_angle(rear, b->model, lean, steer);
  if (code) return code;
  forces_at_rest(out->fall, b->model, rear, steer, lean, offset, 0);
  // at straight riding the quotient is the limit: the forces of a steer too small to bend anything
  const double straight = 1e-100;
  double phi = fabs(steer) > straight ? steer : straight;
  forces_at_rest(out->sweep, &b->weightless, rear, phi, lean, offset, 1);
  out->fall[TURN_STEER_ROW] += b->torque;
  for (int i = 0; i < TURN_ROWS; i++) {
    out->fall[i] *= b->per_inertia[i];
    out->sweep[i] *= b->per_inertia[i] / sin(phi);
  }
  return BIKE_OK;
}
