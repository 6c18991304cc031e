// SPDX-License-Identifier: Apache-2.0
// A signal that would end the program while it writes a report: the report is whole or not there,
// and nothing is left beside it.
#include "support/near.h"
#include "validate_support.h"

#include <dirent.h>
#include <folder.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static int count_entries(const char *path) {
  DIR *d = opendir(path);
  int count = -2; // "." and ".."
  if (!d) return -1;
  while (readdir(d)) count++;
  closedir(d);
  return count;
}

// What the program does between two files: leaves with 9 unless a signal ends it.
typedef void writer(folder *f, int number);

static void be_stopped(folder *f, int number) {
  raise(number);
  if (term_signal_waits()) folder_abort(f);
}

static void be_late(folder *f, int number) {
  problem p;
  raise(number);
  folder_commit(f, &p);
}

static void write_and(writer *rest, const char *target, int number) {
  problem p;
  folder f;
  if (folder_begin(&f, target, &p) != TERM_DONE) _exit(8);
  FILE *stream = NULL;
  if (folder_open(&stream, &f, "report.json", &p) != TERM_DONE || fputs("{}", stream) < 0) _exit(8);
  if (term_signal_waits()) _exit(7);
  folder_close(stream, "report.json", &p);
  rest(&f, number);
  _exit(9);
}

// The entries of `support_home` and of the report after a process was interrupted like that.
static void expect_entries(writer *rest, int number, int home, int report) {
  char *target = NULL;
  assert_true(asprintf(&target, "%s/report", support_home) > 0);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) write_and(rest, target, number);
  int status;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFSIGNALED(status));
  assert_int_equal(WTERMSIG(status), number);
  assert_int_equal(count_entries(support_home), home);
  assert_int_equal(count_entries(target), report);
  free(target);
}

static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};

static void test_nothing_is_left(void **state) {
  (void)state;
  for (int i = 0; i < 3; i++) expect_entries(be_stopped, numbers[i], 0, -1);
}

static void test_what_is_whole_stays(void **state) {
  (void)state;
  expect_entries(be_late, SIGTERM, 1, 1);
}

// A signal that is ignored stays so, and one that somebody else blocks.
static void test_signals_are_as_before(void **state) {
  (void)state;
  problem p = {""};
  folder f;
  char *target = NULL;
  sigset_t before, after;
  assert_true(asprintf(&target, "%s/report", support_home) > 0);
  pthread_sigmask(SIG_BLOCK, NULL, &before);
  assert_int_equal(folder_begin(&f, target, &p), TERM_DONE);
  folder_abort(&f);
  folder_abort(&f); // of one that has ended: nothing
  assert_int_equal(folder_begin(&f, "/nowhere/at/all", &p), TERM_USAGE);
  pthread_sigmask(SIG_BLOCK, NULL, &after);
  for (int i = 1; i < NSIG; i++) assert_int_equal(sigismember(&before, i), sigismember(&after, i));
  free(target);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_nothing_is_left, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_what_is_whole_stays, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_signals_are_as_before, support_enter, support_leave),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
