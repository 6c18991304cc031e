// SPDX-License-Identifier: Apache-2.0
// The bicycles that the tests of the equations ride: the shipped ones and random ones.
#ifndef BICYCLE_TESTS_BICYCLES_H
#define BICYCLE_TESTS_BICYCLES_H

#include "support/random.h"
#include <bicycle/bicycle.h>

typedef struct shipped_bicycle {
  const char *name;   // model/NAME/NAME.yml
  random_range range; // where its random states are drawn
} shipped_bicycle;

enum { SHIPPED_COUNT = 6 };
extern const shipped_bicycle shipped_bicycles[SHIPPED_COUNT];

// Reads a shipped bicycle from its file; fails the running test where that cannot be done.
bike_bicycle read_shipped(const char *name);

// A bicycle that has never been built: random lengths near a roadster's, random parts (several in
// each assembly, one of them a rider), random positive semidefinite tensors. Mirror-symmetric, or
// with places and products of inertia on either side.
bike_bicycle random_bicycle(random_source *source, bool symmetric);

// The same bicycle seen in a mirror.
bike_bicycle mirrored(const bike_bicycle *bicycle);

#endif
