// SPDX-License-Identifier: Apache-2.0
// How fates are told from rides of an ensemble.
#ifndef BICYCLE_BATCH_FATE_H
#define BICYCLE_BATCH_FATE_H

#include <bicycle/basin.h>

bike_ensemble_def fate_ensemble(const bike_basin_def *def);
bike_fate fate_of_result(const bike_member_result *result);

// Errors that say that there is no such state.
bool fate_is_no_start(int code);

// Those of many starts that ride; places[i] is where the fate of member i goes.
typedef struct fate_riders {
  size_t count;
  bike_member *members;
  bike_member_result *results;
  size_t *places;
} fate_riders;

// Room for `size`. Free it in any case.
int fate_riders_allocate(fate_riders *r, size_t size);
void fate_riders_free(fate_riders *r);
void fate_riders_add(fate_riders *r, const bike_member *member, size_t place);

// Rides all of them; `times` and `codes` (of the rides) may be NULL.
int fate_riders_ride(fate_riders *r, bike_fate *out, double *times, int *codes,
                     const bike_ensemble_def *ensemble);

#endif
