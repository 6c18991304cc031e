// SPDX-License-Identifier: Apache-2.0
// The changes to a bicycle that section 4 of Franke, Suhr and Riess (1990) speaks of, made.
#ifndef BICYCLE_CLI_EFFECTS_LIST_H
#define BICYCLE_CLI_EFFECTS_LIST_H

#include <bicycle/effects.h>
#include <bicycle/stability.h>

enum { EFFECTS_CHANGES = 10 };

// One change and what it does. With `error` it cannot be made: only name, unit, held are set.
typedef struct effects_change {
  const char *name, *unit, *held;
  int error;
  double from, to;
  double weave, capsize; // m/s  afterwards; NaN where none
  int range_count;
  double ranges[BIKE_MAX_CRITICAL][2];
  double weave_slope, capsize_slope; // before, m/s per unit; NaN where there is no such speed
} effects_change;

typedef struct effects_list {
  bike_file file;
  bike_effects effects;
  double speed;           // m/s    of the lean per offset
  double lean_per_offset; // rad/m  NaN without a rider
  int count;
  effects_change changes[EFFECTS_CHANGES];
} effects_list;

// Of the bicycle in out->file. `search` NULL: 0 to bike_search_end. `speed` NaN: the middle of the
// first stable range, 5 m/s where there is none. These numbers and the changes are those of
// bicycles that people ride: for very small or large ones those of the similar bicycle.
int effects_list_make(effects_list *out, const double search[2], double speed);

#endif
