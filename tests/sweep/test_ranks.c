// SPDX-License-Identifier: Apache-2.0
// MPI: the table does not depend on the number of ranks; a rank that dies costs no point; wrong
// specs end all ranks with one line of ours.
#include "sweeps.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// As root OpenMPI asks twice whether one means it; two processors are shared by more ranks. Of a
// build with sanitizers leaks are not looked for here: OpenMPI leaves some in modules that are gone
// by then, which no list can name; the same commands without MPI are searched.
#define MPIRUN                                                                                     \
  "ASAN_OPTIONS=detect_leaks=0 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun "  \
  "--oversubscribe "

static int enter(void **state) {
  run_enter_group(state);
  sweep_write("rides.yml", SWEEP_RIDES);
  sweep_run(0, "bicycle sweep rides.yml -o whole --threads 1");
  return 0;
}

static void need_mpirun(void) {
#ifdef SWEEP_WITH_MPI
  run_result found = run_command("command -v mpirun");
  const int status = found.status;
  run_free(&found);
  if (status == 0) return;
  print_message("skipped: there is no mpirun\n");
#else
  print_message("skipped: built without MPI\n");
#endif
  skip();
}

static void ranks_change_nothing(void **state) {
  (void)state;
  need_mpirun();
  for (int ranks = 1; ranks <= 4; ranks++) {
    char name[64], command[512];
    snprintf(command, sizeof command, MPIRUN "-n %d bicycle sweep rides.yml -o ranks%d --json",
             ranks, ranks);
    json_t *report = run_json(command);
    assert_int_equal((int)run_number(report, "ranks"), ranks);
    assert_int_equal((int)run_number(report, "done"), 60);
    json_decref(report);
    snprintf(name, sizeof name, "ranks%d.csv", ranks);
    sweep_assert_same(name, "whole.csv");
    snprintf(name, sizeof name, "ranks%d.log", ranks);
    assert_int_equal(sweep_merged_count(name, "repeated"), 0);
  }
}

static void threads_and_shards_of_ranks(void **state) {
  (void)state;
  need_mpirun();
  sweep_run(0, MPIRUN "-n 3 bicycle sweep rides.yml -o mixed --threads 2");
  sweep_assert_same("mixed.csv", "whole.csv");
  for (int k = 1; k <= 2; k++)
    sweep_run(0, MPIRUN "-n 3 bicycle sweep rides.yml -o part --shard %d/2", k);
  sweep_run(0, "bicycle sweep merge part.*of2.log -o part.csv");
  sweep_assert_same("part.csv", "whole.csv");
}

// Rank `victim` is killed after its first records; another number of ranks goes on.
static void a_rank_dies(int victim) {
  sweep_run(0, "rm -f died.* pid.*");
  char command[1024];
  snprintf(command, sizeof command,
           MPIRUN
           "-n 3 sh -c 'echo $$ > pid.$OMPI_COMM_WORLD_RANK; exec bicycle sweep rides.yml -o "
           "died' & p=$!; while ! grep -qs '^[0-9]' died.log; do kill -0 $p || exit 99; "
           "sleep 0.005; done; kill -9 $(cat pid.%d); wait $p",
           victim);
  run_result result = run_command(command);
  assert_true(result.status != 0);
  run_free(&result);
  const long lost = sweep_merged_count("died.log", "missing");
  print_message("rank %d killed with %ld points to do\n", victim, lost);
  assert_true(lost > 0);
  assert_int_equal(sweep_merged_count("died.log", "repeated"), 0);
  sweep_run(0, MPIRUN "-n 2 bicycle sweep rides.yml -o died");
  sweep_assert_same("died.csv", "whole.csv");
  assert_int_equal(sweep_merged_count("died.log", "repeated"), 0);
}

static void any_rank_may_die(void **state) {
  (void)state;
  need_mpirun();
  // longer rides: there must be something left to do
  sweep_run(0, "sed -i 's/draws: 5/draws: 150/' rides.yml && bicycle sweep rides.yml -o whole "
               "--fresh --threads 2");
  a_rank_dies(0);
  a_rank_dies(2);
  sweep_write("rides.yml", SWEEP_RIDES);
  sweep_run(0, "bicycle sweep rides.yml -o whole --fresh --threads 1");
}

static void wrong_specs_are_told_once(void **state) {
  (void)state;
  need_mpirun();
  sweep_write("wrong.yml", "bicycle: roadster\nsweep: {spede: 5}\noutputs: [eps_max]\n");
  run_result result = run_command(MPIRUN "-n 3 bicycle sweep wrong.yml -o wrong");
  assert_int_equal(result.status, 2);
  const char *line = strstr(result.err, "wrong.yml:2:9: spede");
  if (!line) fail_msg("%s", result.err);
  assert_null(strstr(line + 1, "wrong.yml:2:9: spede"));
  run_free(&result);
  sweep_run(0, "test ! -e wrong.log");
}

// Ranks that read different files, as on nodes without a common file system.
static void different_specs_are_noticed(void **state) {
  (void)state;
  need_mpirun();
  sweep_run(0, "mkdir -p node0 node1 && cp rides.yml node0 && sed 's/seed: 3/seed: 4/' rides.yml > "
               "node1/rides.yml");
  run_result result = run_command(
      MPIRUN "-n 2 sh -c 'cd node$OMPI_COMM_WORLD_RANK && exec bicycle sweep rides.yml -o out'");
  assert_int_equal(result.status, 2);
  if (!strstr(result.err, "rank 1 reads another text than rank 0")) fail_msg("%s", result.err);
  run_free(&result);
  sweep_run(0, "test ! -e node0/out.log");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(ranks_change_nothing),
      cmocka_unit_test(threads_and_shards_of_ranks),
      cmocka_unit_test(any_rank_may_die),
      cmocka_unit_test(wrong_specs_are_told_once),
      cmocka_unit_test(different_specs_are_noticed),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
