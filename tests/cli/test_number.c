// SPDX-License-Identifier: Apache-2.0
// Numbers of a command line are taken whole and finite, or not at all.
#include "support/near.h"
#include "support/random.h"
#include "terminal/number.h"

#include <locale.h>
#include <math.h>
#include <string.h>

static const double untouched = 12345;

static void numbers(void **state) {
  (void)state;
  static const struct {
    const char *text;
    double value;
  } right[] = {{"0", 0},       {"-1.5", -1.5}, {"+2", 2},     {"1e3", 1000}, {".5", 0.5},
               {"1E-2", 0.01}, {"5.", 5},      {"1e-400", 0}, {"0.1", 0.1},  {"1e308", 1e308}};
  static const char *const wrong[] = {"",          " 1",    "1 ",   "1.5abc", "nan", "NaN", "inf",
                                      "-infinity", "1e999", "0x10", "1,5",    "--1", "1-",  "e5",
                                      ".",         "-",     "1e",   "1deg",   "1\n"};
  for (size_t i = 0; i < sizeof right / sizeof right[0]; i++) {
    double value = untouched;
    assert_true(term_parse_number(&value, right[i].text));
    assert_near(value, right[i].value, 0);
  }
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
    double value = untouched;
    if (term_parse_number(&value, wrong[i])) fail_msg("'%s' was taken", wrong[i]);
    assert_near(value, untouched, 0);
  }
}

static void angles(void **state) {
  (void)state;
  double value = untouched;
  assert_true(term_parse_angle(&value, "-5deg"));
  assert_near(value, -5 * M_PI / 180, 1e-16);
  assert_true(term_parse_angle(&value, "0.25"));
  assert_near(value, 0.25, 0);
  static const char *const wrong[] = {"deg",    "5 deg",    "5degrees", "5Deg",
                                      "nandeg", "1e999deg", "5degdeg",  "5rad"};
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
    if (term_parse_angle(&value, wrong[i])) fail_msg("'%s' was taken", wrong[i]);
}

static void ranges(void **state) {
  (void)state;
  term_range range;
  assert_true(term_parse_range(&range, "0.1:0.7:7"));
  assert_near(term_range_point(&range, 0), 0.1, 0);
  assert_near(term_range_point(&range, 6), 0.7, 0);
  assert_near(term_range_point(&range, 3), 0.4, 1e-16);
  assert_true(term_parse_range(&range, "-3:-3:1"));
  assert_near(term_range_point(&range, 0), -3, 0);
  assert_true(term_parse_angle_range(&range, "-5deg:0.25:3"));
  assert_near(term_range_point(&range, 0), -5 * M_PI / 180, 1e-16);
  assert_near(term_range_point(&range, 2), 0.25, 0);
  double interval[2];
  assert_true(term_parse_interval(interval, "0:20"));
  static const char *const wrong[] = {"0:1", "0:1:0", "0:1:1", "1:1:2",   "1:0:3",  "0:1:2:3",
                                      "::",  "0:1:",  "0:x:3", "0:1:2.5", "0:nan:3"};
  for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
    if (term_parse_range(&range, wrong[i]) || term_parse_angle_range(&range, wrong[i]))
      fail_msg("'%s' was taken", wrong[i]);
  if (term_parse_range(&range, "0deg:5deg:3")) fail_msg("numbers have no unit");
  static const char *const wrong_interval[] = {"1", "1:1", "2:1", ":1", "1:", "0:1:2", "a:b"};
  for (size_t i = 0; i < sizeof wrong_interval / sizeof wrong_interval[0]; i++)
    if (term_parse_interval(interval, wrong_interval[i]))
      fail_msg("'%s' was taken", wrong_interval[i]);
}

static void expect_number(double expected, const char *text) {
  double value = untouched;
  if (!term_parse_number(&value, text)) fail_msg("'%.40s...' was refused", text);
  if (memcmp(&value, &expected, sizeof value) != 0)
    fail_msg("'%.40s...': %a instead of %a", text, value, expected);
}

// Whatever its length, a decimal gives the double next to it; a tie the even one. Numbers halfway
// between two doubles, which long double holds exactly, have the most digits that matter.
static void any_length(void **state) {
  (void)state;
  static char text[4000];
  random_source random = random_begin("any_length", 1);
  for (int i = 0; i < 500; i++) {
    uint64_t bits = random_bits(&random) >> (i % 3 ? 1 : 12); // every third not normal
    double low;
    memcpy(&low, &bits, sizeof low);
    if (!(low < 1e300)) continue;
    double high = nextafter(low, INFINITY), even = bits % 2 ? high : low;
    snprintf(text, sizeof text, "%.1100f", low);
    expect_number(low, text);
    snprintf(text, sizeof text, "-%.1100f", low);
    expect_number(-low, text);
    long double middle = ((long double)low + high) / 2;
    size_t length = (size_t)snprintf(text, sizeof text, "%.1100Lf", middle);
    expect_number(even, text);
    snprintf(text + length, sizeof text - length, "%01000d", 1);
    expect_number(high, text);
    length = (size_t)snprintf(text, sizeof text, "%.1100Le", middle);
    expect_number(even, text);
  }
}

// Zeros and exponents that make up for each other, or not.
static void long_exponents(void **state) {
  (void)state;
  static char text[4000];
  snprintf(text, sizeof text, "1%01000de-1000", 0);
  expect_number(1, text);
  snprintf(text, sizeof text, "0.%0999d1e1000", 0);
  expect_number(1, text);
  snprintf(text, sizeof text, "%01000d.5e%01000d", 7, 1);
  expect_number(75, text);
  snprintf(text, sizeof text, "0.%01000d", 0);
  expect_number(0, text);
  expect_number(-0.0, "-0e99999999999999999999999");
  expect_number(0, "1e-99999999999999999999999");
  expect_number(2.2250738585072014e-308, "2.2250738585072014e-0000000000000000000308");
  double value = untouched;
  assert_false(term_parse_number(&value, "1e99999999999999999999999"));
  snprintf(text, sizeof text, "1%0400d", 0);
  assert_false(term_parse_number(&value, text));
  snprintf(text, sizeof text, "%.400fx", 0.1);
  assert_false(term_parse_number(&value, text));
  assert_near(value, untouched, 0);
  term_range range;
  double interval[2];
  snprintf(text, sizeof text, "%.400f:%.400f:3", 0.1, 0.7);
  assert_true(term_parse_range(&range, text));
  assert_near(range.last, 0.7, 0);
  snprintf(text, sizeof text, "%.400fdeg:%.400fdeg:3", 0.1, 0.7);
  assert_true(term_parse_angle_range(&range, text));
  assert_near(range.first, 0.1 * (M_PI / 180), 0);
  snprintf(text, sizeof text, "%.400f:%.400f", 0.1, 0.7);
  assert_true(term_parse_interval(interval, text));
  assert_near(interval[1], 0.7, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(numbers), cmocka_unit_test(angles),
                                     cmocka_unit_test(ranges), cmocka_unit_test(any_length),
                                     cmocka_unit_test(long_exponents)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
