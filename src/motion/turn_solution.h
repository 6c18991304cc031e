// SPDX-License-Identifier: Apache-2.0
// From two given numbers and a guess to a stationary motion with all that is told of it.
#ifndef BICYCLE_MOTION_TURN_SOLUTION_H
#define BICYCLE_MOTION_TURN_SOLUTION_H

#include "motion/turn_forces.h"
#include "motion/turn_newton.h"

#include <bicycle/turn.h>

// The four variables, the speed as its square over g (m).
typedef struct turn_place {
  double lean, steer, square, offset;
} turn_place;

// Improves a guess by changing the two variables that are not held. The guess stays where Newton's
// method leaves it by more than `reach`; *residual is what is left, rad/s^2.
void turn_place_polish(turn_place *at, double *residual, const turn_bicycle *bicycle,
                       newton *solver, const bool held[BIKE_TURN_VARIABLES], double reach);

// Everything about a place that is stationary. NO_CONVERGENCE, with out->residual, where it is not;
// errors of bike_evaluate.
int turn_describe(bike_turn *out, const turn_bicycle *bicycle, const turn_place *at);

#endif
