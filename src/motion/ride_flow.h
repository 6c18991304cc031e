// SPDX-License-Identifier: Apache-2.0
// The motion as a flow: the state that is integrated, its rates, and what it looks like outside.
#ifndef BICYCLE_MOTION_RIDE_FLOW_H
#define BICYCLE_MOTION_RIDE_FLOW_H

#include <bicycle/ride.h>

// What is integrated: the paper's five variables, where they carry the bicycle, and the work.
enum {
  RIDE_STEER,
  RIDE_LEAN,
  RIDE_STEER_RATE,
  RIDE_LEAN_RATE,
  RIDE_SPEED,
  RIDE_X,
  RIDE_Y,
  RIDE_YAW,
  RIDE_REAR_ANGLE,
  RIDE_FRONT_ANGLE,
  RIDE_WORK,
  RIDE_SIZE
};

typedef struct ride_point {
  double t;            // s
  double y[RIDE_SIZE]; // SI
} ride_point;

// The equations with their inputs, over a stretch of time in which the inputs are smooth.
typedef struct ride_flow {
  const bike_model *model;    //
  bike_input_function *input; // NULL: none
  void *user;                 //
  double from, to;            // s  inputs are asked within these only: a step that ends at a jump
                              //    of the input must not see what comes after it
  int error;                  // of the last evaluation that failed, 0 when none has
  bool fatal;                 // that error is the input's and no other state can mend it
  long evaluations;           // right-hand sides
} ride_flow;

// Rates dy of y. 0; 1 where the model has none at this state, 2 (nothing can help) for a wrong
// input; the code is in `flow->error`.
int ride_rates(double dy[RIDE_SIZE], double t, const double y[RIDE_SIZE], ride_flow *flow);

// The whole instant; returns as ride_rates.
int ride_look(bike_snapshot *out, const ride_point *at, ride_flow *flow);

ride_point ride_start(const bike_state *state);

void ride_describe(bike_sample *sample, bike_sample_more *more, const ride_point *at,
                   const bike_snapshot *now);

#endif
