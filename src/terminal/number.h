// SPDX-License-Identifier: Apache-2.0
// Numbers as people type them on a command line: the whole text must be one finite number.
#ifndef BICYCLE_TERMINAL_NUMBER_H
#define BICYCLE_TERMINAL_NUMBER_H

#include <stdbool.h>

// A decimal number: digits, one point, an exponent. No blanks, no "nan", "inf", hexadecimal or
// overflow; the point is a point in every locale. False leaves `out` untouched.
bool term_parse_number(double *out, const char *text);

// An angle or a rate of an angle: radians, or degrees with the suffix "deg".
bool term_parse_angle(double *out, const char *text);

// A whole number, low <= number <= high.
bool term_parse_integer(long *out, const char *text, long low, long high);

// "LO:HI" with LO < HI.
bool term_parse_interval(double out[2], const char *text);

// "A:B:N": N >= 2 evenly spaced points from A to B > A, both included, or "A:A:1".
typedef struct term_range {
  double first, last;
  long count;
} term_range;

enum { TERM_MAX_RANGE = 1000000 };

bool term_parse_range(term_range *out, const char *text);

// The same of angles: A and B in radians or, with the suffix deg, in degrees.
bool term_parse_angle_range(term_range *out, const char *text);

// Point `index` of a range; the ends are exact.
double term_range_point(const term_range *range, long index);

#endif
