// SPDX-License-Identifier: Apache-2.0
#include "terminal/number.h"

#include "files/number.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Three numbers of a range, with room for people who write all their zeros.
enum { TEXT_SIZE = 128 };

bool term_parse_number(double *out, const char *text) {
  return bike_number_parse(out, text, strlen(text)) == NULL;
}

bool term_parse_angle(double *out, const char *text) {
  static const char suffix[] = "deg";
  size_t length = strlen(text);
  size_t tail = sizeof suffix - 1;
  if (length <= tail || strcmp(text + length - tail, suffix) != 0)
    return term_parse_number(out, text);
  double degrees;
  if (bike_number_parse(&degrees, text, length - tail) != NULL) return false;
  *out = degrees * (M_PI / 180);
  return true;
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
static bool split(char *text, char *part[], int count) {
  for (int i = 0; i < count; i++) {
    part[i] = text;
    char *colon = strchr(text, ':');
    if (colon == text || !*text || (colon != NULL) != (i < count - 1)) return false;
    if (colon) {
      *colon = '\0';
      text = colon + 1;
    }
  }
  return true;
}

static bool copy_text(char out[TEXT_SIZE], const char *text) {
  return snprintf(out, TEXT_SIZE, "%s", text) < TEXT_SIZE;
}

bool term_parse_interval(double out[2], const char *text) {
  char copy[TEXT_SIZE], *part[2];
  double value[2];
  if (!copy_text(copy, text) || !split(copy, part, 2)) return false;
  if (!term_parse_number(&value[0], part[0]) || !term_parse_number(&value[1], part[1]))
    return false;
  if (!(value[0] < value[1])) return false;
  memcpy(out, value, sizeof value);
  return true;
}

typedef bool parse_function(double *out, const char *text);

static bool parse_range(term_range *out, const char *text, parse_function *parse_end) {
  char copy[TEXT_SIZE], *part[3];
  term_range range;
  if (!copy_text(copy, text) || !split(copy, part, 3)) return false;
  if (!parse_end(&range.first, part[0]) || !parse_end(&range.last, part[1]) ||
      !term_parse_integer(&range.count, part[2], 1, TERM_MAX_RANGE))
    return false;
  bool one_point = range.first == range.last;
  if (range.first > range.last || one_point != (range.count == 1)) return false;
  *out = range;
  return true;
}

bool term_parse_range(term_range *out, const char *text) {
  return parse_range(out, text, term_parse_number);
}

bool term_parse_angle_range(term_range *out, const char *text) {
  return parse_range(out, text, term_parse_angle);
}

double term_range_point(const term_range *range, long index) {
  if (index == range->count - 1) return range->last;
  return range->first + (range->last - range->first) * (double)index / (double)(range->count - 1);
}
