// SPDX-License-Identifier: Apache-2.0
// Questions about stationary turns, for tests.
#ifndef BICYCLE_TESTS_MOTION_TURNS_H
#define BICYCLE_TESTS_MOTION_TURNS_H

#include <bicycle/turn.h>

#define DEGREE 0.017453292519943295

// The default definition with two given; with one where both are the same.
bike_turn_def turn_def(bike_turn_variable a, double a_value, bike_turn_variable b, double b_value);

// The answer to a question that must have one; in memory of its own until the next call but
// `TURN_ANSWERS` - 1.
enum { TURN_ANSWERS = 4 };
const bike_turns *turns_of(const bike_model *model, const bike_turn_def *def);

// How many belong to the main family, which comes first.
int main_family_count(const bike_turns *found);

// A mark of a kind with positive (or zero) lean in the main family; fails the test where there is
// none.
bike_turn main_mark(const bike_turns *found, bike_turn_mark mark, bike_turn_variable fold);

#endif
