// SPDX-License-Identifier: Apache-2.0
// Comparison of doubles for the tests: cmocka's own assert_float_equal compares floats.
#ifndef BICYCLE_TESTS_SUPPORT_NEAR_H
#define BICYCLE_TESTS_SUPPORT_NEAR_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// Fails unless |actual - expected| <= tolerance; NaN on any side fails.
static inline void near_check(double actual, double expected, double tolerance, const char *what,
                              const char *file, int line) {
  double error = fabs(actual - expected);
  if (!(error <= tolerance)) {
    print_error("%s: %.17g is not %.17g: off by %.3g, allowed %.3g\n", what, actual, expected,
                error, tolerance);
    _fail(file, line);
  }
}

// Absolute error.
#define assert_near(actual, expected, tolerance)                                                   \
  near_check(actual, expected, tolerance, #actual, __FILE__, __LINE__)

// Error relative to the expected value's size; use assert_near where that may be zero.
#define assert_relative(actual, expected, tolerance)                                               \
  near_check(actual, expected, (tolerance)*fabs(expected), #actual, __FILE__, __LINE__)

// A measured quantity that must stay below a limit; NaN fails.
#define assert_below(actual, limit) near_check(actual, 0, limit, #actual, __FILE__, __LINE__)

#endif
