// SPDX-License-Identifier: Apache-2.0
#include "equations/tangent/jacobian.h"

#include <bicycle/error.h>

#include "equations/rear_angle.h"
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

static int judged(const jacobian *out, const bike_model *model, const jacobian_points *points,
                  int i) {
  if (!finite_point(out, points, i)) return BIKE_ERROR_NOT_FINITE;
  const jacobian_checks *c = &out->checks;
  position g = {.residual = c->residual[i],
                .Q = c->Q[i],
                .D = c->D[i],
                .c_br = c->c_br[i],
                .c_kap = c->c_kap[i],
                .c_psi = c->c_psi[i]};
  kane k = {.pivot = {c->pivot[0][i], c->pivot[1][i], c->pivot[2][i]},
            .M = {c->diagonal[0][i], c->diagonal[1][i]}};
  if (!rear_angle_found(&g, model)) return BIKE_ERROR_GEOMETRY;
  return yaw_determined(&g, model) && regular(&k) ? BIKE_OK : BIKE_ERROR_SINGULAR;
}

void jacobian_at(jacobian *out, jacobian_codes codes, const bike_model *model,
                 const jacobian_points *points) {
  passes[instruction_set_in_use()](out, model, points);
  for (int i = 0; i < JACOBIAN_POINTS; i++) codes[i] = judged(out, model, points, i);
}
