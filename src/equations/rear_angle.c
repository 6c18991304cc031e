// SPDX-License-Identifier: Apache-2.0
#include "equations/rear_angle.h"

#include <bicycle/error.h>

// The straight line is first tried in steps of this share, halved where Newton's method does not
// follow: an eighth of 60 deg is followed at once on the shipped bicycles.
static const double FIRST_STEP = 0.125;
// Roots closer to the end of the branch than this share of the line are not told from none.
static const double SMALLEST_STEP = 1e-9;

int rear_angle_continued(start *out, const bike_model *model, double phi, double kappa) {
  start from = begun(model, model->s_tilt, model->c_tilt);
  double reached = 0, step = FIRST_STEP;
  while (reached < 1) {
    double next = fmin(1, reached + step);
    position g;
    locate(&g, &model->geometry, from, next * phi, next * kappa);
    if (rear_angle_found(root_checks_of(&g), model)) {
      from = begun(model, g.s_br, g.c_br);
      reached = next;
    } else if ((step *= 0.5) < SMALLEST_STEP) {
      return BIKE_ERROR_GEOMETRY;
    }
  }
  *out = from;
  return BIKE_OK;
}
