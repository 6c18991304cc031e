// SPDX-License-Identifier: Apache-2.0
// Accelerations of many bicycles, or of many states of one, and stability at many states, by vector
// instructions: several at a time in the lanes of a register, from the same equations as
// bike_accelerate and bike_linearize.
#ifndef BICYCLE_BATCH_H
#define BICYCLE_BATCH_H

#include <bicycle/stability.h>
#include <stddef.h>

// Bicycles made ready for the lanes.
typedef struct bike_batch bike_batch;

// Arrays of `count` numbers each, units and signs as in bike_state.
typedef struct bike_batch_states {
  const double *lean, *steer;           // rad
  const double *lean_rate, *steer_rate; // rad/s
  const double *speed;                  // m/s
} bike_batch_states;

// As bike_acceleration; `codes` (may be NULL) receives for each what bike_accelerate returns for
// it; where that is an error the accelerations are NaN.
typedef struct bike_batch_accelerations {
  double *lean, *steer; // rad/s^2
  double *speed;        // m/s^2
  int *codes;
} bike_batch_accelerations;

// model_count = 1: all states are of this bicycle; otherwise state i is of bicycle i. Copies the
// models. Errors: ARGUMENT, MEMORY.
BIKE_API int bike_batch_create(bike_batch **out, const bike_model *models, size_t model_count);
BIKE_API void bike_batch_free(bike_batch *batch);

// Hands off. The same as bike_accelerate, to the last bit (GCC on x86-64; elsewhere to some 1e-15
// of the terms that add up to an acceleration, which cancel mostly). Results may not lie over the
// states. Errors: ARGUMENT (also for a missing array, or a count that is not that of the bicycles).
BIKE_API int bike_batch_accelerate(bike_batch_accelerations *out, const bike_batch *batch,
                                   const bike_batch_states *states, size_t count);

// bike_linearize at many states of one bicycle, by exact forward tangents: the same to rounding.
// `inputs` may be NULL: hands off. codes[i] (not NULL) is what bike_linearize returns for state i;
// out[i] is untouched where that is an error.
BIKE_API int bike_batch_linearize(bike_linear *out, int *codes, const bike_model *model,
                                  const bike_state *states, const bike_input *inputs, size_t count);

// bike_eigenvalues_of for many; to a few roundings of the largest eigenvalue, and where two meet to
// the root of that, as any method. codes[i]: NOT_FINITE, NO_CONVERGENCE, or 0.
BIKE_API int bike_batch_eigenvalues(bike_eigenvalues *out, int *codes, const bike_linear *linears,
                                    size_t count);

// How many at a time on this machine, and by which instructions: 8 "v4" (x86-64-v4: AVX-512),
// 4 "v3" (AVX2), 2 "baseline". The environment variable BICYCLE_INSTRUCTIONS asks for a lower one
// by its name. Accelerations and rates of v4 and v3 are the same to the last bit; baseline has no
// fused multiply-adds and rounds otherwise. It holds for all of the library and is read once.
BIKE_API int bike_batch_width(void);
BIKE_API const char *bike_instructions(void);

#endif
