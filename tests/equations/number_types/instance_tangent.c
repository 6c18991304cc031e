// SPDX-License-Identifier: Apache-2.0
#define LANES 4
#define SLOPES 1
#include "equations/number_tangent.h"

#include "slopes.h"

_Static_assert((int)TANGENT_POINTS == LANES, "the test fills every lane");

void slopes_by_tangent(slope_result out[TANGENT_POINTS], const bike_model *model,
                       const jacobian_points *points, int which) {
  kernel_model m;
  kernel_model_of(&m, model);
  real x[JACOBIAN_ARGUMENTS];
  for (int i = 0; i < JACOBIAN_ARGUMENTS; i++) {
    x[i] = real_of(i == which);
    x[i].slope[0] = x[i].value;
    for (int lane = 0; lane < LANES; lane++) x[i].value[lane] = points->at[i][lane];
  }
  form u = {x[AT_STEER_RATE], x[AT_LEAN_RATE], x[AT_SPEED]};
  load in = {x[AT_STEER_TORQUE], x[AT_ROLL_TORQUE], x[AT_RIDER_OFFSET], x[AT_RIDER_VELOCITY],
             x[AT_RIDER_ACCELERATION]};
  instant now;
  solve_instant(&now, &m, guessed(&m, x[AT_STEER], x[AT_LEAN]), x[AT_STEER], x[AT_LEAN], u, &in);
  energy e = energy_of(&now, &m, &in);
  form a = now.acceleration;
  ground f = ground_forces(&now, &m, &in);
  real total = tangent_add(e.kinetic, e.potential);
  real all[SLOPE_RESULTS] = {a.phi, a.kap, a.v, total, now.at.s_br, f.rear.x, f.rear.y, f.rear.z};
  for (int lane = 0; lane < LANES; lane++)
    for (int i = 0; i < SLOPE_RESULTS; i++) {
      out[lane].value[i] = all[i].value[lane];
      out[lane].slope[i] = all[i].slope[0][lane];
    }
}
