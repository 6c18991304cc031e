// SPDX-License-Identifier: Apache-2.0
// One-line messages about files.
#ifndef FILES_MESSAGE_H
#define FILES_MESSAGE_H

#include <bicycle/file.h>
#include <stdarg.h>
#include <stddef.h>

// vsnprintf, but what does not fit is left out after the first quarter: a path may be of any
// length, and the reason stands behind it. size >= 16.
void bike_message_fit(char *out, size_t size, const char *format, va_list arguments)
    __attribute__((format(printf, 3, 0)));

// Writes one line into `error` (may be NULL): control characters become '?', so that what a broken
// file holds cannot break the line or the terminal. Returns `code`.
int bike_message(bike_file_error *error, int code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// "path: " and what the number of an errno means: BIKE_ERROR_MEMORY for ENOMEM, else
// BIKE_ERROR_FILE.
int bike_message_system(bike_file_error *error, const char *path, int number);

// "path:line: key: what", or "path:line: what" without a key, or "path: what" for line 0.
int bike_message_at(bike_file_error *error, int code, const char *path, int line, const char *key,
                    const char *what);

#endif
