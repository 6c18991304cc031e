// SPDX-License-Identifier: Apache-2.0
#include <bicycle/error.h>
#include <math.h>

#include "equations/number_complex.h"
#include "motion/turn_forces.h"
#include "motion/turn_kernel.h"

static const double STEP = 1e-100; // leaves the real parts untouched

// d/dphi of f/sin(phi) cancels where phi is small: to this share of the value at the floor. It is
// multiplied by v^2 sin(phi), which then is as small.
static const double SMALLEST_STEER = 1e-8;

// One column: the imaginary parts of the forces at perturbed arguments.
static void column(turn_forces *out, const kernel_model *still, const kernel_model *weightless,
                   start from, real lean, real steer, real offset) {
  real fall[TURN_ROWS], sweep[TURN_ROWS];
  forces_at_rest(fall, still, from, steer, lean, offset, 0);
  real phi = fabs(creal(steer)) < SMALLEST_STEER ? SMALLEST_STEER + I * cimag(steer) : steer;
  forces_at_rest(sweep, weightless, from, phi, lean, offset, 1);
  for (int i = 0; i < TURN_ROWS; i++) {
    out->fall[i] = cimag(fall[i]) / STEP;
    out->sweep[i] = cimag(sweep[i] / csin(phi)) / STEP;
  }
}

int turn_slopes_at(turn_slopes *out, const turn_bicycle *b, double lean, double steer,
                   double offset) {
  double rear[2];
  int code = turn_rear_angle(rear, b->model, lean, steer);
  if (code) return code;
  kernel_model still, weightless;
  kernel_model_of(&still, &b->still);
  kernel_model_of(&weightless, &b->weightless);
  start from = {rear[0], rear[1]};
  real step = I * STEP;
  column(&out->lean, &still, &weightless, from, lean + step, steer, offset);
  column(&out->steer, &still, &weightless, from, lean, steer + step, offset);
  column(&out->offset, &still, &weightless, from, lean, steer, offset + step);
  return BIKE_OK;
}
