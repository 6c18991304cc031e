// SPDX-License-Identifier: Apache-2.0
#include "terminal/table.h"

#include "terminal/message.h"

#include <stdlib.h>
#include <string.h>

typedef struct table_row {
  term_style style;
  char **cells;
} table_row;

struct term_table {
  const term_column *columns;
  int column_count;
  table_row *rows;
  size_t row_count, row_room;
};

term_table *term_table_create(const term_column *columns, int count) {
  term_table *table = calloc(1, sizeof *table);
  if (!table) {
    term_lose();
    return NULL;
  }
  table->columns = columns;
  table->column_count = count;
  return table;
}

static void free_cells(char **cells, int count) {
  for (int i = 0; cells && i < count; i++) free(cells[i]);
  free(cells);
}

void term_table_free(term_table *table) {
  if (!table) return;
  for (size_t i = 0; i < table->row_count; i++)
    free_cells(table->rows[i].cells, table->column_count);
  free(table->rows);
  free(table);
}

static bool make_room(term_table *table) {
  if (table->row_count < table->row_room) return true;
  size_t room = table->row_room ? 2 * table->row_room : 16;
  table_row *rows = realloc(table->rows, room * sizeof *rows);
  if (!rows) return false;
  table->rows = rows;
  table->row_room = room;
  return true;
}

static char **copy_cells(const char *const *cells, int count) {
  char **copy = calloc((size_t)count, sizeof *copy);
  for (int i = 0; copy && i < count; i++) {
    copy[i] = strdup(cells[i] ? cells[i] : "");
    if (!copy[i]) {
      free_cells(copy, count);
      copy = NULL;
    }
  }
  return copy;
}

void term_table_add(term_table *table, term_style style, const char *const *cells) {
  if (!table) return;
  char **copy = make_room(table) ? copy_cells(cells, table->column_count) : NULL;
  if (copy)
    table->rows[table->row_count++] = (table_row){style, copy};
  else
    term_lose();
}

// Characters on the terminal: bytes of UTF-8 that do not continue a character.
static int text_width(const char *text) {
  int width = 0;
  for (; *text; text++) width += ((unsigned char)*text & 0xC0) != 0x80;
  return width;
}

static int column_width(const term_table *table, int column) {
  int width = text_width(table->columns[column].header);
  for (size_t i = 0; i < table->row_count; i++) {
    int cell = text_width(table->rows[i].cells[column]);
    if (cell > width) width = cell;
  }
  return width;
}

// The cell, padded; the last column of a row of left-aligned text gets no trailing blanks.
static void print_cell(const term_table *table, int column, int width, const char *text,
                       FILE *stream) {
  int pad = width - text_width(text);
  bool last = column == table->column_count - 1;
  if (column > 0) fputs("  ", stream);
  if (table->columns[column].align == TERM_RIGHT)
    fprintf(stream, "%*s%s", pad, "", text);
  else
    fprintf(stream, "%s%*s", text, last ? 0 : pad, "");
}

static void print_headers(const term_table *table, const int *widths, FILE *stream) {
  fputs(term_style_begin(stream, TERM_BOLD), stream);
  for (int c = 0; c < table->column_count; c++)
    print_cell(table, c, widths[c], table->columns[c].header, stream);
  fprintf(stream, "%s\n", term_style_end(stream, TERM_BOLD));
}

static void print_row(const term_table *table, const table_row *row, const int *widths,
                      FILE *stream) {
  fputs(term_style_begin(stream, row->style), stream);
  for (int c = 0; c < table->column_count; c++)
    print_cell(table, c, widths[c], row->cells[c], stream);
  fprintf(stream, "%s\n", term_style_end(stream, row->style));
}

bool term_table_print(const term_table *table, FILE *stream) {
  if (!table) return false;
  int *widths = calloc((size_t)table->column_count, sizeof *widths);
  if (!widths) term_lose();
  if (!widths || term_has_lost()) {
    free(widths);
    return false;
  }
  for (int c = 0; c < table->column_count; c++) widths[c] = column_width(table, c);
  print_headers(table, widths, stream);
  for (size_t i = 0; i < table->row_count; i++) print_row(table, &table->rows[i], widths, stream);
  free(widths);
  return true;
}
