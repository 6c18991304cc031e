// SPDX-License-Identifier: Apache-2.0
#include "message.h"

#include <stdarg.h>
#include <stdio.h>

enum { LONGEST_KEY = 64 }; // of a key in a message: what follows it matters more

int bike_message(bike_file_error *error, int code, const char *format, ...) {
  if (!error) return code;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(error->text, sizeof error->text, format, arguments);
  va_end(arguments);
  for (char *c = error->text; *c; ++c)
    if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
  return code;
}

int bike_message_at(bike_file_error *error, int code, const char *path, int line, const char *key,
                    const char *what) {
  if (line <= 0) return bike_message(error, code, "%s: %s", path, what);
  if (!key) return bike_message(error, code, "%s:%d: %s", path, line, what);
  return bike_message(error, code, "%s:%d: %.*s: %s", path, line, LONGEST_KEY, key, what);
}
