// SPDX-License-Identifier: Apache-2.0
// What becomes of the samples of a ride: rows of a CSV, columns of a JSON document, a summary.
#ifndef BICYCLE_CLI_RIDE_RECORD_H
#define BICYCLE_CLI_RIDE_RECORD_H

#include "terminal/convention.h"
#include "terminal/json.h"
#include "terminal/progress.h"

#include <bicycle/ride.h>
#include <bicycle/table.h>
#include <stdio.h>

typedef struct ride_record {
  FILE *rows;                     // NULL: no CSV
  json_t *columns;                // an array for each column; NULL: none wanted
  bike_convention convention;     // of both, and of `last`
  double duration;                // s  asked for, for the progress bar
  bool shows_progress;            //
  term_progress progress;         //
  long count;                     //    of samples so far
  double last[BIKE_COLUMN_COUNT]; //
  double start_energy;            // J
  double work;                    // J
  double balance;                 //    largest |E(t) - E(0) - work| / E(0)
} ride_record;

// Writes the header row and makes the columns where these are wanted.
void ride_record_begin(ride_record *record, bool wants_columns);
void ride_record_free(ride_record *record);

// The bike_sample_function's work.
void ride_record_add(ride_record *record, const bike_sample *sample, const bike_sample_more *more);

// The last sample under the names of its columns; there must be one.
json_t *ride_record_end(const ride_record *record);

#endif
