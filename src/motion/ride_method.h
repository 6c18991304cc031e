// SPDX-License-Identifier: Apache-2.0
// An integrator: what a ride needs of a method, as a struct of functions.
#ifndef BICYCLE_MOTION_RIDE_METHOD_H
#define BICYCLE_MOTION_RIDE_METHOD_H

#include "motion/ride_table.h"

typedef struct ride_method {
  bool adaptive;
  // Part of a step is a step of its own with this table; NULL for a method that has `inside`.
  const ride_table *table;
  // A new integrator standing at `start`. 0 or BIKE_ERROR_MEMORY.
  int (*create)(void **out, const bike_ride_def *def, const ride_point *start, ride_flow *flow);
  void (*free)(void *self);
  // Forgets the past and goes on from `from`: a jump of the inputs. 0, BIKE_ERROR_MEMORY, or
  // anything else.
  int (*restart)(void *self, const ride_point *from);
  // One step from *at, where the last one ended, not beyond `limit`. 0, BIKE_ERROR_MEMORY, or
  // anything else: the reason, when the equations gave it, is then in the flow.
  int (*step)(void *self, ride_point *at, double limit);
  // The state at t inside the last step, as accurate as its end; NULL for one-step methods, which
  // are made to stop wherever they are looked at.
  int (*inside)(ride_point *out, void *self, double t);
} ride_method;

extern const ride_method RIDE_METHOD_RK8;
extern const ride_method RIDE_METHOD_ADAMS;
extern const ride_method RIDE_METHOD_RK4;

#endif
