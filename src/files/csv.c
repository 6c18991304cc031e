// SPDX-License-Identifier: Apache-2.0
#include "csv.h"

#include "message.h"
#include "number.h"
#include "text.h"

#include <bicycle/error.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A million rows of four 17-digit columns: longer than any ride, and bounded.
static const size_t LARGEST_FILE = (size_t)128 * 1024 * 1024;

enum { SHOWN = 40 };

typedef struct cursor {
  const char *at, *end; // what is left of the file
  int line;             // of the line last taken
  const char *path;
  bike_file_error *error;
} cursor;

typedef struct span {
  const char *begin, *end;
} span;

static int fail(const cursor *c, const char *key, const char *what) {
  return bike_message_at(c->error, BIKE_ERROR_SYNTAX, c->path, c->line, key, what);
}

static span trim(const char *begin, const char *end) {
  while (begin < end && (*begin == ' ' || *begin == '\t')) ++begin;
  while (begin < end && strchr(" \t\r", end[-1])) --end;
  return (span){begin, end};
}

// The next line that is not empty.
static bool next_line(cursor *c, span *out) {
  while (c->at < c->end) {
    const char *feed = memchr(c->at, '\n', (size_t)(c->end - c->at));
    const char *stop = feed ? feed : c->end;
    *out = trim(c->at, stop);
    c->at = feed ? feed + 1 : c->end;
    ++c->line;
    if (out->begin < out->end) return true;
  }
  return false;
}

// Takes the next cell off a line; false when none is left. A line "a," has two cells.
static bool next_cell(span *line, span *cell) {
  if (!line->begin) return false;
  const char *comma = memchr(line->begin, ',', (size_t)(line->end - line->begin));
  *cell = trim(line->begin, comma ? comma : line->end);
  line->begin = comma ? comma + 1 : NULL;
  return true;
}

static int read_name(bike_csv *out, span cell, const cursor *c) {
  const size_t length = (size_t)(cell.end - cell.begin);
  if (out->columns == BIKE_CSV_COLUMNS) return fail(c, NULL, "too many columns");
  if (length == 0) return fail(c, NULL, "a column has no name");
  if (length >= BIKE_CSV_NAME_SIZE) return fail(c, NULL, "a column's name is too long");
  char *name = out->name[out->columns];
  memcpy(name, cell.begin, length);
  name[length] = '\0';
  if (bike_csv_column(out, name) >= 0) return fail(c, name, "the column is given twice");
  ++out->columns;
  return BIKE_OK;
}

static int read_header(bike_csv *out, cursor *c) {
  span line, cell;
  if (!next_line(c, &line))
    return bike_message(c->error, BIKE_ERROR_SYNTAX, "%s: the file is empty", c->path);
  int code = BIKE_OK;
  while (!code && next_cell(&line, &cell)) code = read_name(out, cell, c);
  return code;
}

static int grow(bike_csv *out, size_t *capacity, const cursor *c) {
  if (out->rows < *capacity) return BIKE_OK;
  const size_t larger = *capacity ? 2 * *capacity : 256;
  double *value = realloc(out->value, larger * (size_t)out->columns * sizeof *value);
  if (value) out->value = value;
  int *line = value ? realloc(out->line, larger * sizeof *line) : NULL;
  if (line) out->line = line;
  if (!line) return bike_message(c->error, BIKE_ERROR_MEMORY, "%s: out of memory", c->path);
  *capacity = larger;
  return BIKE_OK;
}

static int read_row(bike_csv *out, span line, const cursor *c) {
  double *row = out->value + out->rows * (size_t)out->columns;
  span cell;
  int i = 0;
  for (; next_cell(&line, &cell); ++i) {
    if (i == out->columns) return fail(c, NULL, "more numbers than columns");
    const size_t length = (size_t)(cell.end - cell.begin);
    const char *wrong = bike_number_parse(&row[i], cell.begin, length);
    if (!wrong) continue;
    char what[128];
    snprintf(what, sizeof what, "'%.*s' %s", length < SHOWN ? (int)length : SHOWN, cell.begin,
             wrong);
    return fail(c, out->name[i], what);
  }
  if (i < out->columns) return fail(c, out->name[i], "the number is missing");
  out->line[out->rows++] = c->line;
  return BIKE_OK;
}

int bike_csv_read(bike_csv *out, const char *path, bike_file_error *error) {
  *out = (bike_csv){0};
  bike_text text;
  int code = bike_text_read(&text, path, LARGEST_FILE, error);
  if (code) return code;
  cursor c = {text.data, text.data + text.size, 0, path, error};
  code = read_header(out, &c);
  size_t capacity = 0;
  span line;
  while (!code && next_line(&c, &line)) {
    code = grow(out, &capacity, &c);
    if (!code) code = read_row(out, line, &c);
  }
  bike_text_free(&text);
  if (code) bike_csv_free(out);
  return code;
}

void bike_csv_free(bike_csv *csv) {
  free(csv->value);
  free(csv->line);
  *csv = (bike_csv){0};
}

int bike_csv_column(const bike_csv *csv, const char *name) {
  for (int i = 0; i < csv->columns; ++i)
    if (strcmp(csv->name[i], name) == 0) return i;
  return -1;
}
