// SPDX-License-Identifier: Apache-2.0
#include "equations/number_complex.h"

#include "slopes.h"

// So small that the real parts do not feel it.
static const double STEP = 1e-100;

void slope_by_step(slope_result *out, const bike_model *model, const double at[JACOBIAN_ARGUMENTS],
                   double beta_r, int which) {
  kernel_model m;
  kernel_model_of(&m, model);
  real x[JACOBIAN_ARGUMENTS];
  for (int i = 0; i < JACOBIAN_ARGUMENTS; i++) x[i] = at[i];
  x[which] += I * STEP;
  form u = {x[AT_STEER_RATE], x[AT_LEAN_RATE], x[AT_SPEED]};
  load in = {x[AT_STEER_TORQUE], x[AT_ROLL_TORQUE], x[AT_RIDER_OFFSET], x[AT_RIDER_VELOCITY],
             x[AT_RIDER_ACCELERATION]};
  instant now;
  solve_known(&now, &m, sin(beta_r), cos(beta_r), x[AT_STEER], x[AT_LEAN], u, &in);
  energy e = energy_of(&now, &m, &in);
  form a = now.acceleration;
  ground f = ground_forces(&now, &m, &in);
  real all[SLOPE_RESULTS] = {a.phi,       a.kap,    a.v,      e.kinetic + e.potential,
                             now.at.s_br, f.rear.x, f.rear.y, f.rear.z};
  for (int i = 0; i < SLOPE_RESULTS; i++) {
    out->value[i] = creal(all[i]);
    out->slope[i] = cimag(all[i]) / STEP;
  }
}
