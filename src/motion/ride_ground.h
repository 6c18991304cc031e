// SPDX-License-Identifier: Apache-2.0
// What a ride asks of the ground: which wheel lifts or slides, and from when to when.
#ifndef BICYCLE_MOTION_RIDE_GROUND_H
#define BICYCLE_MOTION_RIDE_GROUND_H

#include "motion/ride_event.h"

void ride_ground_look(bike_wheel_ground ground[2], double time, const bike_snapshot *view);

// What holds from `time` on, at the start or after a jump of the input.
void ride_ground_jump(bike_wheel_ground ground[2], double time, const ride_indicators *now);

// What began and ended on the smooth way from `a` to `b`; arguments and errors as ride_event_time.
int ride_ground_pass(bike_wheel_ground ground[2], double a, const ride_indicators *at_a, double b,
                     const ride_indicators *at_b, ride_indicators_at *look, void *user);

#endif
