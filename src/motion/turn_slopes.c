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

// A place, and what stands there.
typedef struct turn_kernels {
  kernel_model heavy, weightless;
  double rear[2];        // sin, cos of beta_r
  real at[TURN_COLUMNS]; // lean, steer, offset; one of them perturbed
  double held;           // v^2 or v^2 sin(steer)
} turn_kernels;

typedef void column_function(real out[TURN_ROWS], const turn_kernels *k);

static void forces(real out[TURN_ROWS], const turn_kernels *k, const kernel_model *model,
                   real steer, double speed) {
  forces_at_rest(out, model, k->rear, steer, k->at[BY_LEAN], k->at[BY_OFFSET], speed);
}

static void at_speed(real out[TURN_ROWS], const turn_kernels *k) {
  if (k->held >= 0) {
    forces(out, k, &k->heavy, k->at[BY_STEER], sqrt(k->held));
    return;
  }
  real swing[TURN_ROWS];
  forces(out, k, &k->heavy, k->at[BY_STEER], 0);
  forces(swing, k, &k->weightless, k->at[BY_STEER], 1);
  for (int i = 0; i < TURN_ROWS; i++) out[i] += k->held * swing[i];
}

static void at_swept(real out[TURN_ROWS], const turn_kernels *k) {
  real steer = k->at[BY_STEER], swing[TURN_ROWS];
  forces(out, k, &k->heavy, steer, 0);
  if (fabs(creal(steer)) < SMALLEST_STEER) steer = SMALLEST_STEER + I * cimag(steer);
  forces(swing, k, &k->weightless, steer, 1);
  for (int i = 0; i < TURN_ROWS; i++) out[i] += k->held * (swing[i] / csin(steer));
}

static int columns(turn_slopes *slopes, const turn_bicycle *b, column_function *function,
                   const double at[TURN_COLUMNS], double held) {
  turn_kernels k = {.held = held};
  int code = turn_rear_angle(k.rear, b->model, at[BY_LEAN], at[BY_STEER]);
  if (code) return code;
  kernel_model_of(&k.heavy, b->model);
  kernel_model_of(&k.weightless, &b->weightless);
  for (int j = 0; j < TURN_COLUMNS; j++) {
    if (!slopes->wanted[j]) continue;
    for (int n = 0; n < TURN_COLUMNS; n++) k.at[n] = at[n];
    k.at[j] += I * STEP;
    real f[TURN_ROWS];
    function(f, &k);
    for (int i = 0; i < TURN_ROWS; i++) slopes->of[i][j] = cimag(f[i]) / STEP * b->per_inertia[i];
  }
  return BIKE_OK;
}

int turn_slopes_at_speed(turn_slopes *slopes, const turn_bicycle *bicycle, double lean,
                         double steer, double offset, double square) {
  const double at[TURN_COLUMNS] = {lean, steer, offset};
  return columns(slopes, bicycle, at_speed, at, square);
}

int turn_slopes_at_swept(turn_slopes *slopes, const turn_bicycle *bicycle, double lean,
                         double steer, double offset, double swept) {
  const double at[TURN_COLUMNS] = {lean, steer, offset};
  return columns(slopes, bicycle, at_swept, at, swept);
}
