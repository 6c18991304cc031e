// SPDX-License-Identifier: Apache-2.0
#ifndef BICYCLE_MOTION_RIDE_CHECK_H
#define BICYCLE_MOTION_RIDE_CHECK_H

#include <bicycle/ride.h>

// 0, BIKE_ERROR_ARGUMENT or BIKE_ERROR_NOT_FINITE: every rule that ride.h states of a definition.
int ride_check(const bike_ride_def *def);

// Number of sample intervals in a ride; its last row has this index.
long ride_intervals(const bike_ride_def *def);

#endif
