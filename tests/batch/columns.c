// SPDX-License-Identifier: Apache-2.0
#include "batch/columns.h"

#include "support/near.h"
#include <bicycle/error.h>

void columns_solve(columns *c, const bike_model *models, size_t model_count,
                   const bike_state *states, size_t count, size_t offset) {
  assert_true(count + offset <= COLUMNS_MOST + 1);
  for (size_t i = 0; i < count; i++) {
    const double s[5] = {states[i].lean, states[i].steer, states[i].lean_rate, states[i].steer_rate,
                         states[i].speed};
    for (int k = 0; k < 5; k++) c->state[k][i + offset] = s[k];
  }
  for (size_t i = 0; i < count; i++) c->codes[i] = -1;
  bike_batch *batch;
  assert_int_equal(bike_batch_create(&batch, models, model_count), BIKE_OK);
  bike_batch_states in = {c->state[0] + offset, c->state[1] + offset, c->state[2] + offset,
                          c->state[3] + offset, c->state[4] + offset};
  bike_batch_accelerations out = {c->out[0] + offset, c->out[1] + offset, c->out[2] + offset,
                                  c->codes};
  int code = bike_batch_accelerate(&out, batch, &in, count);
  bike_batch_free(batch);
  assert_int_equal(code, BIKE_OK);
}

bike_acceleration columns_result(const columns *c, size_t i, size_t offset) {
  return (bike_acceleration){.lean = c->out[0][i + offset],
                             .steer = c->out[1][i + offset],
                             .speed = c->out[2][i + offset]};
}
