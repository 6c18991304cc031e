// SPDX-License-Identifier: Apache-2.0
#include "number.h"

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// A number longer than this is no measurement; it bounds the copy that strtod needs.
enum { LONGEST_NUMBER = 127 };

// glibc returns its static "C" locale here: nothing to free, nothing that fails.
static locale_t c_locale(void) {
  return newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

static bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

static const char *skip_digits(const char *text, const char *end) {
  while (text < end && is_digit(*text)) ++text;
  return text;
}

static const char *skip_sign(const char *text, const char *end) {
  return text < end && (*text == '+' || *text == '-') ? text + 1 : text;
}

// [+-] digits [. digits] [e [+-] digits], with a digit before or after the point.
static bool is_decimal(const char *text, const char *end) {
  const char *whole = skip_sign(text, end);
  const char *at = skip_digits(whole, end);
  long digits = at - whole;
  if (at < end && *at == '.') {
    const char *fraction = at + 1;
    at = skip_digits(fraction, end);
    digits += at - fraction;
  }
  if (digits == 0) return false;
  if (at < end && (*at == 'e' || *at == 'E')) {
    const char *exponent = skip_sign(at + 1, end);
    at = skip_digits(exponent, end);
    if (at == exponent) return false;
  }
  return at == end;
}

// The spellings of YAML and of C, so that they are refused for what they are.
static bool is_not_finite(const char *text, const char *end) {
  static const char *const words[] = {"nan", ".nan", "inf", ".inf", "infinity"};
  const char *word = skip_sign(text, end);
  const size_t length = (size_t)(end - word);
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
    if (length == strlen(words[i]) && strncasecmp(word, words[i], length) == 0) return true;
  return false;
}

const char *bike_number_parse(double *out, const char *text, size_t length) {
  if (is_not_finite(text, text + length)) return "is not finite";
  if (length > LONGEST_NUMBER || !is_decimal(text, text + length)) return "is not a number";
  char copy[LONGEST_NUMBER + 1];
  memcpy(copy, text, length);
  copy[length] = '\0';
  const double value = strtod_l(copy, NULL, c_locale());
  if (!isfinite(value)) return "is too large";
  *out = value;
  return NULL;
}

void bike_number_print(char out[BIKE_NUMBER_SIZE], double value) {
  const locale_t old = uselocale(c_locale());
  snprintf(out, BIKE_NUMBER_SIZE, "%.17g", value);
  uselocale(old);
}

void bike_number_print_point(char out[BIKE_NUMBER_SIZE], double value) {
  bike_number_print(out, value);
  if (strchr(out, '.')) return;
  const size_t mantissa = strcspn(out, "e");
  memmove(out + mantissa + 2, out + mantissa, strlen(out + mantissa) + 1);
  memcpy(out + mantissa, ".0", 2);
}
