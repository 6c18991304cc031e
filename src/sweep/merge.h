// SPDX-License-Identifier: Apache-2.0
// Logs of one sweep into its table: a header and one row a point, in the order of the points,
// whoever computed them.
#ifndef SWEEP_MERGE_H
#define SWEEP_MERGE_H

#include "log.h"

enum { SWEEP_GAPS_SHOWN = 10, SWEEP_GAPS_SIZE = 512 };

typedef struct sweep_merged {
  long points;                      // of the sweep
  long present;                     // with a record
  long failed;                      // of those present: without all their outputs
  long repeated;                    // records of a point that was there already, and the same
  long contradictory;               // the same point with another record
  long damaged;                     // lines passed over
  char gaps[SWEEP_GAPS_SIZE];       // which points are missing, as in "0-99, 120, ..."
  char conflict[BIKE_MESSAGE_SIZE]; // the first contradiction
} sweep_merged;

// Reads the logs and writes the table, whole or not at all, to `output` (NULL: nowhere, "-": the
// standard output): only where no point is contradictory, and none is missing or `partial` allows
// it. BIKE_ERROR_FILE, BIKE_ERROR_SYNTAX, BIKE_ERROR_MEMORY with one line in `error`.
int sweep_merge(sweep_merged *out, const char *const *paths, int count, const char *output,
                bool partial, bike_file_error *error);

// Whether every point is there and none twice with different records.
bool sweep_is_whole(const sweep_merged *merged);

#endif
