// SPDX-License-Identifier: Apache-2.0
// Points of a branch between two that were traced: where a variable takes a value or turns back,
// where the speed falls to zero. Straight riding is not passed, but a piece may begin or end there.
#ifndef BICYCLE_MOTION_TURN_EVENT_H
#define BICYCLE_MOTION_TURN_EVENT_H

#include "motion/turn_curve.h"

typedef struct turn_piece {
  const turn_curve *curve;
  newton *solver;
  const turn_point *from, *to;
  const turn_point *straight; // that of the two at which the bicycle rides straight; or NULL
  double *residual;           // of the last correction, rad/s^2: what to report where one fails
} turn_piece;

enum { PIECE_EVENTS = 6 };

typedef struct turn_event {
  turn_point at;
  bike_turn_mark mark;     // PLAIN: the variable has the value
  bike_turn_variable fold; // of LARGEST and SMALLEST
} turn_event;

// Whether the fold of a variable is worth a mark.
typedef bool turn_wanted[BIKE_TURN_VARIABLES];

// Folds and static ends; returns how many, or -1 where one could not be pinned down.
int turn_piece_marks(turn_event out[PIECE_EVENTS], const turn_piece *piece,
                     const turn_wanted wanted);

// Where a variable has a value: at most two places; returns how many, or -1. `but_straight`:
// straight riding, at an end of the piece, has the value, and other places are asked for.
int turn_piece_crossings(turn_point out[2], const turn_piece *piece, bike_turn_variable variable,
                         double value, bool but_straight);

#endif
