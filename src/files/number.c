// SPDX-License-Identifier: Apache-2.0
#include "number.h"

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// A decimal halfway between two doubles has at most 768 significant digits: of what follows the
// first KEPT digits, only whether it is zero can matter to rounding.
enum { KEPT = 800 };

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

// The exponent, or the largest one may be: with the digits of any text it gives zero or infinity.
static long long exponent_of(const char *text, const char *end) {
  static const long long largest = 1LL << 60;
  const char *at = skip_sign(text, end);
  const bool negative = at < end && *text == '-';
  long long value = 0;
  for (; at < end; ++at) value = value < largest / 10 ? 10 * value + (*at - '0') : largest;
  return negative ? -value : value;
}

// Writes a decimal again with at most KEPT + 1 digits, such that it rounds to the same double.
static void shorten(char out[KEPT + 32], const char *text, const char *end) {
  const char *at = skip_sign(text, end);
  const bool negative = at > text && *text == '-';
  char digits[KEPT + 2];
  size_t kept = 0;
  long long exponent = 0;
  bool point = false, more = false;
  for (; at < end && (*at == '.' || is_digit(*at)); ++at) {
    if (*at == '.') {
      point = true;
      continue;
    }
    exponent -= point;
    if (kept == KEPT) {
      ++exponent;
      more |= *at != '0';
    } else if (kept > 0 || *at != '0') {
      digits[kept++] = *at;
    }
  }
  if (more) {
    digits[kept++] = '1';
    --exponent;
  }
  digits[kept] = '\0';
  if (at < end) exponent += exponent_of(at + 1, end);
  snprintf(out, KEPT + 32, "%s0%se%lld", negative ? "-" : "", digits, exponent);
}

// "nan", ".nan", "nan(0x8)", "-nan(ind)", "1.#QNAN", "inf", "Infinity" ...: as YAML, C and its
// runtimes print them. Gives the number.
static bool read_not_finite(double *out, const char *text, const char *end) {
  static const struct {
    const char *word;
    bool infinite, more; // more may follow
  } words[] = {{"nan", false, false},  {".nan", false, false},    {"inf", true, false},
               {".inf", true, false},  {"infinity", true, false}, {"nan(", false, true},
               {"1.#inf", true, true}, {"1.#", false, true}};
  const char *begin = skip_sign(text, end);
  const size_t length = (size_t)(end - begin);
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
    const size_t size = strlen(words[i].word);
    if (words[i].more ? length < size : length != size) continue;
    if (strncasecmp(begin, words[i].word, size) != 0) continue;
    *out = words[i].infinite ? (*text == '-' ? -INFINITY : INFINITY) : NAN;
    return true;
  }
  return false;
}

bool bike_number_is_not_finite(double *out, const char *text, size_t length) {
  return read_not_finite(out, text, text + length);
}

const char *bike_number_parse(double *out, const char *text, size_t length) {
  double value;
  char copy[KEPT + 32];
  if (!is_decimal(text, text + length))
    return read_not_finite(&value, text, text + length) ? "is not finite" : "is not a number";
  if (length < sizeof copy) {
    memcpy(copy, text, length);
    copy[length] = '\0';
  } else {
    shorten(copy, text, text + length);
  }
  value = strtod_l(copy, NULL, c_locale());
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
