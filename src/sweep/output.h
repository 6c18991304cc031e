// SPDX-License-Identifier: Apache-2.0
// What a sweep can ask of each of its points. A new question is a line here and its answer in
// evaluate.c.
#ifndef SWEEP_OUTPUT_H
#define SWEEP_OUTPUT_H

#include <stdbool.h>

// code, name of the column, whether the point needs a speed, meaning and unit
#define SWEEP_OUTPUTS(X)                                                                           \
  X(SWEEP_WEAVE_SPEED, "weave_speed", false, "the first, m/s; empty where there is none")          \
  X(SWEEP_CAPSIZE_SPEED, "capsize_speed", false, "the first, m/s; empty where there is none")      \
  X(SWEEP_STABLE_RANGES, "stable_ranges", false, "speeds LO:HI;LO:HI that are stable, m/s")        \
  X(SWEEP_EPS_MAX, "eps_max", true, "of riding straight at the speed: largest real part, 1/s")     \
  X(SWEEP_TURN_EPS_MAX, "turn_eps_max", true,                                                      \
    "of the circle at the speed and lean, the rider beside as it asks, 1/s; empty: none")          \
  X(SWEEP_OUTCOME, "outcome", true, "of a ride, hands off: recovers, lifts, falls, undecided")     \
  X(SWEEP_TIME, "time", true, "when that was decided, s")

typedef enum sweep_output {
#define SWEEP_CODE(code, name, speed, meaning) code,
  SWEEP_OUTPUTS(SWEEP_CODE)
#undef SWEEP_CODE
      SWEEP_OUTPUT_COUNT
} sweep_output;

const char *sweep_output_name(sweep_output output);
bool sweep_output_needs_speed(sweep_output output);

#endif
