// SPDX-License-Identifier: Apache-2.0
// Seeded random numbers for property tests: the same on every machine, the seed printed.
#ifndef BICYCLE_TESTS_SUPPORT_RANDOM_H
#define BICYCLE_TESTS_SUPPORT_RANDOM_H

#include <bicycle/state.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct random_source {
  uint64_t state;
} random_source;

// Starts from the environment's BICYCLE_SEED where it is set, else from `seed`; prints it.
static inline random_source random_begin(const char *test, uint64_t seed) {
  const char *given = getenv("BICYCLE_SEED");
  if (given && *given) seed = strtoull(given, NULL, 10);
  printf("%s: BICYCLE_SEED=%" PRIu64 "\n", test, seed);
  return (random_source){seed};
}

// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): any seed, zero included, is a good one.
static inline uint64_t random_bits(random_source *source) {
  uint64_t z = source->state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  return z ^ (z >> 31);
}

// Uniform in [low, high).
static inline double random_between(random_source *source, double low, double high) {
  return low + (high - low) * ((double)(random_bits(source) >> 11) * 0x1p-53);
}

// The ranges of states that the property tests draw from.
typedef struct random_range {
  double lean, steer; // rad    at most, either side
  double rate;        // rad/s  of both, at most, either side
  double slow, fast;  // m/s    speed
} random_range;

static inline bike_state random_state(random_source *source, const random_range *range) {
  bike_state s;
  s.lean = random_between(source, -range->lean, range->lean);
  s.steer = random_between(source, -range->steer, range->steer);
  s.lean_rate = random_between(source, -range->rate, range->rate);
  s.steer_rate = random_between(source, -range->rate, range->rate);
  s.speed = random_between(source, range->slow, range->fast);
  return s;
}

#endif
