// SPDX-License-Identifier: Apache-2.0
// A folder that a program writes is whole or not there, and nothing is left beside it, also when a
// signal ends the program meanwhile.
#include "run.h"
#include "support/near.h"
#include "terminal/folder.h"

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FILES = 64, SIZE = 1 << 20 }; // some ten milliseconds of writing, at least

static term_file files[FILES];
static char names[FILES][16];

static void make_files(void) {
  static char bytes[SIZE];
  memset(bytes, 'x', sizeof bytes);
  for (int i = 0; i < FILES; i++) {
    snprintf(names[i], sizeof names[i], "%d", i);
    files[i] = (term_file){names[i], bytes, sizeof bytes};
  }
}

// -1: there is none.
static int count_entries(const char *path) {
  DIR *folder = opendir(path);
  int count = -2; // "." and ".."
  if (!folder) return -1;
  while (readdir(folder)) count++;
  closedir(folder);
  return count;
}

static int wanted; // the signal to come

static void raise_it(int unused) {
  (void)unused;
  raise(wanted);
}

// Leaves with 9 unless a signal comes first, one millisecond from now and each after.
static void write_and_be_ended(int number) {
  const struct sigaction action = {.sa_handler = raise_it, .sa_flags = (int)SA_RESTART};
  const struct itimerval often = {{.tv_usec = 1000}, {.tv_usec = 1000}};
  wanted = number;
  sigaction(SIGALRM, &action, NULL);
  setitimer(ITIMER_REAL, &often, NULL);
  term_folder_write("out", files, FILES);
  _exit(9);
}

static void a_signal_leaves_nothing_half_done(void **state) {
  (void)state;
  static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
  for (int i = 0; i < 4; i++) {
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) write_and_be_ended(numbers[i]);
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    assert_int_equal(WTERMSIG(status), numbers[i]);
    const int beside = count_entries("."), within = count_entries("out");
    if (!(beside == 0 && within == -1) && !(beside == 1 && within == FILES))
      fail_msg("signal %d left %d entries, %d of them in the folder", numbers[i], beside, within);
    run_well("rm -rf out");
  }
}

// The caller's own blocking, and handlers that only take notes.
static void signals_are_as_before(void **state) {
  (void)state;
  sigset_t mine, before, after;
  sigemptyset(&mine);
  sigaddset(&mine, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &mine, NULL);
  pthread_sigmask(SIG_BLOCK, NULL, &before);
  assert_int_equal(term_folder_write("out", files, 2), TERM_DONE);
  assert_int_equal(term_folder_write("nowhere/out", files, 2), TERM_USAGE);
  pthread_sigmask(SIG_BLOCK, NULL, &after);
  for (int i = 1; i < NSIG; i++) assert_int_equal(sigismember(&before, i), sigismember(&after, i));
  // one that waits already, and is not let through afterwards: nothing is written, and that is said
  raise(SIGHUP);
  assert_int_equal(term_folder_write("later", files, 2), TERM_USAGE);
  assert_int_equal(count_entries("later"), -1);
  assert_int_equal(count_entries("."), 1);
  signal(SIGHUP, SIG_IGN); // forgets it
  pthread_sigmask(SIG_UNBLOCK, &mine, NULL);
  signal(SIGHUP, SIG_DFL);
  assert_int_equal(term_folder_write("later", files, 2), TERM_DONE);
  assert_int_equal(count_entries("later"), 2);
}

// What a killed process with the same number left is out of the way.
static void leftovers_do_not_matter(void **state) {
  (void)state;
  char command[128];
  snprintf(command, sizeof command, "rm -rf * .[!.]*; mkdir .out.%ld.tmp; touch .out.%ld.tmp/1",
           (long)getpid(), (long)getpid());
  run_well(command);
  assert_int_equal(term_folder_write("out", files, 3), TERM_DONE);
  assert_int_equal(count_entries("."), 1);
  assert_int_equal(count_entries("out"), 3);
  // a folder with files of others is nobody's to replace
  run_well("touch out/mine");
  assert_int_equal(term_folder_write("out", files, 3), TERM_USAGE);
  assert_int_equal(count_entries("."), 1);
  assert_int_equal(count_entries("out"), 4);
}

static int enter(void **state) {
  make_files();
  return run_enter_group(state) || chdir(run_folder());
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_signal_leaves_nothing_half_done),
      cmocka_unit_test(signals_are_as_before),
      cmocka_unit_test(leftovers_do_not_matter),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
