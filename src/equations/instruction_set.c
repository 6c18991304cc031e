// SPDX-License-Identifier: Apache-2.0
#include "equations/instruction_set.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {"baseline", "v3", "v4"};

const char *instruction_set_string(instruction_set set) {
  return names[set];
}

#define HAS(feature) (__builtin_cpu_supports(feature) != 0)
#ifndef BICYCLE_X86_64_LEVELS
#define HAS_V3 0
#define HAS_V4 0
#elif defined __clang__ // clang 14 knows features, not levels: those that came last to each
#define HAS_V3 (HAS("avx2") && HAS("bmi") && HAS("bmi2") && HAS("fma"))
#define HAS_V4                                                                                     \
  (HAS("avx512f") && HAS("avx512bw") && HAS("avx512cd") && HAS("avx512dq") && HAS("avx512vl"))
#else
#define HAS_V3 HAS("x86-64-v3")
#define HAS_V4 HAS("x86-64-v4")
#endif

instruction_set instruction_set_best(void) {
  return HAS_V4 ? INSTRUCTIONS_V4 : HAS_V3 ? INSTRUCTIONS_V3 : INSTRUCTIONS_BASELINE;
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
