// SPDX-License-Identifier: Apache-2.0
#include "tasks.h"

#include <math.h>
#include <stdlib.h>

// A share takes this long: short enough that a signal is obeyed soon and that workers end at about
// the same time, long enough that handing out is nothing beside it.
static const double SHARE_TIME = 0.25; // s
// Who hands out needs 50 microseconds for a share that comes by MPI. Of more workers than this the
// shares are longer, so that half of its time is free.
static const double MOST_ASKING = 2500;
static const long MOST_SHARE = 4096; // points: bounds the memory of a share's records

// A shard gets at least this many blocks, where there are as many points: dear regions of a map are
// shared evenly.
static const long BLOCKS_PER_SHARD = 64;

static long clamp(long value, long low, long high) {
  return value < low ? low : value > high ? high : value;
}

static bool is_own(const sweep_tasks *t, long index) {
  return index / t->block % t->shard.count == t->shard.number - 1;
}

static long count_own(const sweep_tasks *t) {
  const long round = t->block * t->shard.count, before = (t->shard.number - 1) * t->block;
  return t->points / round * t->block + clamp(t->points % round - before, 0, t->block);
}

bool sweep_tasks_begin(sweep_tasks *out, long points, sweep_shard shard) {
  *out = (sweep_tasks){.points = points, .shard = shard};
  out->block = clamp(points / (shard.count * BLOCKS_PER_SHARD), 1, MOST_SHARE);
  out->done = calloc((size_t)points / 8 + 1, 1);
  out->own = out->left = count_own(out);
  return out->done != NULL;
}

void sweep_tasks_end(sweep_tasks *tasks) {
  free(tasks->done);
  *tasks = (sweep_tasks){0};
}

static bool is_done(const sweep_tasks *t, long index) {
  return t->done[index / 8] >> (index % 8) & 1;
}

bool sweep_tasks_mark(sweep_tasks *t, long index) {
  if (index < 0 || index >= t->points || !is_own(t, index) || is_done(t, index)) return false;
  t->done[index / 8] |= (uint8_t)(1U << (index % 8));
  t->done_count++;
  t->left--;
  return true;
}

bool sweep_tasks_next(sweep_tasks *t, sweep_range *out, long most) {
  while (t->cursor < t->points && (!is_own(t, t->cursor) || is_done(t, t->cursor)))
    t->cursor += is_own(t, t->cursor) ? 1 : t->block - t->cursor % t->block;
  if (t->cursor >= t->points) return false;
  *out = (sweep_range){.first = t->cursor};
  while (out->count < most && t->cursor < t->points && is_own(t, t->cursor) &&
         !is_done(t, t->cursor)) {
    out->count++;
    t->cursor++;
  }
  t->left -= out->count;
  return true;
}

long sweep_tasks_share(const sweep_tasks *t, double rate, int workers) {
  const double wanted = rate * SHARE_TIME * fmax(1, workers / MOST_ASKING);
  const long most = clamp(t->left / (2L * workers), 1, MOST_SHARE);
  return wanted < (double)most ? clamp((long)wanted, 1, most) : most;
}
