// SPDX-License-Identifier: Apache-2.0
#include "memory_stream.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct sink {
  char **text;
  size_t *size;
  size_t room;
  bool lost;
} sink;

static bool make_room(sink *s, size_t needed) {
  if (needed <= s->room) return true;
  size_t room = 2 * needed;
  char *text = realloc(*s->text, room);
  if (!text) return false;
  *s->text = text;
  s->room = room;
  return true;
}

// Of fopencookie: 0 is an error.
static ssize_t write_sink(void *cookie, const char *bytes, size_t count) {
  sink *s = cookie;
  if (!make_room(s, *s->size + count + 1)) {
    s->lost = true;
    return 0;
  }
  memcpy(*s->text + *s->size, bytes, count);
  *s->size += count;
  (*s->text)[*s->size] = '\0';
  return (ssize_t)count;
}

static int close_sink(void *cookie) {
  sink *s = cookie;
  int code = s->lost ? EOF : 0;
  free(s);
  return code;
}

FILE *bike_memory_stream(char **text, size_t *size) {
  enum { FIRST = 64 };
  sink *s = calloc(1, sizeof *s);
  *size = 0;
  *text = calloc(1, FIRST);
  FILE *stream = NULL;
  if (s && *text) {
    *s = (sink){text, size, FIRST, false};
    stream = fopencookie(s, "w", (cookie_io_functions_t){.write = write_sink, .close = close_sink});
  }
  if (stream) return stream;
  free(s);
  free(*text);
  *text = NULL;
  return NULL;
}
