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

// At the limits roundings decide, and the scalar kernel has others. The roundings of a pivot are
// those of the terms of the mass matrix' entries, which may cancel: of the bodies' inertias.
static bool clear_of_limits(checks c, const bike_model *model) {
  const double rounding = 64 * DBL_EPSILON, margin = 64;
  const double *rear = model->rear.inertia, *front = model->front.inertia;
  double lost = margin * rounding * (rear[0] + rear[1] + rear[2] + front[0] + front[1] + front[2]);
  if (!(c.pivot_kap > lost && c.pivot_phi > lost)) return false;
  c.root.residual *= 2; // a rounding or two
  c.D /= margin;
  c.pivot_kap /= margin;
  c.pivot_phi /= margin;
  return judged(&c, model) == BIKE_OK;
}

static int judged_point(const jacobian *out, const bike_model *model, const jacobian_points *points,
                        int i) {
  if (!within_range(points, i) || !finite_point(out, i)) return BIKE_ERROR_NOT_FINITE;
  checks c;
  double *each = (double *)&c;
  const jacobian_row *row = (const jacobian_row *)&out->checks;
  for (int k = 0; k < JACOBIAN_CHECKS; k++) each[k] = row[k][i];
  int code = judged(&c, model);
  if (code) return code;
  return clear_of_limits(c, model) ? BIKE_OK : BIKE_ERROR_SINGULAR;
}

void jacobian_at(jacobian *out, jacobian_codes codes, const bike_model *model,
                 const jacobian_points *points) {
  passes[instruction_set_in_use()](out, model, points);
  for (int i = 0; i < JACOBIAN_POINTS; i++) codes[i] = judged_point(out, model, points, i);
}
