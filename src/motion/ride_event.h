// SPDX-License-Identifier: Apache-2.0
// Events: one indicator each, positive until it happens, and the time at which it falls to zero.
// The grip of the two wheels is watched by indicators too, and is no event.
#ifndef BICYCLE_MOTION_RIDE_EVENT_H
#define BICYCLE_MOTION_RIDE_EVENT_H

#include "motion/ride_flow.h"

enum {
  RIDE_EVENT_KINDS = BIKE_EVENT_STANDSTILL + 1,
  RIDE_REAR_GRIP = RIDE_EVENT_KINDS, // N  bike_grip
  RIDE_FRONT_GRIP,                   // N
  RIDE_INDICATORS
};

// Indexed by bike_event_kind, and by the two grips.
typedef struct ride_indicators {
  double g[RIDE_INDICATORS];
} ride_indicators;

// On which side of the model's two denominators a ride starts: +1 or -1.
typedef struct ride_side {
  double yaw;   // T_r cos(phi~) - T_f, of equation (13)
  double pitch; // T_r - T_f cos(phi~), of (4) differentiated; zero where (4) has a double root
} ride_side;

ride_side ride_side_of(const bike_snapshot *start);

ride_indicators ride_indicate(const bike_ride_def *def, const ride_side *side, const ride_point *at,
                              const bike_snapshot *now);

// Before a ride no event has happened.
ride_indicators ride_nothing_happened(void);

static inline bool ride_happened(const ride_indicators *before, const ride_indicators *after,
                                 int kind) {
  return before->g[kind] > 0 && !(after->g[kind] > 0);
}

bool ride_event_ends(const bike_ride_def *def, bike_event_kind kind);

// Indicators at a time of the last step; 0 or an error code.
typedef int ride_indicators_at(ride_indicators *out, double t, void *user);

// First time, to 1e-12 s, at which an indicator that is positive at `a` and not at `b` has fallen,
// or has risen where it is positive at `b` and not at `a`.
int ride_event_time(double *time, int kind, double a, const ride_indicators *at_a, double b,
                    const ride_indicators *at_b, ride_indicators_at *look, void *user);

void ride_record(bike_ride_result *out, bike_event_kind kind, double time);

#endif
