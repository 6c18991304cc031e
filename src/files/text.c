// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#include "message.h"

#include <bicycle/error.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/magic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

enum { FIRST_SIZE = 16384 }; // most bicycle files fit; doubled as needed

static const char not_text[] = "control character: this is not a text file";
static const char not_utf8[] = "this is not UTF-8 text";

static int no_memory(const char *path, bike_file_error *error) {
  return bike_message(error, BIKE_ERROR_MEMORY, "%s: out of memory", path);
}

static int too_large(const char *path, size_t limit, bike_file_error *error) {
  return bike_message(error, BIKE_ERROR_FILE, "%s: is larger than %zu bytes", path, limit);
}

static bool is_control(char c) {
  return ((unsigned char)c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
}

// The 1-based line of a byte.
static int line_at(const bike_text *text, size_t at) {
  int line = 1;
  for (size_t k = 0; k < at; ++k) line += text->data[k] == '\n';
  return line;
}

// The line of the first control character of the bytes from `from` on, or 0.
static int control_line(const bike_text *text, size_t from) {
  for (size_t i = from; i < text->size; ++i)
    if (is_control(text->data[i])) return line_at(text, i);
  return 0;
}

// The second byte of a character tells overlong forms, surrogates and what is beyond U+10FFFF,
// which JSON and XML refuse.
static bool is_second(unsigned char first, unsigned char second) {
  const unsigned char low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned char high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  return second >= low && second <= high;
}

size_t bike_text_character(const char *data, size_t left) {
  const unsigned char first = left ? (unsigned char)*data : 0xff;
  const size_t size = first < 0x80   ? 1
                      : first < 0xc2 ? 0
                      : first < 0xe0 ? 2
                      : first < 0xf0 ? 3
                      : first < 0xf5 ? 4
                                     : 0;
  if (size > left) return 0;
  if (size > 1 && !is_second(first, (unsigned char)data[1])) return 0;
  for (size_t k = 2; k < size; ++k)
    if (((unsigned char)data[k] & 0xc0) != 0x80) return 0;
  return size;
}

void bike_text_name(char *out, size_t size, const char *text, size_t length) {
  size_t used = 0;
  for (size_t at = 0, step; at < length; at += step) {
    const size_t whole = bike_text_character(text + at, length - at);
    step = whole ? whole : 1;
    if (used + step >= size) break;
    const bool shown = whole && (unsigned char)text[at] >= 0x20 && text[at] != 0x7f;
    if (shown)
      memcpy(out + used, text + at, step);
    else
      memset(out + used, '?', step);
    used += step;
  }
  out[used] = '\0';
}

// libfyaml reads invalid UTF-8 as an empty value and goes on: it must not come that far.
static int check_utf8(const bike_text *text, const char *path, bike_file_error *error) {
  for (size_t at = 0, size; at < text->size; at += size) {
    size = bike_text_character(text->data + at, text->size - at);
    if (!size)
      return bike_message_at(error, BIKE_ERROR_SYNTAX, path, line_at(text, at), NULL, not_utf8);
  }
  return BIKE_OK;
}

// Appends the stream's bytes, stopping at the first piece that is not text.
static int read_stream(bike_text *out, FILE *stream, const char *path, size_t limit,
                       bike_file_error *error) {
  size_t capacity = 0;
  for (;;) {
    if (capacity - out->size < 2) {
      capacity = capacity ? 2 * capacity : FIRST_SIZE;
      char *larger = realloc(out->data, capacity);
      if (!larger) return no_memory(path, error);
      out->data = larger;
    }
    const size_t from = out->size;
    out->size += fread(out->data + from, 1, capacity - from - 1, stream);
    out->data[out->size] = '\0';
    const int line = control_line(out, from);
    if (line) return bike_message_at(error, BIKE_ERROR_SYNTAX, path, line, NULL, not_text);
    if (out->size > limit) return too_large(path, limit, error);
    if (ferror(stream)) return bike_message_system(error, path, errno);
    if (feof(stream)) return BIKE_OK;
  }
}

static void drop_byte_order_mark(bike_text *text) {
  static const char mark[] = "\xef\xbb\xbf";
  const size_t length = sizeof mark - 1;
  if (text->size < length || memcmp(text->data, mark, length) != 0) return;
  text->size -= length;
  memmove(text->data, text->data + length, text->size + 1);
}

// To open a named pipe is to wait for a writer, perhaps forever. A pipe without a name is one that
// the shell has opened already, /dev/fd/63; so is the one behind /dev/stdin, named or not.
bool bike_text_is_named_pipe(const char *path) {
  struct stat status, input;
  struct statfs system;
  if (stat(path, &status) != 0 || !S_ISFIFO(status.st_mode)) return false;
  if (statfs(path, &system) == 0 && system.f_type == PIPEFS_MAGIC) return false;
  return fstat(STDIN_FILENO, &input) != 0 || input.st_dev != status.st_dev ||
         input.st_ino != status.st_ino;
}

// Opens without waiting, even for the writer of a pipe; reading waits as usual.
static FILE *open_at_once(const char *path) {
  const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
  if (descriptor < 0) return NULL;
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
  FILE *stream = fdopen(descriptor, "r");
  if (!stream) close(descriptor);
  return stream;
}

int bike_text_open(FILE **out, const char *path, bike_file_error *error) {
  struct stat status;
  if (bike_text_is_named_pipe(path))
    return bike_message(error, BIKE_ERROR_FILE,
                        "%s: is a named pipe; give a file, or its text on /dev/stdin", path);
  *out = open_at_once(path);
  int number = errno;
  if (*out && fstat(fileno(*out), &status) == 0 && !S_ISDIR(status.st_mode)) return BIKE_OK;
  if (*out) {
    number = EISDIR;
    fclose(*out);
    *out = NULL;
  }
  return bike_message_system(error, path, number);
}

const char *bike_text_objection(const char *data, size_t size) {
  for (size_t at = 0, step; at < size; at += step) {
    if (is_control(data[at])) return not_text;
    step = bike_text_character(data + at, size - at);
    if (!step) return not_utf8;
  }
  return NULL;
}

int bike_text_read(bike_text *out, const char *path, size_t limit, bike_file_error *error) {
  *out = (bike_text){0};
  FILE *stream = NULL;
  struct stat status;
  int code = bike_text_open(&stream, path, error);
  if (code) return code;
  bool regular = fstat(fileno(stream), &status) == 0 && S_ISREG(status.st_mode);
  code = regular && (size_t)status.st_size > limit ? too_large(path, limit, error)
                                                   : read_stream(out, stream, path, limit, error);
  fclose(stream);
  if (!code) code = check_utf8(out, path, error);
  if (code)
    bike_text_free(out);
  else
    drop_byte_order_mark(out);
  return code;
}

void bike_text_free(bike_text *text) {
  free(text->data);
  *text = (bike_text){0};
}
