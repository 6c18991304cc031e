// SPDX-License-Identifier: Apache-2.0
// Half a period of riding, seen in a mirror: the map of which a symmetric cycle is a fixed point.
#ifndef BICYCLE_MOTION_CYCLE_HALF_H
#define BICYCLE_MOTION_CYCLE_HALF_H

#include <bicycle/cycle.h>

enum { HALF_LEAN, HALF_STEER, HALF_LEAN_RATE, HALF_STEER_RATE, HALF_SIZE };

// out = -x(time) for the ride from `x` with the energy of straight riding at `speed`.
int half_map(double out[HALF_SIZE], const bike_model *model, const double x[HALF_SIZE],
             double speed, double time);

// What is measured along the cycle from x over half a period.
int half_measure(bike_cycle *inout, const bike_model *model, const double x[HALF_SIZE]);

#endif
