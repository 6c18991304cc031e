// SPDX-License-Identifier: Apache-2.0
// A part of a sweep, for job arrays.
#ifndef SWEEP_SHARD_H
#define SWEEP_SHARD_H

#include <stdbool.h>

enum { SWEEP_MOST_SHARDS = 1000000 };

typedef struct sweep_shard {
  long number; // 1 .. count
  long count;  //
} sweep_shard;

// "K/N", 1 <= K <= N; or "slurm": from SLURM_ARRAY_TASK_ID, _MIN, _MAX, _COUNT and _STEP, whatever
// number the array begins with. On failure `why` says what is wrong with them or with the text.
bool sweep_parse_shard(sweep_shard *out, const char *text, const char **why);

#endif
