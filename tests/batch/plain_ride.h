// SPDX-License-Identifier: Apache-2.0
// What a result in lanes is measured by: the plain path, and how much its errors may have grown.
#ifndef BICYCLE_TESTS_BATCH_PLAIN_RIDE_H
#define BICYCLE_TESTS_BATCH_PLAIN_RIDE_H

#include <bicycle/ensemble.h>

typedef struct plain_ride {
  bike_member_result result;
  bool sharp;            // a start a little off ends in the same manner, and for a reason that
                         // lanes share
  double time_tolerance; // s
  double tolerance;      // of angles, rates, speed at the end
} plain_ride;

// Rides the member by the plain path, from its start and from one nudged by 1e-7 in every variable:
// what the nudge has grown to at the end tells what the errors of all steps, at most rtol |y| +
// atol each, may have grown to.
plain_ride ride_plain(const bike_member *member, const bike_ensemble_def *def);

// Outcome, time and end state; fails the running test where they differ by more.
void assert_like_plain(const bike_member_result *got, const plain_ride *plain);

#endif
