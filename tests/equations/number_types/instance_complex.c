// SPDX-License-Identifier: Apache-2.0
#include "equations/number_complex.h"

#include "gather.h"

void run_complex(instance_result *out, const bike_model *model, const bike_state *state,
                 const bike_input *input) {
  kernel_model m;
  kernel_model_of(&m, model);
  start from = guessed(&m, state->steer, state->lean);
  form u = {state->steer_rate, state->lean_rate, state->speed};
  load in = {input->steer_torque, input->roll_torque, input->rider_offset, input->rider_velocity,
             input->rider_acceleration};
  instant now;
  solve_instant(&now, &m, from, state->steer, state->lean, u, &in);
  real all[INSTANCE_RESULTS];
  gather(all, &now, &m, &in);
  for (int i = 0; i < INSTANCE_RESULTS; i++) out->value[i] = creal(all[i]);
}
