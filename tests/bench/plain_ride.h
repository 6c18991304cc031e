// SPDX-License-Identifier: Apache-2.0
// A ride as short as it can be written: the Runge-Kutta pair of bike_ride with its own step
// control over bike_accelerate, one bicycle at a time, without SUNDIALS, events and samples.
#ifndef BICYCLE_BENCH_PLAIN_RIDE_H
#define BICYCLE_BENCH_PLAIN_RIDE_H

#include <bicycle/state.h>
#include <stdbool.h>

typedef struct plain_ride {
  const bike_model *model;
  double duration;   // s
  double rtol, atol; // of a step, the largest error of a state
  long evaluations;  // out
} plain_ride;

// From a state to that after `duration`; hands off. False where the equations end or no step is
// short enough.
bool plain_ride_go(bike_state *state, plain_ride *ride);

#endif
