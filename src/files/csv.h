// SPDX-License-Identifier: Apache-2.0
// Tables of numbers: a header of names, comma-separated rows, all of the same length. Blanks around
// names and numbers and empty lines are passed over; quotes are not known. Errors of all functions:
// BIKE_ERROR_FILE, BIKE_ERROR_SYNTAX or BIKE_ERROR_MEMORY with one line.
#ifndef FILES_CSV_H
#define FILES_CSV_H

#include <bicycle/file.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { BIKE_CSV_COLUMNS = 64, BIKE_CSV_NAME_SIZE = 64 };

typedef struct bike_csv_header {
  int columns;                                     //
  char name[BIKE_CSV_COLUMNS][BIKE_CSV_NAME_SIZE]; // all different, none empty
} bike_csv_header;

// The place of a column, or -1.
int bike_csv_column(const bike_csv_header *header, const char *name);

//---------------------------------- writing -------------------------------------------------------

// A line of names, and one of numbers with 17 digits, whatever the locale.
void bike_csv_write_names(FILE *stream, const char *const names[], int count);
void bike_csv_write_row(FILE *stream, const double values[], int count);

//---------------------------------- row by row ----------------------------------------------------

// A table that is read on: whatever its length, it takes no more memory than its longest line.
typedef struct bike_csv_reader {
  bike_csv_header header;
  long line;    // of the row last read, from 1
  char *path;   //
  FILE *stream; //
  char *buffer; // of `size` bytes; what is read and not yet taken: begin .. end
  size_t size, begin, end;
  bool at_end;     // nothing follows in the stream
  bool not_finite; // to be set: NaN and infinities are read too
} bike_csv_reader;

// Opens a file and reads its header. Close it in any case.
int bike_csv_open(bike_csv_reader *out, const char *path, bike_file_error *error);

// The numbers of the next row, header.columns of them, all finite without `not_finite`. `found` is
// false at the end.
int bike_csv_next(double *row, bool *found, bike_csv_reader *reader, bike_file_error *error);
void bike_csv_close(bike_csv_reader *reader);

//---------------------------------- as a whole ----------------------------------------------------

typedef struct bike_csv {
  bike_csv_header header; //
  size_t rows;            //
  double *value;          // rows x columns
  long *line;             // of each row in the file
} bike_csv;

// Reads a table of at most 16 million numbers, 128 MB of memory: BIKE_ERROR_FILE for a larger one.
// `out` is safe to free always.
int bike_csv_read(bike_csv *out, const char *path, bike_file_error *error);
void bike_csv_free(bike_csv *csv);

#endif
