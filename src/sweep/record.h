// SPDX-License-Identifier: Apache-2.0
// A row as text: a line of CSV, and in the log with a check sum at its end.
#ifndef SWEEP_RECORD_H
#define SWEEP_RECORD_H

#include "evaluate.h"

#include <stddef.h>
#include <stdio.h>

// The names of the columns: index, the axes, the outputs, error. Without a line feed.
void sweep_print_columns(FILE *stream, const sweep_spec *spec);

// Whether at least one output of the point failed.
bool sweep_row_failed(const sweep_row *row, const sweep_spec *spec);

// A record of the log: the row, a comma, CRC-32 of the row in eight hexadecimal digits, a line
// feed. False when memory is short.
bool sweep_print_record(FILE *stream, const sweep_row *row, const sweep_spec *spec);

// A record read back: `size` bytes of CSV at `text`.
typedef struct sweep_record {
  long index;
  const char *text;
  size_t size;
  bool failed; // at least one output did
} sweep_record;

// Reads a line without its line feed. False where it is torn or damaged.
bool sweep_parse_record(sweep_record *out, const char *line, size_t size);

#endif
