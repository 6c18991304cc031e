// SPDX-License-Identifier: Apache-2.0
// What a state leads to, as compiled for one instruction set.
#ifndef BICYCLE_EQUATIONS_STATE_INSTANCE_H
#define BICYCLE_EQUATIONS_STATE_INSTANCE_H

#include "equations/instruction_set.h"
#include "equations/number_double.h"

#include <bicycle/state.h>

typedef struct question {
  const bike_model *model;
  const bike_state *state;
  load in;
} question;

// Fills `out`, of the type beside it below, from a start of Newton's method, NULL: from the guess
// near upright. Means something only where the checks hold and the numbers are finite.
typedef checks evaluation(void *out, const question *q, const start *from);

typedef struct state_evaluations {
  evaluation *free_acceleration, *loaded_acceleration; // bike_acceleration; free: hands off
  evaluation *free_rates, *loaded_rates;               // bike_rates
  evaluation *mass_matrix;                             // double[9]
  evaluation *snapshot;                                // bike_snapshot
} state_evaluations;

extern const state_evaluations state_baseline, state_v3, state_v4;

#endif
