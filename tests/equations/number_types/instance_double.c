// SPDX-License-Identifier: Apache-2.0
#include "equations/number_double.h"

#include "gather.h"

void run_double(instance_result *out, const bike_model *model, const bike_state *state,
                const bike_input *input) {
  start from = guessed(model, state->steer, state->lean);
  form u = {state->steer_rate, state->lean_rate, state->speed};
  load in = {input->steer_torque, input->roll_torque, input->rider_offset, input->rider_velocity,
             input->rider_acceleration};
  instant now;
  solve_instant(&now, model, from, state->steer, state->lean, u, &in);
  gather(out->value, &now, model, &in);
}
