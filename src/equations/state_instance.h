// SPDX-License-Identifier: Apache-2.0
// The functions of bicycle/state.h as compiled for one instruction set. Arguments have been checked
// for NULL.
#ifndef BICYCLE_EQUATIONS_STATE_INSTANCE_H
#define BICYCLE_EQUATIONS_STATE_INSTANCE_H

#include "equations/instruction_set.h"

#include <bicycle/state.h>

typedef struct state_functions {
  int (*accelerate)(bike_acceleration *out, const bike_model *model, const bike_state *state,
                    const bike_input *input);
  int (*rates_of)(bike_rates *out, const bike_model *model, const bike_state *state,
                  const bike_input *input);
  int (*mass_matrix)(double out[9], const bike_model *model, const bike_state *state,
                     double rider_offset);
  int (*evaluate)(bike_snapshot *out, const bike_model *model, const bike_state *state,
                  const bike_input *input);
} state_functions;

extern const state_functions state_baseline, state_v3, state_v4;

#endif
