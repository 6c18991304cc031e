// SPDX-License-Identifier: Apache-2.0
#include "shard.h"

#include "terminal/number.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Slurm numbers tasks from 0 to 4000000 at most.
enum { LARGEST_TASK = 1 << 22 };

static bool read_variable(long *out, const char *name, long low) {
  const char *text = getenv(name);
  return text && term_parse_integer(out, text, low, LARGEST_TASK);
}

// `sbatch --array=A-B:STEP`: tasks A, A + STEP, ... in this order are shards 1, 2, ... of COUNT.
static bool of_slurm(sweep_shard *out, const char **why) {
  long id, first, last, count, step = 1;
  if (!getenv("SLURM_ARRAY_TASK_ID")) {
    *why = "SLURM_ARRAY_TASK_ID is not set: this is no job array";
    return false;
  }
  const bool known = read_variable(&id, "SLURM_ARRAY_TASK_ID", 0) &&
                     read_variable(&first, "SLURM_ARRAY_TASK_MIN", 0) &&
                     read_variable(&last, "SLURM_ARRAY_TASK_MAX", 0) &&
                     read_variable(&count, "SLURM_ARRAY_TASK_COUNT", 1);
  if (!known ||
      (getenv("SLURM_ARRAY_TASK_STEP") && !read_variable(&step, "SLURM_ARRAY_TASK_STEP", 1))) {
    *why = "SLURM_ARRAY_TASK_ID, _MIN, _MAX, _COUNT are not whole numbers";
    return false;
  }
  // A list such as --array=3,7, to repeat some tasks, does not tell how many there once were.
  if (last - first != (count - 1) * step || id < first || id > last || (id - first) % step) {
    *why = "this array is a list, not a range: give K/N yourself";
    return false;
  }
  *out = (sweep_shard){(id - first) / step + 1, count};
  return true;
}

bool sweep_parse_shard(sweep_shard *out, const char *text, const char **why) {
  char copy[64];
  if (strcmp(text, "slurm") == 0) return of_slurm(out, why);
  *why = "must be K/N, 1 <= K <= N, or slurm";
  if (snprintf(copy, sizeof copy, "%s", text) >= (int)sizeof copy) return false;
  char *slash = strchr(copy, '/');
  if (!slash) return false;
  *slash = '\0';
  return term_parse_integer(&out->count, slash + 1, 1, SWEEP_MOST_SHARDS) &&
         term_parse_integer(&out->number, copy, 1, out->count);
}
