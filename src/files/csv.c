// SPDX-License-Identifier: Apache-2.0
#include "csv.h"

#include "message.h"
#include "number.h"
#include "text.h"

#include <bicycle/error.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum {
  SHOWN = 40,
  FIRST_SIZE = 1 << 16,  // of the buffer: most lines fit many times; doubled as needed
  LONGEST_LINE = 1 << 24 // far more than all columns with all digits of a double; bounds the memory
};

// Longer than any input that is typed or recorded by hand, and bounded.
static const size_t MOST_NUMBERS = (size_t)16 << 20;

typedef struct span {
  const char *begin, *end;
} span;

static int fail(const bike_csv_reader *r, bike_file_error *error, const char *key,
                const char *what) {
  int line = r->line < INT_MAX ? (int)r->line : INT_MAX;
  return bike_message_at(error, BIKE_ERROR_SYNTAX, r->path, line, key, what);
}

static span trim(const char *begin, const char *end) {
  while (begin < end && (*begin == ' ' || *begin == '\t')) ++begin;
  while (begin < end && strchr(" \t\r", end[-1])) --end;
  return (span){begin, end};
}

//---------------------------------- lines ---------------------------------------------------------

// A larger buffer for a line that fills it.
static int enlarge(bike_csv_reader *r, bike_file_error *error) {
  if (r->size >= LONGEST_LINE) {
    ++r->line;
    return fail(r, error, NULL, "the line is too long");
  }
  char *larger = realloc(r->buffer, 2 * r->size);
  if (!larger) return bike_message(error, BIKE_ERROR_MEMORY, "%s: out of memory", r->path);
  r->buffer = larger;
  r->size *= 2;
  return BIKE_OK;
}

// Reads on behind what is left in the buffer.
static int refill(bike_csv_reader *r, bike_file_error *error) {
  r->end -= r->begin;
  memmove(r->buffer, r->buffer + r->begin, r->end);
  r->begin = 0;
  const int code = r->end == r->size ? enlarge(r, error) : BIKE_OK;
  if (code) return code;
  r->end += fread(r->buffer + r->end, 1, r->size - r->end, r->stream);
  r->at_end = feof(r->stream);
  return ferror(r->stream) ? bike_message_system(error, r->path, errno) : BIKE_OK;
}

// Takes a line as it is, without its end; false where more has to be read or nothing is left.
static bool take_line(bike_csv_reader *r, span *out) {
  char *begin = r->buffer + r->begin, *end = r->buffer + r->end;
  char *feed = memchr(begin, '\n', r->end - r->begin);
  if (!feed && (!r->at_end || begin == end)) return false;
  *out = (span){begin, feed ? feed : end};
  r->begin = feed ? (size_t)(feed + 1 - r->buffer) : r->end;
  ++r->line;
  return true;
}

// The next line that is not empty.
static int next_line(span *out, bool *found, bike_csv_reader *r, bike_file_error *error) {
  static const char mark[] = "\xef\xbb\xbf"; // of the byte order
  for (;;) {
    while (!take_line(r, out)) {
      *found = false;
      if (r->at_end) return BIKE_OK;
      const int code = refill(r, error);
      if (code) return code;
    }
    const size_t size = (size_t)(out->end - out->begin);
    if (r->line == 1 && size >= 3 && memcmp(out->begin, mark, 3) == 0) out->begin += 3;
    const char *objection = bike_text_objection(out->begin, (size_t)(out->end - out->begin));
    if (objection) return fail(r, error, NULL, objection);
    *out = trim(out->begin, out->end);
    *found = true;
    if (out->begin < out->end) return BIKE_OK;
  }
}

// Takes the next cell off a line; false when none is left. A line "a," has two cells.
static bool next_cell(span *line, span *cell) {
  if (!line->begin) return false;
  const char *comma = memchr(line->begin, ',', (size_t)(line->end - line->begin));
  *cell = trim(line->begin, comma ? comma : line->end);
  line->begin = comma ? comma + 1 : NULL;
  return true;
}

//---------------------------------- row by row ----------------------------------------------------

int bike_csv_column(const bike_csv_header *header, const char *name) {
  for (int i = 0; i < header->columns; ++i)
    if (strcmp(header->name[i], name) == 0) return i;
  return -1;
}

static int read_name(bike_csv_reader *r, span cell, bike_file_error *error) {
  bike_csv_header *h = &r->header;
  const size_t length = (size_t)(cell.end - cell.begin);
  if (h->columns == BIKE_CSV_COLUMNS) return fail(r, error, NULL, "too many columns");
  if (length == 0) return fail(r, error, NULL, "a column has no name");
  if (length >= BIKE_CSV_NAME_SIZE) return fail(r, error, NULL, "a column's name is too long");
  char *name = h->name[h->columns];
  bike_text_name(name, BIKE_CSV_NAME_SIZE, cell.begin, length); // without tabs, returns
  if (bike_csv_column(h, name) >= 0) return fail(r, error, name, "the column is given twice");
  ++h->columns;
  return BIKE_OK;
}

static int read_header(bike_csv_reader *r, bike_file_error *error) {
  span line, cell;
  bool found;
  int code = next_line(&line, &found, r, error);
  if (!code && !found)
    return bike_message(error, BIKE_ERROR_SYNTAX, "%s: the file is empty", r->path);
  while (!code && next_cell(&line, &cell)) code = read_name(r, cell, error);
  return code;
}

int bike_csv_open(bike_csv_reader *out, const char *path, bike_file_error *error) {
  *out = (bike_csv_reader){.path = strdup(path), .buffer = malloc(FIRST_SIZE), .size = FIRST_SIZE};
  if (!out->path || !out->buffer)
    return bike_message(error, BIKE_ERROR_MEMORY, "%s: out of memory", path);
  int code = bike_text_open(&out->stream, path, error);
  return code ? code : read_header(out, error);
}

int bike_csv_next(double *row, bool *found, bike_csv_reader *r, bike_file_error *error) {
  const bike_csv_header *h = &r->header;
  span line, cell;
  int code = next_line(&line, found, r, error), i = 0;
  if (code || !*found) return code;
  for (; next_cell(&line, &cell); ++i) {
    if (i == h->columns) return fail(r, error, NULL, "more numbers than columns");
    const size_t length = (size_t)(cell.end - cell.begin);
    const char *wrong = bike_number_parse(&row[i], cell.begin, length);
    if (!wrong) continue;
    if (r->not_finite && bike_number_is_not_finite(&row[i], cell.begin, length)) continue;
    char what[128];
    snprintf(what, sizeof what, "'%.*s' %s", length < SHOWN ? (int)length : SHOWN, cell.begin,
             wrong);
    return fail(r, error, h->name[i], what);
  }
  return i < h->columns ? fail(r, error, h->name[i], "the number is missing") : BIKE_OK;
}

void bike_csv_close(bike_csv_reader *r) {
  if (r->stream) fclose(r->stream);
  free(r->path);
  free(r->buffer);
  *r = (bike_csv_reader){0};
}

//---------------------------------- as a whole ----------------------------------------------------

// Room for one more row.
static int grow(bike_csv *out, size_t *capacity, const char *path, bike_file_error *error) {
  const size_t columns = (size_t)out->header.columns;
  if (out->rows < *capacity) return BIKE_OK;
  if ((out->rows + 1) * columns > MOST_NUMBERS)
    return bike_message(error, BIKE_ERROR_FILE,
                        "%s: holds more than %zu numbers (128 MB in memory)", path, MOST_NUMBERS);
  const size_t larger = *capacity ? 2 * *capacity : 256;
  double *value = realloc(out->value, larger * columns * sizeof *value);
  if (value) out->value = value;
  long *line = value ? realloc(out->line, larger * sizeof *line) : NULL;
  if (line) out->line = line;
  if (!line) return bike_message(error, BIKE_ERROR_MEMORY, "%s: out of memory", path);
  *capacity = larger;
  return BIKE_OK;
}

static int read_rows(bike_csv *out, bike_csv_reader *r, bike_file_error *error) {
  size_t capacity = 0;
  out->header = r->header;
  for (;;) {
    bool found;
    int code = grow(out, &capacity, r->path, error);
    if (code) return code;
    code = bike_csv_next(out->value + out->rows * (size_t)r->header.columns, &found, r, error);
    if (code || !found) return code;
    out->line[out->rows++] = r->line;
  }
}

int bike_csv_read(bike_csv *out, const char *path, bike_file_error *error) {
  bike_csv_reader r;
  *out = (bike_csv){0};
  int code = bike_csv_open(&r, path, error);
  if (!code) code = read_rows(out, &r, error);
  bike_csv_close(&r);
  if (code) bike_csv_free(out);
  return code;
}

void bike_csv_free(bike_csv *csv) {
  free(csv->value);
  free(csv->line);
  *csv = (bike_csv){0};
}
