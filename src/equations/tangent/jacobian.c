// SPDX-License-Identifier: Apache-2.0
#include "equations/tangent/jacobian.h"

#include "equations/regular.h"

#include <bicycle/state.h>

static jacobian_pass *const passes[] = {
    [INSTRUCTIONS_BASELINE] = jacobian_pass_baseline,
#ifdef BICYCLE_X86_64_LEVELS
    [INSTRUCTIONS_V3] = jacobian_pass_v3,
    [INSTRUCTIONS_V4] = jacobian_pass_v4,
#endif
};

static bool within_range(const jacobian_points *points, int i) {
  bool all = true;
  for (int k = 0; k < JACOBIAN_ARGUMENTS; k++) {
    bool angle = k == AT_STEER || k == AT_LEAN;
    all &= fabs(points->at[k][i]) <= (angle ? BIKE_LARGEST_ANGLE : BIKE_LARGEST);
  }
  return all;
}

// Every result.
static bool finite_point(const jacobian *out, int i) {
  double sum = out->energy[i];
  for (int k = 0; k < JACOBIAN_VARIABLES; k++) sum += out->energy_slope[k][i];
  for (int a = 0; a < JACOBIAN_ACCELERATIONS; a++) {
    sum += out->acceleration[a][i];
    for (int k = 0; k < JACOBIAN_DIRECTIONS; k++) sum += out->slope[a][k][i];
  }
  return isfinite(sum);
}

_Static_assert(sizeof(checks) == JACOBIAN_CHECKS * sizeof(double), "a row for each");

// So far within the limits of `judged` a point is answered here.
static const double CLEAR = 2;

static int judged_point(const jacobian *out, const bike_model *model, const jacobian_points *points,
                        int i) {
  if (!within_range(points, i) || !finite_point(out, i)) return BIKE_ERROR_NOT_FINITE;
  checks c;
  double *each = (double *)&c;
  const jacobian_row *row = (const jacobian_row *)&out->checks;
  for (int k = 0; k < JACOBIAN_CHECKS; k++) each[k] = row[k][i];
  // at the limits roundings decide, and the scalar kernel has others
  c.root.residual *= CLEAR;
  c.D /= CLEAR;
  c.pivot_kap /= CLEAR;
  c.pivot_phi /= CLEAR;
  return judged(&c, model);
}

void jacobian_at(jacobian *out, jacobian_codes codes, const bike_model *model,
                 const jacobian_points *points) {
  passes[instruction_set_in_use()](out, model, points);
  for (int i = 0; i < JACOBIAN_POINTS; i++) codes[i] = judged_point(out, model, points, i);
}
