// SPDX-License-Identifier: Apache-2.0
// Units in which every bicycle is about 2 m long: the search for turns counts lengths, speeds and
// offsets in numbers of the order of one. The unit of mass stays: forces are divided by inertias.
#ifndef BICYCLE_MOTION_TURN_UNITS_H
#define BICYCLE_MOTION_TURN_UNITS_H

#include <bicycle/turn.h>

// Powers of two, so that changing units rounds nothing. time^2 = length: g keeps its number.
typedef struct turn_units {
  double length; // m
  double time;   // s
} turn_units;

// One and one for what people ride: a reach of 1 m to 4 m.
turn_units turn_units_of(const bike_model *model);

// The similar bicycle: `model` as these units tell it.
bike_model turn_units_model(const bike_model *model, turn_units units);

// A question as these units tell it; a limit of zero becomes that of a bicycle that people ride.
bike_turn_def turn_units_def(const bike_turn_def *def, turn_units units);

// A turn into these units and back.
bike_turn turn_units_in(const bike_turn *turn, turn_units units);
bike_turn turn_units_out(const bike_turn *turn, turn_units units);

#endif
