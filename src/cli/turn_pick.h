// SPDX-License-Identifier: Apache-2.0
// The one turn that is meant where a question has several answers.
#ifndef BICYCLE_CLI_TURN_PICK_H
#define BICYCLE_CLI_TURN_PICK_H

#include <bicycle/turn.h>

// The turn nearest to upright, of the main family if that has one. BIKE_ERROR_NOT_STATIONARY where
// there is none; errors of bike_turns_find.
int turn_pick(bike_turn *out, const bike_model *model, const bike_turn_def *def);

#endif
