// SPDX-License-Identifier: Apache-2.0
// Which turns belong to the main family: those from which straight riding is reached.
#ifndef BICYCLE_MOTION_TURN_FAMILY_H
#define BICYCLE_MOTION_TURN_FAMILY_H

#include "motion/turn_branch.h"

typedef enum turn_family {
  FAMILY_MAIN, // all of the branch
  FAMILY_MIXED // to be asked of each turn
} turn_family;

// `nearest`: no other branch comes closer to upright.
turn_family turn_family_of(const turn_branch *branch, const turn_curve *curve, bool nearest);

// Where the family is mixed, follows the branches of the turn's own speed, and of no offset.
// MEMORY, or 0.
int turn_in_main_family(bool *out, const turn_curve *curve, newton *solver, turn_family family,
                        const bike_turn *turn);

#endif
