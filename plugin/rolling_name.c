// SPDX-License-Identifier: Apache-2.0
// Names by which a model asks for what the discs do: "rolling:NAME:QUANTITY".
#include "rolling_internal.h"

#include <string.h>

static const char prefix[] = "rolling:";
enum { PREFIX = sizeof prefix - 1 };

const char *roll_split_name(const char **object, int *length, const char *name) {
  if (strncmp(name, prefix, PREFIX) != 0) return NULL;
  *object = name + PREFIX;
  const char *last = strrchr(*object, ':'); // NAME may have colons of its own
  *length = last ? (int)(last - *object) : 0;
  return last ? last + 1 : "";
}

static int is_named(const mjModel *m, int address, const char *name, int length) {
  const char *own = roll_element_name(m, address);
  return strncmp(own, name, length) == 0 && own[length] == '\0';
}

// Index in the span, planes left out, or -1.
static int find(const mjModel *m, roll_span span, const char *name, int length) {
  for (int i = 0, index = 0; i < span.count; i++) {
    if (roll_is_ground(m, span.first + i)) continue;
    if (is_named(m, span.first + i, name, length)) return index;
    index++;
  }
  return -1;
}

int roll_find_wheel(const mjModel *m, const char *name, int length) {
  roll_marker marker = roll_find_marker(m);
  int index = find(m, marker.discs, name, length);
  if (index >= 0) return index;
  index = find(m, marker.skates, name, length);
  return index < 0 ? -1 : roll_count_wheels(m, marker.discs) + index;
}

int roll_find_drive(const mjModel *m, const char *name, int length) {
  return find(m, roll_find_marker(m).driven, name, length);
}
