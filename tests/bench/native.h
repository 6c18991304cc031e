// SPDX-License-Identifier: Apache-2.0
// The instance of our equations that is built with -O3 -march=native, the flags of sympy's C; hands
// off.
#ifndef BICYCLE_BENCH_NATIVE_H
#define BICYCLE_BENCH_NATIVE_H

#include "equations/answers.h"

extern const state_evaluations state_native;

static inline int native_accelerate(bike_acceleration *out, const bike_model *model,
                                    const bike_state *state) {
  static const bike_input HANDS_OFF = {0};
  return answer_acceleration(out, &state_native, model, state, &HANDS_OFF);
}

#endif
