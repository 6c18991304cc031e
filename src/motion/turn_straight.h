// SPDX-License-Identifier: Apache-2.0
// Straight riding on a curve of stationary motions. At a capsize speed hands-free turns branch off
// it (a pitchfork: with them a curve of constant speed has three places for one rider offset, all
// of which meet there), so that what lies beside it must be told from it.
#ifndef BICYCLE_MOTION_TURN_STRAIGHT_H
#define BICYCLE_MOTION_TURN_STRAIGHT_H

#include "motion/turn_curve.h"

typedef struct turn_straight {
  bool on_curve; // straight and upright riding lies on the curve; else nothing below means anything
  turn_point at; // where, and a tangent of either sense
  double square; // m     v^2/g of the capsize speed: negative or not finite where there is none
  bool neutral;  //       the curve's speed, or the one asked for, is that speed
} turn_straight;

// Whether the bicycle rides straight on with a lean, and with which rider offset. A geometry error,
// or 0.
int turn_straight_offset(bool *rides, double *offset, const turn_bicycle *bicycle, double lean);

// Where nothing can be told of upright riding the curve does not hold it.
void turn_straight_find(turn_straight *out, const turn_curve *curve);

// Whether straight riding has the value of a variable, whatever its speed.
bool turn_straight_answers(const turn_straight *straight, const turn_curve *curve,
                           bike_turn_variable variable, double value);

// Whether the way between two points of a branch passes straight riding, and how far along it lies
// from the first and before the second. The tangent is turned in the branch's direction.
bool turn_straight_between(turn_straight *straight, double reached[2], const turn_point *from,
                           const turn_point *to);

// Whether a place is another than straight riding, as far as rounding allows to tell.
bool turn_straight_apart(const turn_straight *straight, const double y[Y_SIZE]);

#endif
