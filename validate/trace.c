// SPDX-License-Identifier: Apache-2.0
#include "trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MEMBER(name, unit, member)                                                                 \
  { name, unit, offsetof(trace_row, member) }

const trace_signal trace_signals[TRACE_SIGNAL_COUNT] = {
    MEMBER("x", "m", sample.x),
    MEMBER("y", "m", sample.y),
    MEMBER("yaw", "rad", sample.yaw),
    MEMBER("lean", "rad", sample.lean),
    MEMBER("pitch", "rad", sample.pitch),
    MEMBER("steer", "rad", sample.steer),
    MEMBER("lean_rate", "rad/s", sample.lean_rate),
    MEMBER("steer_rate", "rad/s", sample.steer_rate),
    MEMBER("speed", "m/s", sample.speed),
    MEMBER("rear_angle", "rad", sample.rear_angle),
    MEMBER("front_angle", "rad", sample.front_angle),
    MEMBER("energy", "J", sample.energy),
    MEMBER("rear_normal", "N", sample.rear_normal),
    MEMBER("front_normal", "N", sample.front_normal),
    MEMBER("rear_friction", "", sample.rear_friction),
    MEMBER("front_friction", "", sample.front_friction),
    MEMBER("work", "J", more.work),
    MEMBER("rear_force_forward", "N", more.rear_force[0]),
    MEMBER("rear_force_left", "N", more.rear_force[1]),
    MEMBER("rear_force_up", "N", more.rear_force[2]),
    MEMBER("front_force_forward", "N", more.front_force[0]),
    MEMBER("front_force_left", "N", more.front_force[1]),
    MEMBER("front_force_up", "N", more.front_force[2]),
    MEMBER("rear_slip", "m/s", slip[0]),
    MEMBER("front_slip", "m/s", slip[1]),
    MEMBER("rear_height", "m", height[0]),
    MEMBER("front_height", "m", height[1]),
};

bool trace_add(trace *t, const trace_row *row) {
  if (t->count == t->room) {
    size_t room = t->room ? 2 * t->room : 1024;
    trace_row *rows = realloc(t->rows, room * sizeof *rows);
    if (!rows) return false;
    t->rows = rows;
    t->room = room;
  }
  t->rows[t->count++] = *row;
  return true;
}

void trace_clear(trace *t) {
  free(t->rows);
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++) free(t->flaws[i].place);
  *t = (trace){0};
}

static bool ends_a_ride(bike_event_kind kind) {
  return kind == BIKE_EVENT_LEAN_LIMIT || kind == BIKE_EVENT_VALIDITY ||
         kind == BIKE_EVENT_STANDSTILL;
}

void trace_end(trace *t, bool complete, double end_time, const bike_event *events, int count) {
  t->complete = complete;
  t->end_time = end_time;
  if (complete) return;
  t->end_event.time = end_time;
  t->end_event.kind = BIKE_EVENT_VALIDITY; // of an engine that does not say
  for (int i = 0; i < count && i < BIKE_MAX_EVENTS; i++)
    if (ends_a_ride(events[i].kind)) t->end_event = events[i];
}

const trace_signal *trace_find_signal(const char *name) {
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    if (strcmp(trace_signals[i].name, name) == 0) return &trace_signals[i];
  return NULL;
}

bool trace_is_contact(const trace_signal *signal) {
  return signal->offset >= offsetof(trace_row, slip);
}

bool trace_has(const trace *t, const trace_signal *signal) {
  return !(t->missing >> (signal - trace_signals) & 1);
}

double trace_value(const trace_row *row, const trace_signal *signal) {
  double value;
  memcpy(&value, (const char *)row + signal->offset, sizeof value);
  return value;
}

void trace_blank_missing(trace *t) {
  const double none = NAN;
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    for (size_t k = 0; !trace_has(t, &trace_signals[i]) && k < t->count; k++)
      memcpy((char *)&t->rows[k] + trace_signals[i].offset, &none, sizeof none);
}

const char *trace_ending(const trace *t) {
  if (t->complete) return NULL;
  return t->ending ? t->ending : bike_event_string(t->end_event.kind);
}

static bool may_be_not_finite(const trace_signal *signal) {
  return strstr(signal->name, "_friction") != NULL;
}

long trace_first_not_finite(const trace *t) {
  for (size_t k = 0; k < t->count; k++)
    for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
      if (!may_be_not_finite(&trace_signals[i]) && !t->flaws[i].place &&
          trace_has(t, &trace_signals[i]) && !isfinite(trace_value(&t->rows[k], &trace_signals[i])))
        return (long)k;
  return -1;
}
