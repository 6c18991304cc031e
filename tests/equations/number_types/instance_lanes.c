// SPDX-License-Identifier: Apache-2.0
#include "equations/number_lanes.h"

#include "gather.h"
#include <stddef.h>

_Static_assert((int)INSTANCE_LANES % (int)LANES == 0, "the test fills every lane");

// Copies one bicycle into lane `lane`: a model is nothing but `real`s.
static void put_model(kernel_model *all, const bike_model *model, int lane) {
  kernel_model one;
  kernel_model_of(&one, model);
  real *to = (real *)all;
  const real *from = (const real *)&one;
  for (size_t i = 0; i < sizeof one / sizeof(real); i++) to[i][lane] = from[i][lane];
}

static void run_some(instance_result out[LANES], const bike_model model[LANES],
                     const bike_state state[LANES], const bike_input input[LANES]) {
  kernel_model m = {0};
  real phi = real_of(0), kappa = phi;
  form u = {phi, phi, phi};
  load in = {phi, phi, phi, phi, phi};
  for (int i = 0; i < LANES; i++) {
    put_model(&m, &model[i], i);
    phi[i] = state[i].steer;
    kappa[i] = state[i].lean;
    u.phi[i] = state[i].steer_rate;
    u.kap[i] = state[i].lean_rate;
    u.v[i] = state[i].speed;
    in.steer_torque[i] = input[i].steer_torque;
    in.roll_torque[i] = input[i].roll_torque;
    in.w[i] = input[i].rider_offset;
    in.w1[i] = input[i].rider_velocity;
    in.w2[i] = input[i].rider_acceleration;
  }
  start from = guessed(&m, phi, kappa);
  instant now;
  solve_instant(&now, &m, from, phi, kappa, u, &in);
  real all[INSTANCE_RESULTS];
  gather(all, &now, &m, &in);
  for (int i = 0; i < LANES; i++)
    for (int k = 0; k < INSTANCE_RESULTS; k++) out[i].value[k] = all[k][i];
}

void run_lanes(instance_result out[INSTANCE_LANES], const bike_model model[INSTANCE_LANES],
               const bike_state state[INSTANCE_LANES], const bike_input input[INSTANCE_LANES]) {
  for (int i = 0; i < INSTANCE_LANES; i += LANES)
    run_some(&out[i], &model[i], &state[i], &input[i]);
}
