// SPDX-License-Identifier: Apache-2.0
// Killed at any moment and started again: no point is lost, none is done twice, and the table is
// that of an undisturbed run.
#include "sweeps.h"

#include "support/random.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { POINTS = 60, MORE_POINTS = 720 };

// The undisturbed runs; the second takes longer than a process that is killed lives.
static int enter(void **state) {
  run_enter_group(state);
  sweep_write("rides.yml", SWEEP_RIDES);
  sweep_run(0, "bicycle sweep rides.yml -o whole --threads 1");
  sweep_run(0, "sed 's/draws: 5/draws: 60/' rides.yml > more.yml");
  sweep_run(0, "bicycle sweep more.yml -o all_more --threads 1");
  return 0;
}

static void assert_complete_as(const char *name, const char *whole, int points) {
  char file[64];
  snprintf(file, sizeof file, "%s.csv", name);
  sweep_assert_same(file, whole);
  snprintf(file, sizeof file, "%s.log", name);
  assert_int_equal(sweep_merged_count(file, "missing"), 0);
  assert_int_equal(sweep_merged_count(file, "repeated"), 0);
  assert_int_equal(sweep_merged_count(file, "contradictory"), 0);
  assert_int_equal(sweep_merged_count(file, "present"), points);
}

static void assert_complete(const char *name) {
  assert_complete_as(name, "whole.csv", POINTS);
}

// Rounds until one ends by itself; `milliseconds` at most to live.
static int kill_until_done(const char *name, random_source *random, double milliseconds) {
  for (int kills = 0; kills < 200; kills++) {
    char command[512];
    snprintf(command, sizeof command,
             "bicycle sweep more.yml -o %s --threads 2 & p=$!; (sleep %.3f; kill -9 $p) & k=$!; "
             "wait $p; s=$?; kill $k; exit $s",
             name, random_between(random, 0.2, 1) * milliseconds / 1000);
    run_result result = run_command(command);
    const int status = result.status;
    run_free(&result);
    if (status == 0) return kills;
    assert_int_equal(status, 128 + 9);
    milliseconds *= 1.05; // whatever the machine, it ends
  }
  fail_msg("killed 200 times");
  return 0;
}

static void killed_at_random(void **state) {
  (void)state;
  random_source random = random_begin("killed", 11);
  int kills = 0;
  for (int i = 0; i < 4; i++) {
    sweep_run(0, "rm -f killed.*");
    kills += kill_until_done("killed", &random, 60);
    assert_complete_as("killed", "all_more.csv", MORE_POINTS);
  }
  print_message("killed %d times\n", kills);
  assert_true(kills >= 4);
}

// A log that ends anywhere at all: what a kill or a full disk can leave.
static void torn_anywhere(void **state) {
  (void)state;
  random_source random = random_begin("torn", 12);
  char *log = sweep_read("whole.log");
  const double size = (double)strlen(log);
  for (int i = 0; i < 25; i++) {
    // a third of them within the header, one before it
    const long length = i == 0 ? 0 : (long)random_between(&random, 0, i % 3 ? size : 250);
    sweep_run(0, "head -c %ld whole.log > torn.log; rm -f torn.csv", length);
    sweep_run(0, "bicycle sweep rides.yml -o torn --threads 2");
    assert_complete("torn");
  }
  free(log);
}

// A byte that changed: the record is passed over, its point done again.
static void damaged_records(void **state) {
  (void)state;
  sweep_run(0, "sed '20s/,/;/' whole.log > hurt.log");
  run_result result = run_command("bicycle sweep rides.yml -o hurt");
  assert_int_equal(result.status, 0);
  assert_non_null(strstr(result.err, "59 of 60 points are done"));
  assert_non_null(strstr(result.err, "1 damaged lines"));
  run_free(&result);
  assert_complete("hurt");
}

static void signals_leave_a_valid_log(void **state) {
  (void)state;
  static const struct {
    const char *name;
    int number;
  } signals[] = {{"INT", 2}, {"TERM", 15}};
  for (int i = 0; i < 2; i++) {
    // 24000 rides: more than can be done before the signal comes
    sweep_run(0, "sed 's/draws: 5/draws: 2000/' rides.yml > many.yml; rm -f many.log");
    // what a shell runs in the background ignores SIGINT otherwise, and so does the sweep
    char command[256];
    snprintf(command, sizeof command,
             "env --default-signal=INT bicycle sweep many.yml -o many --threads 2 & p=$!; while ! "
             "grep -q '^[0-9]' many.log; "
             "do sleep 0.01; done; kill -%s $p; wait $p",
             signals[i].name);
    run_result result = run_command(command);
    assert_int_equal(result.status, 128 + signals[i].number);
    if (!strstr(result.err, "the same command goes on from there")) fail_msg("%s", result.err);
    run_free(&result);
    assert_int_equal(sweep_merged_count("many.log", "damaged_lines"), 0);
    assert_true(sweep_merged_count("many.log", "missing") > 0);
    char *log = sweep_read("many.log");
    assert_true(log[strlen(log) - 1] == '\n');
    free(log);
  }
}

static void another_spec_is_refused(void **state) {
  (void)state;
  sweep_run(0, "cp whole.log kept.log; cp whole.csv kept.csv; sed 's/seed: 3/seed: 4/' rides.yml > "
               "other.yml; sed 's/version .*/version 0.0.0/' whole.log > old.log; "
               "sed '1s/2$/1/' whole.log > older.log; echo '# bicycle-sweep lag' > no.log");
  run_all_wrong(
      (const run_wrong[]){
          {"bicycle sweep other.yml -o kept", "kept.log: belongs to another spec"},
          {"bicycle sweep rides.yml -o old", "old.log: was written by another version"},
          {"bicycle sweep rides.yml -o older",
           "older.log: is a log of format 1, of another version "
           "of the program; this one has format 2: choose "
           "another -o, or start over with --fresh"},
          {"bicycle sweep merge older.log -o older.csv", "older.log: is a log of format 1"},
          {"bicycle sweep merge whole.log older.log -o older.csv", "older.log: is a log of format"},
          {"bicycle sweep rides.yml -o no", "no.log: is not a log of bicycle sweep: choose"},
          {"bicycle sweep merge no.log", "no.log: is not a log of bicycle sweep"}},
      7);
  sweep_run(0, "bicycle sweep rides.yml -o older --fresh");
  assert_complete("older");
  sweep_assert_same("kept.log", "whole.log");
  sweep_assert_same("kept.csv", "whole.csv");
  // the bicycle counts too
  sweep_run(0,
            "cp \"%s/model/roadster/roadster.yml\" own.yml; sed 's/: roadster/: own.yml/' "
            "rides.yml > of_own.yml; bicycle sweep of_own.yml -o of_own && sed -i 's/mass: "
            "12/mass: 13/' own.yml",
            BICYCLE_SOURCE_DIR);
  run_all_wrong(&(run_wrong){"bicycle sweep of_own.yml -o of_own", "or its bicycle was edited"}, 1);
  sweep_run(0, "bicycle sweep of_own.yml -o of_own --fresh");
}

static void one_process_at_a_time(void **state) {
  (void)state;
  sweep_run(0, "cp whole.log locked.log; flock -x locked.log sh -c 'bicycle sweep rides.yml -o "
               "locked 2> said; test $? = 2' && grep -q 'another process is writing' said");
  sweep_assert_same("locked.log", "whole.log");
}

// Nothing left to do, --fresh, the name with .csv, and a table that was lost.
static void once_more(void **state) {
  (void)state;
  sweep_run(0, "cp whole.log again.log; bicycle sweep rides.yml -o again.csv 2> said && grep -q "
               "'60 of 60 points are done' said && cmp again.log whole.log");
  assert_complete("again");
  sweep_run(0, "bicycle sweep rides.yml -o again --fresh 2> said; ! grep -q 'are done' said");
  assert_complete("again");
}

// A full disk ends it with 2; with room again it goes on.
static void full_disk(void **state) {
  (void)state;
  sweep_run(0, "(ulimit -f 8; trap '' XFSZ; bicycle sweep rides.yml -o full 2> said; test $? = 2) "
               "&& grep -q 'full.log: File too large' said && test ! -e full.csv");
  sweep_run(0, "bicycle sweep rides.yml -o full");
  assert_complete("full");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(killed_at_random),
      cmocka_unit_test(torn_anywhere),
      cmocka_unit_test(damaged_records),
      cmocka_unit_test(signals_leave_a_valid_log),
      cmocka_unit_test(another_spec_is_refused),
      cmocka_unit_test(one_process_at_a_time),
      cmocka_unit_test(once_more),
      cmocka_unit_test(full_disk),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
