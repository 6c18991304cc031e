// SPDX-License-Identifier: Apache-2.0
// The answers at the points of a sweep.
#ifndef SWEEP_EVALUATE_H
#define SWEEP_EVALUATE_H

#include "point.h"

enum { SWEEP_RANGES_SIZE = 1024 }; // of stable ranges as text, and a terminator: 16 of 51 at most

// One point and its answers. An output without one has none: its number is NaN, its text empty.
typedef struct sweep_row {
  long index;
  double values[SWEEP_MOST_AXES];     // of the axes
  double numbers[SWEEP_OUTPUT_COUNT]; // by sweep_output; NaN: there is none
  const char *outcome;                // static
  char ranges[SWEEP_RANGES_SIZE];     // of speeds, "LO:HI;LO:HI"
  int codes[SWEEP_OUTPUT_COUNT];      // of the library: why an output failed; BIKE_OK: it did not
  char error[SWEEP_REASON_SIZE];      // why there is no such bicycle; empty: there is
} sweep_row;

enum { SWEEP_MOST_ROWS = 64 }; // in one call

// Points first .. first + count - 1 into rows[0 .. count - 1], count <= SWEEP_MOST_ROWS. Every row
// depends on its own point alone, bit for bit, however points are grouped: resuming, shards and
// ranks rest on it. False where memory is short, which is no answer: the rows then mean nothing.
// Called from several threads at a time.
typedef bool sweep_evaluate_function(sweep_row *rows, const sweep_spec *spec, long first,
                                     long count);

// Rides go side by side in the lanes of an ensemble.
sweep_evaluate_function sweep_evaluate;

#endif
