// SPDX-License-Identifier: Apache-2.0
// Our rides of a contest: at the end of the tightest all others are measured.
#ifndef BICYCLE_BENCH_RIDE_H
#define BICYCLE_BENCH_RIDE_H

#include "list.h"

#include <bicycle/ride.h>

enum { BENCH_RIDE_STATES = 5 };

typedef struct bench_ride {
  bench_subject *subject;
  double tolerance; // rtol and atol
} bench_ride;

// What everybody integrates and what is compared: lean, steer, their rates (rad, rad/s) and the
// speed (m/s). Our rides carry six states more.
void bench_ride_states(double out[BENCH_RIDE_STATES], const bike_sample *sample);

// The largest difference.
double bench_ride_error(const double actual[BENCH_RIDE_STATES],
                        const double expected[BENCH_RIDE_STATES]);

// The whole ride with the default method, sampled at its ends alone. False with an error of the
// library, and where an event ends it early.
bool bench_ride_go(bike_ride_result *out, const bench_ride *ride);

// The same as work; `ride` is a bench_ride.
void bench_rides(void *ride, long repeats);

// The loosest tolerance on a grid of eight a decade that ends within `error` of the states; 0 where
// there is none.
double bench_ride_tolerance(bench_subject *subject, const double end[BENCH_RIDE_STATES],
                            double error);

#endif
