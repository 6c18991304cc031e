// SPDX-License-Identifier: Apache-2.0
// Any part of the document as HTML: objects as lists, arrays of objects as tables.
#include "report_html_tree.h"

#include "report_markup.h"

// Deeper than any part of a report; a saved file may hold anything.
enum { DEEPEST = 8, MOST_ROWS = 200 };

static void print_value(FILE *stream, const json_t *value, int depth);

static void print_object(FILE *stream, const json_t *object, int depth) {
  const char *key;
  json_t *value;
  fputs("<dl>", stream);
  json_object_foreach((json_t *)object, key, value) {
    report_markup(stream, "<dt>%s<dd>", key);
    print_value(stream, value, depth + 1);
  }
  fputs("</dl>\n", stream);
}

// Columns are the keys of the first object.
static void print_table(FILE *stream, const json_t *rows, int depth) {
  const char *key;
  json_t *unused;
  json_t *first = json_array_get(rows, 0);
  fputs("<div class=wide><table class=sortable><thead><tr>", stream);
  json_object_foreach(first, key, unused) report_markup(stream, "<th>%s", key);
  fputs("</tr></thead><tbody>\n", stream);
  for (size_t i = 0; i < json_array_size(rows) && i < MOST_ROWS; i++) {
    fputs("<tr>", stream);
    json_object_foreach(first, key, unused) {
      fputs("<td>", stream);
      print_value(stream, json_object_get(json_array_get(rows, i), key), depth + 1);
    }
    fputs("</tr>\n", stream);
  }
  fputs("</tbody></table></div>\n", stream);
}

static void print_list(FILE *stream, const json_t *array, int depth) {
  for (size_t i = 0; i < json_array_size(array) && i < MOST_ROWS; i++) {
    if (i) fputs(", ", stream);
    print_value(stream, json_array_get(array, i), depth + 1);
  }
}

static void print_value(FILE *stream, const json_t *value, int depth) {
  char number[REPORT_NUMBER];
  if (depth > DEEPEST)
    fputs("...", stream);
  else if (json_is_object(value))
    print_object(stream, value, depth);
  else if (json_is_array(value) && json_is_object(json_array_get(value, 0)))
    print_table(stream, value, depth);
  else if (json_is_array(value))
    print_list(stream, value, depth);
  else if (json_is_integer(value))
    fprintf(stream, "%lld", (long long)json_integer_value(value));
  else if (json_is_real(value)) {
    snprintf(number, sizeof number, "%.6g", json_real_value(value));
    fputs(number, stream);
  } else if (json_is_string(value))
    report_escape(stream, json_string_value(value));
  else
    fputs(json_is_true(value) ? "yes" : json_is_false(value) ? "no" : "-", stream);
}

void report_html_tree(FILE *stream, const json_t *value) {
  print_value(stream, value, 0);
}
