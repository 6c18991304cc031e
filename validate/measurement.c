// SPDX-License-Identifier: Apache-2.0
#include "measurement.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

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
