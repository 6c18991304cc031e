// SPDX-License-Identifier: Apache-2.0
// What the layers measure, before anyone judges it.
#ifndef VALIDATE_MEASUREMENT_H
#define VALIDATE_MEASUREMENT_H

#include <stdbool.h>
#include <stddef.h>

enum {
  MEASUREMENT_NAME = 40,
  MEASUREMENT_FULL_NAME = 96,
  MEASUREMENT_METRIC = 96,
  MEASUREMENT_DETAIL = 256
};

typedef struct measurement {
  const char *layer;               // "L2"; static
  char source[MEASUREMENT_NAME];   // label of the engine it belongs to; empty: of both compared
  char signal[MEASUREMENT_NAME];   // "lean"
  const char *metric;              // "max"; static
  const char *unit;                // "rad", "" for a pure number; static
  double from, to;                 // s  the part of the ride; 0, 0: all of it; to 0: to its end
  double value;                    // NaN where it could not be measured
  double time;                     // s, where the value stands; NaN where that means nothing
  char detail[MEASUREMENT_DETAIL]; // what a reader should know, or empty
} measurement;

typedef struct measurement_list {
  measurement *items;
  size_t count, room;
  bool lost; // one could not be stored
} measurement_list;

// A measurement of layer, signal, metric, unit with value NaN, no time, no source, no detail.
measurement measurement_of(const char *layer, const char *signal, const char *metric,
                           const char *unit);

void measurement_detail(measurement *m, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

void measurement_add(measurement_list *list, const measurement *m);
void measurement_clear(measurement_list *list);

// "mujoco.energy", or "lean" for what belongs to both engines.
const char *measurement_full_name(char out[MEASUREMENT_FULL_NAME], const measurement *m);

// "max", or with its part of the ride "max (1 to 3 s)"; `to` 0: "max (from 1 s)".
const char *measurement_metric(char out[MEASUREMENT_METRIC], const char *metric, double from,
                               double to);

// Whether both say the same thing, whatever its value.
bool measurement_is_like(const measurement *a, const measurement *b);

#endif
