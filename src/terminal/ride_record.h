// SPDX-License-Identifier: Apache-2.0
// What becomes of the samples of a ride: rows of a CSV, columns of a JSON document, a summary.
#ifndef BICYCLE_TERMINAL_RIDE_RECORD_H
#define BICYCLE_TERMINAL_RIDE_RECORD_H

#include "terminal/convention.h"
#include "terminal/json.h"
#include "terminal/progress.h"

#include <bicycle/ride.h>
#include <bicycle/table.h>
#include <stdio.h>

typedef struct term_record {
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
} term_record;

// Wants the samples as columns of a JSON document.
void term_record_make_columns(term_record *record);
void term_record_free(term_record *record);

// The bike_sample_function's work. The header row goes out with the first row: a ride that cannot
// start writes nothing.
void term_record_add(term_record *record, const bike_sample *sample, const bike_sample_more *more);

// One more row, and how far the ride is.
void term_record_count(term_record *record, double time);

// A sample under the names of its columns; NULL: the last one, which there must be.
json_t *term_record_end(const term_record *record, const bike_sample *end);

#endif
