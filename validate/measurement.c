// SPDX-License-Identifier: Apache-2.0
#include "measurement.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

measurement measurement_of(const char *layer, const char *signal, const char *metric,
                           const char *unit) {
  measurement m = {.layer = layer, .metric = metric, .unit = unit, .value = NAN, .time = NAN};
  snprintf(m.signal, sizeof m.signal, "%s", signal);
  return m;
}

void measurement_detail(measurement *m, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(m->detail, sizeof m->detail, format, arguments);
  va_end(arguments);
}

void measurement_add(measurement_list *list, const measurement *m) {
  if (list->count == list->room) {
    size_t room = list->room ? 2 * list->room : 64;
    measurement *items = realloc(list->items, room * sizeof *items);
    if (!items) {
      list->lost = true;
      return;
    }
    list->items = items;
    list->room = room;
  }
  list->items[list->count++] = *m;
}

void measurement_clear(measurement_list *list) {
  free(list->items);
  *list = (measurement_list){0};
}

const char *measurement_full_name(char out[MEASUREMENT_FULL_NAME], const measurement *m) {
  snprintf(out, MEASUREMENT_FULL_NAME, "%s%s%s", m->source, *m->source ? "." : "", m->signal);
  return out;
}

const char *measurement_metric(char out[MEASUREMENT_METRIC], const char *metric, double from,
                               double to) {
  if (from > 0 && to > 0)
    snprintf(out, MEASUREMENT_METRIC, "%s (%.6g to %.6g s)", metric, from, to);
  else if (from > 0 || to > 0)
    snprintf(out, MEASUREMENT_METRIC, "%s (%s %.6g s)", metric, from > 0 ? "from" : "to",
             from > 0 ? from : to);
  else
    snprintf(out, MEASUREMENT_METRIC, "%s", metric);
  return out;
}

bool measurement_is_like(const measurement *a, const measurement *b) {
  return strcmp(a->layer, b->layer) == 0 && strcmp(a->source, b->source) == 0 &&
         strcmp(a->signal, b->signal) == 0 && strcmp(a->metric, b->metric) == 0 &&
         a->from == b->from && a->to == b->to;
}
