// SPDX-License-Identifier: Apache-2.0
#include "terminal/json.h"

#include "files/text.h"
#include "terminal/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void *allocate(size_t size) {
  void *memory = malloc(size);
  if (!memory) term_lose();
  return memory;
}

void term_json_begin(void) {
  json_set_alloc_funcs(allocate, free);
}

json_t *term_json_number(double value) {
  return isfinite(value) ? json_real(value + 0.0) : json_null(); // "0.0" also of a negative zero
}

json_t *term_json_text(const char *text) {
  size_t length = strlen(text), used = 0;
  char *copy = allocate(3 * length + 1);
  for (size_t at = 0, step; copy && at < length; at += step) {
    const size_t whole = bike_text_character(text + at, length - at);
    step = whole ? whole : 1;
    memcpy(copy + used, whole ? text + at : "\ufffd", whole ? whole : 3);
    used += whole ? whole : 3;
  }
  json_t *out = copy ? json_stringn(copy, used) : NULL;
  free(copy);
  return out;
}

json_t *term_json_numbers(const double *values, size_t count) {
  json_t *array = json_array();
  for (size_t i = 0; i < count; i++) json_array_append_new(array, term_json_number(values[i]));
  return array;
}

json_t *term_json_matrix(const double *values, size_t rows, size_t columns) {
  json_t *array = json_array();
  for (size_t i = 0; i < rows; i++)
    json_array_append_new(array, term_json_numbers(values + i * columns, columns));
  return array;
}

json_t *term_json_texts(const char *const *texts, size_t count) {
  json_t *array = json_array();
  for (size_t i = 0; i < count; i++) json_array_append_new(array, json_string(texts[i]));
  return array;
}

bool term_json_write(json_t *document, FILE *stream) {
  if (!document) return false;
  // 17 significant digits identify every double.
  bool written = !term_has_lost() &&
                 json_dumpf(document, stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == 0 &&
                 fputc('\n', stream) != EOF;
  json_decref(document);
  return written || ferror(stream);
}
