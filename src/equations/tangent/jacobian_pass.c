// SPDX-License-Identifier: Apache-2.0
// One pass over the points, LANES at a time. Under -ffinite-math-only: what is not finite is judged
// in jacobian.c.
#include <string.h>

#define SLOPES 8
#include "equations/number_tangent.h"
#include "equations/tangent/jacobian.h"

_Static_assert(SLOPES == JACOBIAN_DIRECTIONS, "a slope for each direction");

LANE_INLINE void put(jacobian_row row, int first, lanes x) {
  memcpy(row + first, &x, sizeof x);
}

LANE_INLINE void put_slopes(jacobian_row rows[SLOPES], int first,
                            real x){EACH_SLOPE(put(rows[j], first, x.slope[j]))}

LANE_INLINE real argument(const jacobian_points *points, int first, int which) {
  lanes x;
  memcpy(&x, points->at[which] + first, sizeof x);
  return which < SLOPES ? tangent_variable(x, which) : tangent_constant(x);
}

_Static_assert(sizeof(checks) == JACOBIAN_CHECKS * sizeof(real), "a row for each");

LANE_INLINE void put_checks(jacobian_checks *out, int first, const instant *now) {
  checks all = checks_of(now);
  jacobian_row *row = (jacobian_row *)out;
  const real *each = (const real *)&all;
  for (int i = 0; i < JACOBIAN_CHECKS; i++) put(row[i], first, each[i].value);
}

LANE_INLINE void put_energy(jacobian *out, int first, energy e) {
  real sum = tangent_add(e.kinetic, e.potential);
  put(out->energy, first, sum.value);
  EACH_SLOPE(if (j < (int)JACOBIAN_VARIABLES) put(out->energy_slope[j], first, sum.slope[j]))
}

LANE_INLINE void pass_lanes(jacobian *out, int first, const kernel_model *m,
                            const jacobian_points *p) {
  real phi = argument(p, first, AT_STEER), kappa = argument(p, first, AT_LEAN);
  form u = {argument(p, first, AT_STEER_RATE), argument(p, first, AT_LEAN_RATE),
            argument(p, first, AT_SPEED)};
  load in = {argument(p, first, AT_STEER_TORQUE), argument(p, first, AT_ROLL_TORQUE),
             argument(p, first, AT_RIDER_OFFSET), argument(p, first, AT_RIDER_VELOCITY),
             argument(p, first, AT_RIDER_ACCELERATION)};
  instant now;
  solve_instant(&now, m, guessed(m, phi, kappa), phi, kappa, u, &in);
  form a = now.acceleration;
  put(out->acceleration[OF_STEER], first, a.phi.value);
  put(out->acceleration[OF_LEAN], first, a.kap.value);
  put(out->acceleration[OF_SPEED], first, a.v.value);
  put_slopes(out->slope[OF_STEER], first, a.phi);
  put_slopes(out->slope[OF_LEAN], first, a.kap);
  put_slopes(out->slope[OF_SPEED], first, a.v);
  put_energy(out, first, energy_of(&now, m, &in));
  put_checks(&out->checks, first, &now);
}

void INSTANCE(jacobian_pass)(jacobian *out, const bike_model *model,
                             const jacobian_points *points) {
  for (int first = 0; first < JACOBIAN_POINTS; first += LANES) {
    kernel_model m; // here, so that its slopes are seen to be zero
    kernel_model_of(&m, model);
    pass_lanes(out, first, &m, points);
  }
}
