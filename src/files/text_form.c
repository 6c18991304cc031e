// SPDX-License-Identifier: Apache-2.0
#include "text_form.h"

#include "message.h"
#include "number.h"

#include <bicycle/error.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST_NAME = 15, SHOWN = 40 };

// A piece of the file's text, without a terminator.
typedef struct piece {
  const char *begin, *end;
} piece;

typedef struct place {
  const char *path;
  int line;
  bike_file_error *error;
} place;

static bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

static piece trim(piece p) {
  while (p.begin < p.end && is_blank(*p.begin)) ++p.begin;
  while (p.begin < p.end && is_blank(p.end[-1])) --p.end;
  return p;
}

static size_t length_of(piece p) {
  return (size_t)(p.end - p.begin);
}

static const char *find(piece p, const char *text) {
  return memmem(p.begin, length_of(p), text, strlen(text));
}

// The line at *at, without comment and blanks around it; *at moves behind it.
static piece next_line(const char **at, const char *end) {
  const char *line_end = memchr(*at, '\n', (size_t)(end - *at));
  if (!line_end) line_end = end;
  piece line = {*at, line_end};
  const char *comment = memchr(line.begin, '#', length_of(line));
  if (comment) line.end = comment;
  *at = line_end < end ? line_end + 1 : end;
  return trim(line);
}

bool bike_is_text_form(const bike_text *text) {
  const char *at = text->data, *end = text->data + text->size;
  while (at < end) {
    const piece line = next_line(&at, end);
    if (line.begin == line.end) continue;
    const char *equals = find(line, "=");
    const char *colon = find(line, ":");
    return equals && (!colon || equals < colon);
  }
  return false;
}

static int fail(const place *where, const char *key, const char *what) {
  return bike_message_at(where->error, BIKE_ERROR_SYNTAX, where->path, where->line, key, what);
}

static int read_number(double *out, piece text, const char *key, const place *where) {
  text = trim(text);
  const char *wrong = bike_number_parse(out, text.begin, length_of(text));
  if (!wrong) return BIKE_OK;
  char what[128];
  snprintf(what, sizeof what, "'%.*s' %s", length_of(text) < SHOWN ? (int)length_of(text) : SHOWN,
           text.begin, wrong);
  return fail(where, key, what);
}

// A number with a common power of ten appended, as decimal text: exact, unlike a product.
static int read_scaled(double *out, piece text, piece power, const char *key, const place *where) {
  char *joined;
  text = trim(text);
  if (length_of(power) == 0) return read_number(out, text, key, where);
  const int size = asprintf(&joined, "%.*s%.*s", (int)length_of(text), text.begin,
                            (int)length_of(power), power.begin);
  if (size < 0)
    return bike_message(where->error, BIKE_ERROR_MEMORY, "%s: out of memory", where->path);
  const int code = read_number(out, (piece){joined, joined + size}, key, where);
  free(joined);
  return code;
}

// value, value+/-sigma, or (value+/-sigma)e-05
static int read_value(double *value, double *sigma, piece text, const char *key,
                      const place *where) {
  *sigma = 0;
  piece power = {text.end, text.end};
  if (text.begin < text.end && *text.begin == '(') {
    const char *close = find(text, ")");
    if (!close) return fail(where, key, "a bracket is not closed");
    power = trim((piece){close + 1, text.end});
    text = (piece){text.begin + 1, close};
  }
  const char *sign = find(text, "+/-");
  if (!sign) return read_scaled(value, text, power, key, where);
  int code = read_scaled(value, (piece){text.begin, sign}, power, key, where);
  if (!code) code = read_scaled(sigma, (piece){sign + 3, text.end}, power, key, where);
  if (!code && *sigma < 0) return fail(where, key, "the uncertainty must not be negative");
  return code;
}

static int read_line(bike_symbols *out, piece line, const place *where) {
  const char *equals = find(line, "=");
  if (!equals) return fail(where, NULL, "must be of the form `name = value`");
  const piece name = trim((piece){line.begin, equals});
  char key[LONGEST_NAME + 1];
  snprintf(key, sizeof key, "%.*s",
           length_of(name) < LONGEST_NAME ? (int)length_of(name) : LONGEST_NAME, name.begin);
  const int index = bike_symbol_index(key);
  if (index == BIKE_SYMBOL_UNKNOWN) return fail(where, key, "unknown key");
  double value, sigma;
  const int code = read_value(&value, &sigma, trim((piece){equals + 1, line.end}), key, where);
  if (code || index == BIKE_SYMBOL_UNUSED) return code;
  if (out->line[index]) return fail(where, key, "given twice");
  out->value[index] = value;
  out->sigma[index] = sigma;
  out->line[index] = where->line;
  return BIKE_OK;
}

int bike_read_text_form(bike_symbols *out, const bike_text *text, const char *path,
                        bike_file_error *error) {
  *out = (bike_symbols){0};
  place where = {path, 0, error};
  const char *at = text->data, *end = text->data + text->size;
  while (at < end) {
    ++where.line;
    const piece line = next_line(&at, end);
    const int code = line.begin < line.end ? read_line(out, line, &where) : BIKE_OK;
    if (code) return code;
  }
  return BIKE_OK;
}
