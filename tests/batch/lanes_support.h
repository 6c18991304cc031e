// SPDX-License-Identifier: Apache-2.0
// What the tests of batches and ensembles share.
#ifndef BICYCLE_TESTS_BATCH_LANES_SUPPORT_H
#define BICYCLE_TESTS_BATCH_LANES_SUPPORT_H

#include "equations/bicycles.h"
#include <bicycle/ensemble.h>
#include <bicycle/model.h>

// Tells which instructions the test was to run with and which it does: a level that the machine
// lacks gives way to the best that it has. A cmocka group set-up.
int print_instructions(void **state);

bike_model shipped_model(int which);
bike_model named_model(const char *name);
bike_model random_model(random_source *source); // asymmetric

// Equal to the last bit, NaN included; fails the running test where not.
void assert_same_bits(double a, double b, const char *what);

// The same result to the last bit in every member.
void assert_same_result(const bike_member_result *a, const bike_member_result *b, const char *what);

// bike_ensemble_ride, which must succeed.
void ride_members(bike_member_result *out, const bike_member *members, size_t count,
                  const bike_ensemble_def *def);

#endif
