// SPDX-License-Identifier: Apache-2.0
// One scalar right-hand side against the floor of the machine.
#include "floor/floor.h"
#include "native.h"
#include "work.h"

typedef struct floor_cases {
  bench_count count;
} floor_cases;

static void operations(void *context, long repeats) {
  const floor_cases *c = context;
  bench_fma_chains((double)repeats * c->count.operations);
}

static void instructions(void *context, long repeats) {
  const floor_cases *c = context;
  bench_fma_chains((double)repeats * c->count.instructions);
}

static bool prepare_floor(void *context, bench_notes *notes) {
  floor_cases *c = context;
  if (!bench_fma_known()) return bench_note_reason(notes, "no fused multiply-add on this machine");
  if (!bench_count_kernel(&c->count))
    return bench_note_reason(notes, "the kernel's machine code could not be counted");
  bench_note_value(notes, "operations", c->count.operations);
  bench_note_value(notes, "instructions", c->count.instructions);
  return true;
}

bool bench_floor_cases(bench_list *list) {
  floor_cases *c = bench_new(list, sizeof *c, NULL);
  const bench_runner ours = {"equations, native", bench_native_accelerations,
                             .context = list->subject};
  const bench_contest contests[] = {
      {.name = "floor-operations",
       .question = "right-hand side / its operations as multiply-adds",
       .ours = ours,
       .theirs = {"FMA, 12 chains", operations, .context = c},
       .sense = BENCH_AT_MOST,
       .prepare = prepare_floor},
      {.name = "floor-instructions",
       .question = "right-hand side / its fused instructions as multiply-adds",
       .ours = ours,
       .theirs = {"FMA, 12 chains", instructions, .context = c},
       .sense = BENCH_AT_MOST,
       .asked = 2,
       .possible = 1.8,
       .prepare = prepare_floor}};
  bench_add_all(list, contests, sizeof contests / sizeof contests[0], c);
  return true;
}
