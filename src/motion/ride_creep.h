// SPDX-License-Identifier: Apache-2.0
// A step where the integrator found none: up to the very edge of the model.
#ifndef BICYCLE_MOTION_RIDE_CREEP_H
#define BICYCLE_MOTION_RIDE_CREEP_H

#include "motion/ride_table.h"

typedef enum ride_creep_end {
  RIDE_CREEP_STEPPED, // *at has moved on, and can be looked at
  RIDE_CREEP_EDGE,    // the model ends within 1e-11 s after *at
  RIDE_CREEP_FATAL,   // a wrong input: the flow knows
  RIDE_CREEP_STUCK    // no step is accurate, though the model has not ended
} ride_creep_end;

// One step of RIDE_TABLE_8 from *at towards `limit`, halved until the equations hold in it.
ride_creep_end ride_creep(ride_point *at, bike_snapshot *view, double limit, ride_flow *flow);

#endif
