// SPDX-License-Identifier: Apache-2.0
// Which points are still to be computed, and by whom: the one list behind threads, shards and
// ranks.
#ifndef SWEEP_TASKS_H
#define SWEEP_TASKS_H

#include "shard.h"

#include <stdbool.h>
#include <stdint.h>

// Points first .. first + count - 1.
typedef struct sweep_range {
  long first, count;
} sweep_range;

typedef struct sweep_tasks {
  long points;       // of the whole sweep
  sweep_shard shard; // of which this is a part
  long block;        // shards take blocks of this many points in turn
  long own;          // points of this shard
  uint8_t *done;     // a bit each, of the whole sweep
  long done_count;   // of this shard
  long cursor;       // everything before is done or handed out
  long left;         // not handed out
} sweep_tasks;

// Nothing done. False when memory is short.
bool sweep_tasks_begin(sweep_tasks *out, long points, sweep_shard shard);
void sweep_tasks_end(sweep_tasks *tasks);

// A point that is done already. False where it was marked before, or belongs to another shard.
bool sweep_tasks_mark(sweep_tasks *tasks, long index);

// The next points to compute, neighbours, at most `most` >= 1 of them. False where none is left.
bool sweep_tasks_next(sweep_tasks *tasks, sweep_range *out, long most);

// How many points to hand to one of `workers` who computes `rate` points a second (0: not known
// yet).
long sweep_tasks_share(const sweep_tasks *tasks, double rate, int workers);

#endif
