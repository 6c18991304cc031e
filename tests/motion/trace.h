// SPDX-License-Identifier: Apache-2.0
// A ride kept in memory, for tests.
#ifndef BICYCLE_TESTS_MOTION_TRACE_H
#define BICYCLE_TESTS_MOTION_TRACE_H

#include <bicycle/ride.h>

typedef struct trace {
  size_t count, room;
  bike_sample *sample;
  bike_sample_more *more;
  size_t stop_after; // rows after which to interrupt the ride; 0: never
  void *input_data;  // of the test's input function, which gets the trace as `user`
} trace;

void trace_free(trace *t);

// The default definition, recording into `t`.
bike_ride_def ride_def(trace *t, bike_state start, double duration, double sample);

// Rides, recording anew; the error code.
int ride_into(bike_ride_result *result, const bike_model *model, const bike_ride_def *def);

// Rides a definition that must succeed, and gives its last row.
bike_sample ride_end(const bike_model *model, const bike_ride_def *def);

bike_state state_of_sample(const bike_sample *s);

// Largest |E(t) - E(0) - work| / E(0) of a trace, divided by t + 1 s.
double energy_drift(const trace *t);

// Largest difference of lean, steer, their rates and the speed.
double state_gap(const bike_sample *a, const bike_sample *b);

#endif
