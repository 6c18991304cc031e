// SPDX-License-Identifier: Apache-2.0
// The list of points: every point is handed out once, by one shard, and those done never again.
#include "support/near.h"
#include "support/random.h"
#include "sweep/tasks.h"

#include <string.h>

enum { MOST = 20000 };

static const long SIZES[] = {1, 2, 63, 64, 65, 1000, 12345, MOST};
static const long SHARDS[] = {1, 2, 3, 7, 64, 1000};

// Hands out all of a shard in shares of random size; counts each point.
static void hand_out(int taken[MOST], long points, sweep_shard shard, random_source *random) {
  sweep_tasks tasks;
  sweep_range range;
  assert_true(sweep_tasks_begin(&tasks, points, shard));
  long marked = 0, handed = 0;
  for (long k = 0; k < points; k++) {
    if (random_between(random, 0, 1) > 0.3 || !sweep_tasks_mark(&tasks, k)) continue;
    assert_false(sweep_tasks_mark(&tasks, k)); // a second time
    taken[k]++;
    marked++;
  }
  assert_int_equal(tasks.done_count, marked);
  assert_int_equal(tasks.left, tasks.own - marked);
  while (sweep_tasks_next(&tasks, &range, (long)random_between(random, 1, 300))) {
    assert_true(range.count >= 1);
    for (long i = 0; i < range.count; i++) taken[range.first + i]++;
    handed += range.count;
  }
  assert_int_equal(tasks.left, 0);
  assert_int_equal(marked + handed, tasks.own);
  assert_false(sweep_tasks_mark(&tasks, -1));
  assert_false(sweep_tasks_mark(&tasks, points));
  sweep_tasks_end(&tasks);
}

static void every_point_once(void **state) {
  (void)state;
  static int taken[MOST];
  random_source random = random_begin("tasks", 5);
  for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; i++)
    for (size_t j = 0; j < sizeof SHARDS / sizeof *SHARDS; j++) {
      memset(taken, 0, sizeof taken);
      for (long k = 1; k <= SHARDS[j]; k++)
        hand_out(taken, SIZES[i], (sweep_shard){k, SHARDS[j]}, &random);
      for (long k = 0; k < SIZES[i]; k++)
        if (taken[k] != 1)
          fail_msg("point %ld of %ld, %ld shards: %d times", k, SIZES[i], SHARDS[j], taken[k]);
    }
}

// Shares of the work differ by one block at most, and there are many blocks.
static void shards_are_even(void **state) {
  (void)state;
  for (long count = 1; count <= 100; count++) {
    long least = MOST, most = 0;
    for (long k = 1; k <= count; k++) {
      sweep_tasks tasks;
      assert_true(sweep_tasks_begin(&tasks, MOST, (sweep_shard){k, count}));
      if (tasks.own < least) least = tasks.own;
      if (tasks.own > most) most = tasks.own;
      assert_true(most - least <= tasks.block && tasks.block * 64 <= MOST / count + 64);
      sweep_tasks_end(&tasks);
    }
  }
}

static void shares_follow_the_rate(void **state) {
  (void)state;
  sweep_tasks tasks;
  assert_true(sweep_tasks_begin(&tasks, MOST, (sweep_shard){1, 1}));
  assert_int_equal(sweep_tasks_share(&tasks, 0, 2), 1);      // nothing known yet
  assert_int_equal(sweep_tasks_share(&tasks, 400, 2), 100);  // a quarter of a second
  assert_int_equal(sweep_tasks_share(&tasks, 1e9, 2), 4096); // memory
  assert_int_equal(sweep_tasks_share(&tasks, 1e9, 1000), MOST / 2000);
  assert_int_equal(sweep_tasks_share(&tasks, NAN, 2) >= 1, 1);
  sweep_tasks_end(&tasks);
  assert_true(sweep_tasks_begin(&tasks, 100000000, (sweep_shard){1, 1}));
  assert_int_equal(sweep_tasks_share(&tasks, 400, 2500), 100);
  assert_int_equal(sweep_tasks_share(&tasks, 400, 25000), 1000); // who hands out must keep up
  sweep_tasks_end(&tasks);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_point_once),
      cmocka_unit_test(shards_are_even),
      cmocka_unit_test(shares_follow_the_rate),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
