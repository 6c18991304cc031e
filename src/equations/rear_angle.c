// SPDX-License-Identifier: Apache-2.0
#include "equations/rear_angle.h"

#include <bicycle/error.h>

// The straight line is followed in steps of at most this share, halved where Newton's method does
// not follow and doubled after two that it did: an eighth of 60 deg is followed at once on the
// shipped bicycles.
static const double LARGEST_STEP = 0.125;
// Roots closer to the end of the branch than this share of the line are not told from none.
static const double SMALLEST_STEP = 1e-9;

// Turns of an angle that are whole change no posture.
static double within_half_turn(double angle) {
  return remainder(angle, 6.283185307179586);
}

int rear_angle_continued(start *out, const bike_model *model, double phi, double kappa) {
  double to_phi = within_half_turn(phi), to_kappa = within_half_turn(kappa);
  start from = begun(model, model->s_tilt, model->c_tilt);
  double reached = 0, step = LARGEST_STEP;
  bool followed = true;
  for (int n = 0; n < REAR_ANGLE_MOST_STEPS && step >= SMALLEST_STEP; n++) {
    double next = fmin(1, reached + step);
    position g;
    locate(&g, &model->geometry, from, next * to_phi, next * to_kappa);
    bool found = rear_angle_found(root_checks_of(&g), model);
    if (found) {
      from = begun(model, g.s_br, g.c_br);
      reached = next;
      if (followed) step = fmin(2 * step, LARGEST_STEP);
    } else {
      step *= 0.5;
    }
    followed = found;
    if (reached >= 1) {
      *out = from;
      return BIKE_OK;
    }
  }
  return BIKE_ERROR_GEOMETRY;
}
