// SPDX-License-Identifier: Apache-2.0
#include "message.h"

#include <bicycle/error.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST_KEY = 64 }; // of a key in a message: what follows it matters more

// Copies the end of `whole` over that of `out`, a part of its beginning; no character is cut.
static void keep_end(char *out, size_t size, const char *whole, size_t length) {
  static const char gap[] = "...";
  const size_t begin = size / 4;
  const char *end = whole + length - (size - begin - sizeof gap);
  char *at = out + begin;
  while (at > out && ((unsigned char)*at & 0xc0) == 0x80) at--;
  while (((unsigned char)*end & 0xc0) == 0x80) end++;
  snprintf(at, size - (size_t)(at - out), "%s%s", gap, end);
}

void bike_message_fit(char *out, size_t size, const char *format, va_list arguments) {
  va_list again;
  va_copy(again, arguments);
  int length = vsnprintf(out, size, format, arguments);
  char *whole = length >= 0 && (size_t)length >= size ? malloc((size_t)length + 1) : NULL;
  if (whole) {
    vsnprintf(whole, (size_t)length + 1, format, again);
    keep_end(out, size, whole, (size_t)length);
  }
  va_end(again);
  free(whole);
}

int bike_message(bike_file_error *error, int code, const char *format, ...) {
  if (!error) return code;
  va_list arguments;
  va_start(arguments, format);
  bike_message_fit(error->text, sizeof error->text, format, arguments);
  va_end(arguments);
  for (char *c = error->text; *c; ++c)
    if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
  return code;
}

int bike_message_system(bike_file_error *error, const char *path, int number) {
  if (number == ENOMEM) return bike_message(error, BIKE_ERROR_MEMORY, "%s: out of memory", path);
  return bike_message(error, BIKE_ERROR_FILE, "%s: %s", path, strerror(number));
}

int bike_message_at(bike_file_error *error, int code, const char *path, int line, const char *key,
                    const char *what) {
  if (line <= 0) return bike_message(error, code, "%s: %s", path, what);
  if (!key) return bike_message(error, code, "%s:%d: %s", path, line, what);
  return bike_message(error, code, "%s:%d: %.*s: %s", path, line, LONGEST_KEY, key, what);
}
