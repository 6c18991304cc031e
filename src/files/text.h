// SPDX-License-Identifier: Apache-2.0
// Text files as a whole.
#ifndef FILES_TEXT_H
#define FILES_TEXT_H

#include <bicycle/file.h>
#include <stddef.h>

// A UTF-8 text file in memory, a byte order mark left out.
typedef struct bike_text {
  char *data;  // `size` bytes and a terminator; to be freed
  size_t size; //
} bike_text;

// Reads a file of at most `limit` bytes. Folders, larger files and files with control characters
// (binaries, zeros) or what is not UTF-8 are BIKE_ERROR_FILE or BIKE_ERROR_SYNTAX; memory grows
// with what the file really holds, never beyond the limit.
int bike_text_read(bike_text *out, const char *path, size_t limit, bike_file_error *error);

void bike_text_free(bike_text *text);

#endif
