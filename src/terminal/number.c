// SPDX-License-Identifier: Apache-2.0
#include "terminal/number.h"

#include "files/number.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A piece of the text, without a terminator.
typedef struct piece {
  const char *begin;
  size_t length;
} piece;

typedef bool parse_function(double *out, piece text);

static bool parse_number(double *out, piece text) {
  return bike_number_parse(out, text.begin, text.length) == NULL;
}

static bool parse_angle(double *out, piece text) {
  static const char suffix[] = "deg";
  size_t tail = sizeof suffix - 1;
  if (text.length <= tail || memcmp(text.begin + text.length - tail, suffix, tail) != 0)
    return parse_number(out, text);
  double degrees;
  if (!parse_number(&degrees, (piece){text.begin, text.length - tail})) return false;
  *out = degrees * (M_PI / 180);
  return true;
}

bool term_parse_number(double *out, const char *text) {
  return parse_number(out, (piece){text, strlen(text)});
}

bool term_parse_angle(double *out, const char *text) {
  return parse_angle(out, (piece){text, strlen(text)});
}

bool term_parse_integer(long *out, const char *text, long low, long high) {
  char *end;
  if (!*text || text[strspn(text, "+-0123456789")] != '\0') return false;
  errno = 0;
  long value = strtol(text, &end, 10);
  if (errno || end == text || *end || value < low || value > high) return false;
  *out = value;
  return true;
}

// Splits at ':' into exactly `count` texts, each not empty.
static bool split(piece part[], int count, const char *text) {
  for (int i = 0; i < count; i++) {
    part[i] = (piece){text, strcspn(text, ":")};
    text += part[i].length;
    if (part[i].length == 0 || (*text == ':') != (i < count - 1)) return false;
    text += *text == ':';
  }
  return true;
}

bool term_parse_interval(double out[2], const char *text) {
  piece part[2];
  double value[2];
  if (!split(part, 2, text)) return false;
  if (!parse_number(&value[0], part[0]) || !parse_number(&value[1], part[1])) return false;
  if (!(value[0] < value[1])) return false;
  memcpy(out, value, sizeof value);
  return true;
}

static bool parse_range(term_range *out, const char *text, parse_function *parse_end) {
  piece part[3];
  term_range range;
  if (!split(part, 3, text)) return false;
  if (!parse_end(&range.first, part[0]) || !parse_end(&range.last, part[1]) ||
      !term_parse_integer(&range.count, part[2].begin, 1,
                          TERM_MAX_RANGE)) // the last: ends the text
    return false;
  bool one_point = range.first == range.last;
  if (range.first > range.last || one_point != (range.count == 1)) return false;
  *out = range;
  return true;
}

bool term_parse_range(term_range *out, const char *text) {
  return parse_range(out, text, parse_number);
}

bool term_parse_angle_range(term_range *out, const char *text) {
  return parse_range(out, text, parse_angle);
}

double term_range_point(const term_range *range, long index) {
  if (index == range->count - 1) return range->last;
  return range->first + (range->last - range->first) * (double)index / (double)(range->count - 1);
}
