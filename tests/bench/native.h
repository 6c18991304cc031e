// SPDX-License-Identifier: Apache-2.0
// A copy of our equations built with -O3 -march=native, the flags of sympy's C, under other names
// than the library's.
#ifndef BICYCLE_BENCH_NATIVE_H
#define BICYCLE_BENCH_NATIVE_H

#include <bicycle/state.h>

int native_accelerate(bike_acceleration *out, const bike_model *model, const bike_state *state,
                      const bike_input *input);
int native_rates_of(bike_rates *out, const bike_model *model, const bike_state *state,
                    const bike_input *input);

#endif
