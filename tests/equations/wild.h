// SPDX-License-Identifier: Apache-2.0
// Bicycles, states and inputs of any magnitude that a double can have: what comes of them is finite
// or an error.
#ifndef BICYCLE_TESTS_WILD_H
#define BICYCLE_TESTS_WILD_H

#include "support/random.h"
#include <bicycle/state.h>

// Zero, the ends of the range of doubles, denormal numbers, or of random sign and exponent: over
// the whole range, or within 1e-6 .. 1e6.
double wild_number(random_source *source);

// An ordinary random bicycle; one of its shape and any size, mass and gravity; one whose geometry
// is nearly impossible; or one with a few wild numbers. bike_check may refuse it.
bike_bicycle wild_bicycle(random_source *source);

// A state within the bicycle's range, or with wild numbers, large angles among them.
bike_state wild_state(random_source *source);

// Hands off, ordinary, or with wild numbers; the rider moves only where `rider`.
bike_input wild_input(random_source *source, bool rider);

// Moves `state` to within rounding of where bike_evaluate's code changes on the way from upright:
// the end of the geometry, or a singularity. False where there is none.
bool wild_edge(bike_state *state, const bike_model *model);

#endif
