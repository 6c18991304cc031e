// SPDX-License-Identifier: Apache-2.0
#include "equations/instruction_set.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {"baseline", "v3", "v4"};

const char *instruction_set_string(instruction_set set) {
  return names[set];
}

instruction_set instruction_set_best(void) {
#ifdef BICYCLE_X86_64_LEVELS
  if (__builtin_cpu_supports("x86-64-v4")) return INSTRUCTIONS_V4;
  if (__builtin_cpu_supports("x86-64-v3")) return INSTRUCTIONS_V3;
#endif
  return INSTRUCTIONS_BASELINE;
}

static instruction_set decided(void) {
  instruction_set best = instruction_set_best();
  const char *asked = getenv("BICYCLE_INSTRUCTIONS");
  for (instruction_set set = INSTRUCTIONS_BASELINE; asked && set <= best; set++)
    if (!strcmp(asked, names[set])) return set;
  return best;
}

instruction_set instruction_set_in_use(void) {
  static atomic_int kept = -1;
  int known = atomic_load_explicit(&kept, memory_order_relaxed);
  if (known >= 0) return (instruction_set)known;
  // the first of several threads decides for all
  int none = -1, mine = (int)decided();
  return (instruction_set)(atomic_compare_exchange_strong(&kept, &none, mine) ? mine : none);
}
