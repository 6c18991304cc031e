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

// Told by the bits: this file is compiled as if there were nothing but finite numbers.
static inline lanes_mask is_finite(real x) {
  const int64_t exponent = INT64_C(0x7ff) << 52;
  return ((lanes_mask)x & exponent) != exponent;
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
  real phi = loaded(state[LANES_STEER]), kappa = loaded(state[LANES_LEAN]);
  form u = {loaded(state[LANES_STEER_RATE]), loaded(state[LANES_LEAN_RATE]),
            loaded(state[LANES_SPEED])};
  const load hands_off = {{0}, {0}, {0}, {0}, {0}}; // what it does not move costs nothing
  instant now;
  solve_instant(&now, m, guessed(m, phi, kappa), phi, kappa, u, &hands_off);
  form a = now.acceleration;
  memcpy(out[LANES_LEAN_ACC], &a.kap, sizeof a.kap);
  memcpy(out[LANES_STEER_ACC], &a.phi, sizeof a.phi);
  memcpy(out[LANES_SPEED_RATE], &a.v, sizeof a.v);
  return lanes_bits(lanes_found(&now.at, block->reach) & regular(&now, block->reach) &
                    is_finite(a.phi) & is_finite(a.kap) & is_finite(a.v));
}
