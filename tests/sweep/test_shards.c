// SPDX-License-Identifier: Apache-2.0
// Threads, shards and merging: one table, whatever the division; and what is missing or
// contradictory is told.
#include "sweeps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int enter(void **state) {
  run_enter_group(state);
  sweep_write("rides.yml", SWEEP_RIDES);
  sweep_run(0, "bicycle sweep rides.yml -o whole --threads 1");
  return 0;
}

static void threads_change_nothing(void **state) {
  (void)state;
  for (int threads = 2; threads <= 4; threads++) {
    sweep_run(0, "bicycle sweep rides.yml -o threads%d --threads %d", threads, threads);
    char name[64];
    snprintf(name, sizeof name, "threads%d.csv", threads);
    sweep_assert_same(name, "whole.csv");
  }
}

static void shards_change_nothing(void **state) {
  (void)state;
  for (int shards = 2; shards <= 7; shards += 5) {
    for (int k = shards; k >= 1; k--)
      sweep_run(0, "bicycle sweep rides.yml -o part --shard %d/%d --threads %d", k, shards, k);
    sweep_run(0, "bicycle sweep merge part.*of%d.log -o merged.csv", shards);
    sweep_assert_same("merged.csv", "whole.csv");
  }
  sweep_run(0, "test ! -e part.csv"); // no shard takes itself for the whole
  // logs of different divisions, in any order: points done twice are the same
  sweep_run(0, "bicycle sweep merge part.*of7.log whole.log part.*of2.log -o both.csv");
  sweep_assert_same("both.csv", "whole.csv");
  assert_int_equal(sweep_merged_count("part.*of7.log part.*of2.log", "repeated"), 60);
}

// Arrays may begin anywhere and have steps.
static void slurm(void **state) {
  (void)state;
  static const struct {
    int id, first, last, count, step, shard;
  } arrays[] = {{0, 0, 2, 3, 1, 1}, {1, 0, 2, 3, 1, 2}, {2, 0, 2, 3, 1, 3}, {1, 1, 3, 3, 1, 1},
                {3, 1, 3, 3, 1, 3}, {9, 5, 9, 3, 2, 3}, {7, 5, 9, 3, 2, 2}};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    sweep_run(0,
              "rm -f array.*; SLURM_ARRAY_TASK_ID=%d SLURM_ARRAY_TASK_MIN=%d "
              "SLURM_ARRAY_TASK_MAX=%d SLURM_ARRAY_TASK_COUNT=%d SLURM_ARRAY_TASK_STEP=%d bicycle "
              "sweep rides.yml -o array --shard slurm",
              arrays[i].id, arrays[i].first, arrays[i].last, arrays[i].count, arrays[i].step);
    sweep_run(0, "bicycle sweep rides.yml -o expected --fresh --shard %d/3", arrays[i].shard);
    sweep_run(0,
              "bicycle sweep merge --partial array.%dof3.log -o a.csv; bicycle sweep merge "
              "--partial expected.%dof3.log -o b.csv; test -s a.csv",
              arrays[i].shard, arrays[i].shard);
    sweep_assert_same("a.csv", "b.csv");
  }
}

static void what_is_missing_is_told(void **state) {
  (void)state;
  sweep_run(0, "sed -E '/^(3|4|5|9|59),/d' whole.log > gaps.log");
  run_result result = run_command("bicycle sweep merge gaps.log -o gaps.csv");
  assert_int_equal(result.status, 1);
  if (!strstr(result.err, "5 of 60 points are missing: 3-5, 9, 59")) fail_msg("%s", result.err);
  run_free(&result);
  sweep_run(0, "test ! -e gaps.csv");
  sweep_run(1, "bicycle sweep merge gaps.log --partial -o gaps.csv");
  sweep_run(0, "sed -E '/^(3|4|5|9|59),/d' whole.csv > expected.csv");
  sweep_assert_same("gaps.csv", "expected.csv");
  // many gaps are not all listed
  sweep_run(0, "sed -E '/^[0-9]*[02468],/d' whole.log > many.log");
  result = run_command("bicycle sweep merge many.log");
  assert_non_null(strstr(result.err, "30 of 60 points are missing: 0, 2, 4, 6, 8, 10, 12, 14, 16, "
                                     "18, ..."));
  run_free(&result);
  result = run_command("bicycle sweep merge whole.log");
  assert_int_equal(result.status, 0);
  assert_non_null(strstr(result.err, "all 60 points are there"));
  run_free(&result);
}

// The sweep of another seed with this one's header: the same points, other values.
static void contradictions_are_told(void **state) {
  (void)state;
  sweep_run(0, "sed 's/seed: 3/seed: 4/' rides.yml > other.yml; bicycle sweep other.yml -o other; "
               "(head -5 whole.log; tail -n +6 other.log) > false.log");
  run_result result = run_command("bicycle sweep merge whole.log false.log -o never.csv");
  assert_int_equal(result.status, 1);
  assert_non_null(strstr(result.err, "60 records are contradictory; the first: point "));
  assert_non_null(strstr(result.err, "differs between whole.log and false.log"));
  run_free(&result);
  sweep_run(1, "bicycle sweep merge whole.log false.log --partial -o never.csv");
  sweep_run(0, "test ! -e never.csv");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(threads_change_nothing),
      cmocka_unit_test(shards_change_nothing),
      cmocka_unit_test(slurm),
      cmocka_unit_test(what_is_missing_is_told),
      cmocka_unit_test(contradictions_are_told),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
