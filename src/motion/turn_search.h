// SPDX-License-Identifier: Apache-2.0
// All stationary motions of a question, by way of the branches that hold them.
#ifndef BICYCLE_MOTION_TURN_SEARCH_H
#define BICYCLE_MOTION_TURN_SEARCH_H

#include "motion/turn_forces.h"

#include <bicycle/turn.h>

// Follows every branch and collects solutions and marks into *out, in no particular order. The
// definition has been checked, and gives the speed or the rider offset. Errors as bike_turns_find.
int turn_search(bike_turns *out, const turn_bicycle *bicycle, const bike_turn_def *def);

// Lean and steer given: solutions in closed form.
int turn_search_place(bike_turns *out, const turn_bicycle *bicycle, const bike_turn_def *def);

// Appends a solution or a mark unless it is there already. FULL where there is no room.
int turn_keep(bike_turn *list, int *count, const bike_turn *turn);

#endif
