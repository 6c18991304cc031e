// SPDX-License-Identifier: Apache-2.0
// Stable ranges of a bicycle along a variation.
#ifndef BICYCLE_CLI_FIGURES_RANGE_CURVE_H
#define BICYCLE_CLI_FIGURES_RANGE_CURVE_H

#include "terminal/number.h"

#include <bicycle/stability.h>
#include <bicycle/variant.h>

typedef struct range_sample {
  double value;                        // of the variation
  int count;                           // stable ranges; -1: no such bicycle
  double ranges[BIKE_MAX_CRITICAL][2]; // m/s
} range_sample;

typedef struct range_curve {
  int count;
  range_sample *samples; // rising values
} range_curve;

// Samples at the values, between them where a limit is steep, and on both sides of every change of
// the number of ranges, so close that no picture shows a gap. Speeds from 0 to `fastest`. MEMORY,
// or an error of the bicycle as it is.
int range_curve_make(range_curve *out, const bike_bicycle *bicycle, bike_variation variation,
                     bike_front_hold hold, const term_range *values, double fastest);
void range_curve_free(range_curve *curve);

#endif
