// SPDX-License-Identifier: Apache-2.0
// What the claims share: the shipped bicycles, their critical speeds, variants, turns and rides.
// An error of the library ends the program with its text.
#ifndef BICYCLE_TESTS_REPRODUCTION_SHARED_H
#define BICYCLE_TESTS_REPRODUCTION_SHARED_H

#include "claims.h"
#include <bicycle/ride.h>
#include <bicycle/stability.h>
#include <bicycle/turn.h>
#include <bicycle/variant.h>

#define DEGREE 0.017453292519943295

void put(figures *out, double value);

// Ends the program unless the code is 0.
void must(int code, const char *what);

bike_bicycle bicycle_of(const char *shipped);
bike_model model_of(const bike_bicycle *bicycle);
bike_model shipped_model(const char *shipped);

// The first weave and capsize speeds and the stable range between 0 and `fastest`; NaN where there
// is none.
typedef struct limits {
  double weave, capsize; // m/s
  double low, high;      // m/s  of the first stable range
  int ranges;            //      how many
} limits;
limits limits_of(const bike_bicycle *bicycle, double fastest);

bike_bicycle varied(const bike_bicycle *from, bike_variation variation, double value,
                    bike_front_hold hold);
double present(const bike_bicycle *bicycle, bike_variation variation);
// The bicycle without the part that is the rider.
bike_bicycle without_rider(const bike_bicycle *from);

// All turns at a speed and an offset; static memory, until the next call.
const bike_turns *turns_at(const bike_model *model, double speed, double offset);
int main_count(const bike_turns *found);

// A ride's rows handed to a function of its own.
bike_ride_result ride_of(const bike_model *model, const bike_state *start, double time,
                         double sample, bike_sample_function *on_sample, void *user);

// The sample function that keeps the last row in the bike_sample that is `user`.
int keep_sample(const bike_sample *sample, const bike_sample_more *more, void *user);

// Rank of a matrix of at most MAX_ENTRIES, row-major; pivots up to `threshold` count as zero.
enum { MAX_ENTRIES = 256 };
int rank_of(const double *matrix, int rows, int columns, double threshold);

#endif
