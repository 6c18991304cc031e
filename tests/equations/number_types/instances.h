// SPDX-License-Identifier: Apache-2.0
// The kernel compiled for each number type, behind one plain signature.
#ifndef BICYCLE_TESTS_INSTANCES_H
#define BICYCLE_TESTS_INSTANCES_H

#include <bicycle/state.h>

enum { INSTANCE_LANES = 8 }; // as many as any register holds; more than one go where it holds fewer

// What a state gives: phi'', kappa'', v', the kinetic and potential energy, and the ground forces.
enum { INSTANCE_RESULTS = 11 };
typedef struct instance_result {
  double value[INSTANCE_RESULTS];
} instance_result;

// Each lane its own bicycle and state.
void run_lanes(instance_result out[INSTANCE_LANES], const bike_model model[INSTANCE_LANES],
               const bike_state state[INSTANCE_LANES], const bike_input input[INSTANCE_LANES]);

void run_double(instance_result *out, const bike_model *model, const bike_state *state,
                const bike_input *input);

// Real parts.
void run_complex(instance_result *out, const bike_model *model, const bike_state *state,
                 const bike_input *input);

#endif
