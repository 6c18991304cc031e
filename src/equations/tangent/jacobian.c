// SPDX-License-Identifier: Apache-2.0
#include "equations/tangent/jacobian.h"

#include "equations/regular.h"

static jacobian_pass *const passes[] = {
    [INSTRUCTIONS_BASELINE] = jacobian_pass_baseline,
#ifdef BICYCLE_X86_64_LEVELS
    [INSTRUCTIONS_V3] = jacobian_pass_v3,
    [INSTRUCTIONS_V4] = jacobian_pass_v4,
#endif
};

// Every argument and every result.
static bool finite_point(const jacobian *out, const jacobian_points *points, int i) {
  double sum = out->energy[i];
  for (int k = 0; k < JACOBIAN_ARGUMENTS; k++) sum += points->at[k][i];
  for (int k = 0; k < JACOBIAN_VARIABLES; k++) sum += out->energy_slope[k][i];
  for (int a = 0; a < JACOBIAN_ACCELERATIONS; a++) {
    sum += out->acceleration[a][i];
    for (int k = 0; k < JACOBIAN_DIRECTIONS; k++) sum += out->slope[a][k][i];
  }
  return isfinite(sum);
}

_Static_assert(sizeof(checks) == JACOBIAN_CHECKS * sizeof(double), "a row for each");

static int judged_point(const jacobian *out, const bike_model *model, const jacobian_points *points,
                        int i) {
  if (!finite_point(out, points, i)) return BIKE_ERROR_NOT_FINITE;
  checks c;
  double *each = (double *)&c;
  const jacobian_row *row = (const jacobian_row *)&out->checks;
  for (int k = 0; k < JACOBIAN_CHECKS; k++) each[k] = row[k][i];
  return judged(&c, model);
}

void jacobian_at(jacobian *out, jacobian_codes codes, const bike_model *model,
                 const jacobian_points *points) {
  passes[instruction_set_in_use()](out, model, points);
  for (int i = 0; i < JACOBIAN_POINTS; i++) codes[i] = judged_point(out, model, points, i);
}
