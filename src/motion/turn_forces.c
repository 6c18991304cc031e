// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_forces.h"

#include <bicycle/error.h>

#include "equations/number_double.h"
#include "equations/rear_angle.h"
#include "motion/turn_kernel.h"

turn_bicycle turn_bicycle_of(const bike_model *model) {
  turn_bicycle b = {.model = model, .still = *model, .weightless = *model};
  b.weightless.gravity = 0;
  return b;
}

int turn_rear_angle(double out[2], const bike_model *model, double lean, double steer) {
  start from = {sin(model->tilt), cos(model->tilt)};
  position at;
  locate(&at, &model->geometry, from, steer, lean);
  if (!rear_angle_found(&at)) {
    int code = rear_angle_continued(&from, model, steer, lean);
    if (code) return code;
    locate(&at, &model->geometry, from, steer, lean);
    if (!rear_angle_found(&at)) return BIKE_ERROR_GEOMETRY;
  }
  out[0] = at.s_br;
  out[1] = at.c_br;
  return BIKE_OK;
}

int turn_forces_at(turn_forces *out, const turn_bicycle *b, double lean, double steer,
                   double offset) {
  double rear[2];
  int code = turn_rear_angle(rear, b->model, lean, steer);
  if (code) return code;
  start from = {rear[0], rear[1]};
  forces_at_rest(out->fall, &b->still, from, steer, lean, offset, 0);
  // at straight riding the quotient is the limit: the forces of a steer too small to bend anything
  const double straight = 1e-100;
  double phi = fabs(steer) > straight ? steer : straight;
  forces_at_rest(out->sweep, &b->weightless, from, phi, lean, offset, 1);
  for (int i = 0; i < TURN_ROWS; i++) out->sweep[i] /= sin(phi);
  return BIKE_OK;
}
