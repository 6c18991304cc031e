// SPDX-License-Identifier: Apache-2.0
#include "report_markup.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

static const char *entity(char c) {
  switch (c) {
  case '<':
    return "&lt;";
  case '>':
    return "&gt;";
  case '&':
    return "&amp;";
  case '"':
    return "&quot;";
  case '\'':
    return "&#39;";
  default: // XML 1.0, 2.2: no control characters but tab and line ends
    return (unsigned char)c < ' ' && !strchr("\t\n\r", c) ? "\xEF\xBF\xBD" : NULL;
  }
}

void report_escape(FILE *stream, const char *text) {
  for (; *text; text++) {
    const char *replacement = entity(*text);
    if (replacement)
      fputs(replacement, stream);
    else
      fputc(*text, stream);
  }
}

void report_url(FILE *stream, const char *text) {
  static const char plain[] = "-._~0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  for (; *text; text++) {
    if (strchr(plain, *text))
      fputc(*text, stream);
    else
      fprintf(stream, "%%%02X", (unsigned char)*text);
  }
}

void report_markup(FILE *stream, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  for (const char *c = format; *c; c++) {
    if (*c != '%') {
      fputc(*c, stream);
      continue;
    }
    if (*++c == 's')
      report_escape(stream, va_arg(arguments, const char *));
    else if (*c == 'u')
      report_url(stream, va_arg(arguments, const char *));
    else
      fputc('%', stream);
  }
  va_end(arguments);
}

const char *report_number(char out[REPORT_NUMBER], double value) {
  if (isnan(value))
    snprintf(out, REPORT_NUMBER, "-");
  else
    snprintf(out, REPORT_NUMBER, "%.3g", value);
  return out;
}

const char *report_quantity(char out[REPORT_NUMBER], double value, const char *unit) {
  char number[REPORT_NUMBER];
  report_number(number, value);
  snprintf(out, REPORT_NUMBER, "%.20s%s%.20s", number, *unit && !isnan(value) ? " " : "",
           isnan(value) ? "" : unit);
  return out;
}

const char *report_margin(char out[REPORT_NUMBER], double use) {
  if (use == 0)
    snprintf(out, REPORT_NUMBER, "exact");
  else if (isfinite(use))
    snprintf(out, REPORT_NUMBER, "%.3gx", 1 / use);
  else
    snprintf(out, REPORT_NUMBER, "-");
  return out;
}

void report_base64(FILE *stream, const unsigned char *bytes, size_t size) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < size; i += 3) {
    size_t left = size - i;
    unsigned group = (unsigned)bytes[i] << 16;
    if (left > 1) group |= (unsigned)bytes[i + 1] << 8;
    if (left > 2) group |= bytes[i + 2];
    fputc(digits[group >> 18], stream);
    fputc(digits[group >> 12 & 63], stream);
    fputc(left > 1 ? digits[group >> 6 & 63] : '=', stream);
    fputc(left > 2 ? digits[group & 63] : '=', stream);
  }
}
