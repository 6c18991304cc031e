// SPDX-License-Identifier: Apache-2.0
// What the library's users call: the instance of the processor at hand.
#include <bicycle/error.h>
#include <bicycle/state.h>
#include <stdatomic.h>

#include "equations/answers.h"

static const bike_input HANDS_OFF = {0};

static const state_evaluations *const instances[] = {
    [INSTRUCTIONS_BASELINE] = &state_baseline,
#ifdef BICYCLE_X86_64_LEVELS
    [INSTRUCTIONS_V3] = &state_v3,
    [INSTRUCTIONS_V4] = &state_v4,
#endif
};

// Asked a hundred million times in a map: kept, and no more than a load. Threads that decide at
// once decide the same.
static const state_evaluations *chosen(void) {
  static _Atomic(const state_evaluations *) kept;
  const state_evaluations *known = atomic_load_explicit(&kept, memory_order_relaxed);
  if (known) return known;
  known = instances[instruction_set_in_use()];
  atomic_store_explicit(&kept, known, memory_order_relaxed);
  return known;
}

int bike_accelerate(bike_acceleration *out, const bike_model *model, const bike_state *state,
                    const bike_input *input) {
  if (!out || !model || !state) return BIKE_ERROR_ARGUMENT;
  return answer_acceleration(out, chosen(), model, state, input ? input : &HANDS_OFF);
}

int bike_rates_of(bike_rates *out, const bike_model *model, const bike_state *state,
                  const bike_input *input) {
  if (!out || !model || !state) return BIKE_ERROR_ARGUMENT;
  return answer_rates(out, chosen(), model, state, input ? input : &HANDS_OFF);
}

int bike_mass_matrix(double out[9], const bike_model *model, const bike_state *state,
                     double rider_offset) {
  if (!out || !model || !state) return BIKE_ERROR_ARGUMENT;
  return answer_mass_matrix(out, chosen(), model, state, rider_offset);
}

int bike_evaluate(bike_snapshot *out, const bike_model *model, const bike_state *state,
                  const bike_input *input) {
  if (!out || !model || !state) return BIKE_ERROR_ARGUMENT;
  return answer_snapshot(out, chosen(), model, state, input ? input : &HANDS_OFF);
}
