// SPDX-License-Identifier: Apache-2.0
#include "engine_differences.h"

#include <string.h>

// The state's numbers in the order of A.
static double *number_of(bike_state *s, int index) {
  double *numbers[4] = {&s->steer, &s->lean, &s->steer_rate, &s->lean_rate};
  return numbers[index];
}

// Steering and leaning accelerations at upright riding with one number off by `step`.
static term_exit accelerate(double out[2], const engine *e, void *instance, double speed, int index,
                            double step, problem *p) {
  bike_state state = {.speed = speed};
  engine_instant at;
  *number_of(&state, index) = step;
  term_exit code = e->evaluate(&at, instance, &state, p);
  if (code != TERM_DONE) return code;
  out[0] = at.steer_acceleration;
  out[1] = at.lean_acceleration;
  return TERM_DONE;
}

term_exit engine_differences(double A[16], const engine *e, void *instance, double speed,
                             problem *p) {
  // f'(0) = sum of c_k (f(k h) - f(-k h))/h with an error of h^8 f^(9)/630. Where f becomes
  // singular an angle r away (0.3 rad for a trail as long as the wheelbase), that is some 600
  // (h/r)^8 of f'/r: with h = 0.01 rad 1e-9 there and 1e-14 on the shipped bicycles, beside the
  // engine's rounding of 1e-15 divided by h. In the rates f is of second degree, so that any h
  // does.
  static const double weight[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  static const double h = 0.01;
  memset(A, 0, 16 * sizeof *A);
  A[2] = A[7] = 1; // steer' and lean' are the rates
  for (int column = 0; column < 4; column++)
    for (int k = 0; k < 4; k++)
      for (int sign = -1; sign <= 1; sign += 2) {
        double a[2];
        term_exit code = accelerate(a, e, instance, speed, column, sign * (k + 1) * h, p);
        if (code != TERM_DONE) return code;
        A[8 + column] += sign * weight[k] * a[0] / h;
        A[12 + column] += sign * weight[k] * a[1] / h;
      }
  return TERM_DONE;
}
