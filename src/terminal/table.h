// SPDX-License-Identifier: Apache-2.0
// Tables for a person: columns aligned over all rows, colour where there is a terminal.
#ifndef BICYCLE_TERMINAL_TABLE_H
#define BICYCLE_TERMINAL_TABLE_H

#include "terminal/color.h"

typedef enum term_align { TERM_LEFT, TERM_RIGHT } term_align;

typedef struct term_column {
  const char *header; // UTF-8
  term_align align;
} term_column;

typedef struct term_table term_table;

// A table of `count` columns; `columns` must stay valid. NULL when out of memory; the functions
// below then do nothing, and term_table_print says so.
term_table *term_table_create(const term_column *columns, int count);
void term_table_free(term_table *table);

// Adds a row of as many cells as there are columns; the texts are copied. NULL is an empty cell.
void term_table_add(term_table *table, term_style style, const char *const *cells);

// Prints headers and rows. False when a row was lost for want of memory.
bool term_table_print(const term_table *table, FILE *stream);

#endif
