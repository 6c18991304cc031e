// SPDX-License-Identifier: Apache-2.0
// Tables of numbers: a header of names, comma-separated rows, all of the same length.
#ifndef FILES_CSV_H
#define FILES_CSV_H

#include <bicycle/file.h>
#include <stddef.h>

enum { BIKE_CSV_COLUMNS = 64, BIKE_CSV_NAME_SIZE = 64 };

typedef struct bike_csv {
  int columns;                                     //
  char name[BIKE_CSV_COLUMNS][BIKE_CSV_NAME_SIZE]; // all different, none empty
  size_t rows;                                     //
  double *value;                                   // rows x columns, finite
  int *line;                                       // of each row in the file
} bike_csv;

// Reads a file. Blanks around names and numbers and empty lines are passed over; quotes are not
// known. BIKE_ERROR_FILE, BIKE_ERROR_SYNTAX or BIKE_ERROR_MEMORY; `out` is safe to free always.
int bike_csv_read(bike_csv *out, const char *path, bike_file_error *error);
void bike_csv_free(bike_csv *csv);

// The place of a column, or -1.
int bike_csv_column(const bike_csv *csv, const char *name);

#endif
