// SPDX-License-Identifier: Apache-2.0
#include "batch/lanes_block.h"
#include "batch/lanes_instance.h"

void INSTANCE(lanes_pack)(lanes_models *block, const bike_model *model, int lane) {
  kernel_model one;
  kernel_model_of(&one, model); // nothing but `real`s
  real *to = (real *)&block->model;
  const real *from = (const real *)&one;
  for (size_t i = 0; i < sizeof one / sizeof(real); i++) to[i][lane] = from[i][lane];
  block->reach[lane] = model->reach;
}

// What the scalar path judges as singular is left to it.
static inline lanes_mask regular(const instant *now, real reach) {
  const double least = 64 * 2.220446049250313e-16; // as there
  const kane *k = &now->k;
  return (lanes_abs(now->at.D) > least * reach) & (k->pivot[0] > 0.0 * reach) &
         (k->pivot[1] > least * k->M[1]) & (k->pivot[2] > least * k->M[0]);
}

__attribute__((flatten)) unsigned
INSTANCE(lanes_accelerate)(double *const out[LANES_ACCELERATIONS], const lanes_models *block,
                           const double *const state[LANES_STATE]) {
  const kernel_model *m = &block->model;
  real phi = loaded(state[LANES_STEER]), kappa = loaded(state[LANES_LEAN]), nought = phi - phi;
  form u = {loaded(state[LANES_STEER_RATE]), loaded(state[LANES_LEAN_RATE]),
            loaded(state[LANES_SPEED])};
  load hands_off = {nought, nought, nought, nought, nought};
  instant now;
  solve_instant(&now, m, guessed(m, phi, kappa), phi, kappa, u, &hands_off);
  form a = now.acceleration;
  memcpy(out[LANES_LEAN_ACC], &a.kap, sizeof a.kap);
  memcpy(out[LANES_STEER_ACC], &a.phi, sizeof a.phi);
  memcpy(out[LANES_SPEED_RATE], &a.v, sizeof a.v);
  real sum = a.phi + a.kap + a.v; // not less itself where it is not finite
  return lanes_bits(lanes_found(&now.at, block->reach) & regular(&now, block->reach) &
                    (sum - sum == nought));
}
