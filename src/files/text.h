// SPDX-License-Identifier: Apache-2.0
// Text files: as a whole, and what a reader of pieces needs.
#ifndef FILES_TEXT_H
#define FILES_TEXT_H

#include <bicycle/file.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

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

// Opens a file for reading; folders and named pipes are refused. This is
// the one rule of all inputs: what the shell has opened (/dev/stdin, <(command)) is read.
int bike_text_open(FILE **out, const char *path, bike_file_error *error);

// Whether `path` is a pipe that opening might wait for.
bool bike_text_is_named_pipe(const char *path);

// What keeps bytes from being UTF-8 text without control characters; NULL: nothing. No character
// may be cut at their end.
const char *bike_text_objection(const char *data, size_t size);

// Bytes of the UTF-8 character that begins there, or 0 where there is none, of `left` bytes.
size_t bike_text_character(const char *data, size_t left);

// Copies what fits of a name from anywhere: whole characters; what is none, or a control character,
// becomes '?'. `out` has room for `size` bytes, the terminator among them.
void bike_text_name(char *out, size_t size, const char *text, size_t length);

#endif
