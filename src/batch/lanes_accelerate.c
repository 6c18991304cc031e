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

// The states of one block.
typedef struct column_view {
  const double *const *state;
  int first;
} column_view;

static inline real column(const column_view *v, int which) {
  return loaded(v->state[which] + v->first);
}

// Nothing near the ends of the range, which are the scalar path's to judge.
static inline lanes_mask ordinary(column_view v) {
  real speeds = lanes_abs(column(&v, LANES_LEAN_RATE)) + lanes_abs(column(&v, LANES_STEER_RATE)) +
                lanes_abs(column(&v, LANES_SPEED));
  real angles = lanes_abs(column(&v, LANES_LEAN)) + lanes_abs(column(&v, LANES_STEER));
  real nought = speeds - speeds;
  return (speeds <= BIKE_LARGEST + nought) & (angles <= BIKE_LARGEST_ANGLE + nought);
}

// What the scalar path judges as singular is left to it.
static inline lanes_mask regular(const checks *c, real reach) {
  const double least = 64 * 2.220446049250313e-16; // as there
  return (lanes_abs(c->D) > least * reach) & (c->pivot_v > 0.0 * reach) &
         (c->pivot_kap > least * c->diagonal_kap) & (c->pivot_phi > least * c->diagonal_phi);
}

// Three passes over a few blocks: sines and cosines, Newton's method, the rest. The first two wait
// for themselves most of the time, so that several blocks must be in work at once; with the rest
// between, the processor would not see as far as the next one. Worth a sixth of the time.
__attribute__((noinline, flatten)) static void find_sines(posture *out, column_view v) {
  real_sincos(column(&v, LANES_STEER), &out->s_phi, &out->c_phi);
  real_sincos(column(&v, LANES_LEAN), &out->s_kap, &out->c_kap);
}

__attribute__((noinline, flatten)) static void find_rear_angle(posture *out, const kernel_model *m,
                                                               column_view v) {
  start from = guessed(m, column(&v, LANES_STEER), column(&v, LANES_LEAN));
  solve_rear_angle(out, &m->geometry, from);
}

static inline void put(double *to, real x) {
  memcpy(to, &x, sizeof x);
}

// Bit i of the result: lane i is solved.
__attribute__((noinline, flatten)) static unsigned finish(double *const out[LANES_ACCELERATIONS],
                                                          const lanes_models *block,
                                                          const posture *at, column_view v) {
  form u = {column(&v, LANES_STEER_RATE), column(&v, LANES_LEAN_RATE), column(&v, LANES_SPEED)};
  instant now;
  place(&now.at, &block->model.geometry, at);
  solve_located(&now, &block->model, u, NULL);
  form a = now.acceleration;
  put(out[LANES_LEAN_ACC] + v.first, a.kap);
  put(out[LANES_STEER_ACC] + v.first, a.phi);
  put(out[LANES_SPEED_RATE] + v.first, a.v);
  checks c = checks_of(&now);
  return lanes_bits(lanes_found(c.root, block->reach) & regular(&c, block->reach) & ordinary(v) &
                    is_finite(a.phi) & is_finite(a.kap) & is_finite(a.v));
}

uint64_t INSTANCE(lanes_accelerate)(double *const out[LANES_ACCELERATIONS],
                                    const lanes_models *models, bool same,
                                    const double *const state[LANES_STATE], int blocks) {
  posture at[LANES_BLOCKS];
  uint64_t solved = 0;
  for (int k = 0; k < blocks; k++) find_sines(&at[k], (column_view){state, k * LANES});
  for (int k = 0; k < blocks; k++)
    find_rear_angle(&at[k], &models[same ? 0 : k].model, (column_view){state, k * LANES});
  for (int k = 0; k < blocks; k++) {
    column_view v = {state, k * LANES};
    solved |= (uint64_t)finish(out, &models[same ? 0 : k], &at[k], v) << v.first;
  }
  return solved;
}
