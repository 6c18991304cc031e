// SPDX-License-Identifier: Apache-2.0
// Output files: whole or not at all, whatever happens on the way.
#include "scratch.h"

#include "support/near.h"

#include <bicycle/error.h>
#include <bicycle/output.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static void check_content(const char *name, const char *expected) {
  char *text = scratch_read(scratch_path(name));
  assert_string_equal(text, expected);
  free(text);
}

static void begin(bike_output *o, const char *name) {
  bike_file_error error = {""};
  if (bike_output_begin(o, scratch_path(name), &error) != BIKE_OK) fail_msg("%s", error.text);
}

static void commits(void **state) {
  (void)state;
  bike_output o;
  const int before = scratch_count();
  begin(&o, "new");
  fputs("new content", o.stream);
  assert_int_not_equal(access(scratch_path("new"), F_OK), 0); // nothing before the commit
  assert_int_equal(bike_output_commit(&o, NULL), BIKE_OK);
  assert_null(o.stream);
  check_content("new", "new content");
  assert_int_equal(scratch_count(), before + 1);
  bike_output_abort(&o); // harmless
  check_content("new", "new content");
}

static void replaces_and_keeps_the_mode(void **state) {
  (void)state;
  bike_output o;
  scratch_write("old", "old content");
  assert_int_equal(chmod(scratch_path("old"), 0640), 0);
  begin(&o, "old");
  fputs("new", o.stream);
  fflush(o.stream);
  check_content("old", "old content");
  assert_int_equal(bike_output_commit(&o, NULL), BIKE_OK);
  check_content("old", "new");
  struct stat status;
  assert_int_equal(stat(scratch_path("old"), &status), 0);
  assert_int_equal(status.st_mode & 07777, 0640);
}

static void new_files_obey_the_mask(void **state) {
  (void)state;
  bike_output o;
  const mode_t mask = umask(027);
  begin(&o, "masked");
  assert_int_equal(bike_output_commit(&o, NULL), BIKE_OK);
  umask(mask);
  struct stat status;
  assert_int_equal(stat(scratch_path("masked"), &status), 0);
  assert_int_equal(status.st_mode & 07777, 0640);
}

static void aborts(void **state) {
  (void)state;
  bike_output o;
  scratch_write("kept", "old content");
  const int before = scratch_count();
  begin(&o, "kept");
  fputs("new", o.stream);
  bike_output_abort(&o);
  check_content("kept", "old content");
  begin(&o, "never");
  bike_output_abort(&o);
  assert_int_equal(scratch_count(), before);
}

static void follows_links(void **state) {
  (void)state;
  bike_output o;
  scratch_write("target", "old");
  char link_path[SCRATCH_PATH_SIZE];
  snprintf(link_path, sizeof link_path, "%s", scratch_path("link"));
  assert_int_equal(symlink("target", link_path), 0);
  begin(&o, "link");
  fputs("new", o.stream);
  assert_int_equal(bike_output_commit(&o, NULL), BIKE_OK);
  check_content("target", "new");
  struct stat status;
  assert_int_equal(lstat(link_path, &status), 0);
  assert_true(S_ISLNK(status.st_mode));
}

static void check_refused(const char *path, const char *reason) {
  bike_output o;
  bike_file_error error = {""};
  const int before = scratch_count();
  assert_int_equal(bike_output_begin(&o, path, &error), BIKE_ERROR_FILE);
  if (!strstr(error.text, reason)) fail_msg("'%s' does not say '%s'", error.text, reason);
  if (strncmp(error.text, path, strlen(path)) != 0) fail_msg("no path in '%s'", error.text);
  bike_output_abort(&o);
  assert_int_equal(scratch_count(), before);
}

static void refuses(void **state) {
  (void)state;
  check_refused(scratch_folder(), "Is a directory");
  check_refused(scratch_path("new-folder/"), "Is a directory");
  check_refused(scratch_path("absent/file"), "No such file or directory");
  scratch_write("plain", "");
  check_refused(scratch_path("plain/file"), "Not a directory");
  check_refused("", "No such file or directory");
}

// However long the path, the reason behind it is told; a character of two bytes is not cut.
static void long_paths_keep_their_reason(void **state) {
  (void)state;
  static const char reason[] = ": File name too long", more[] = "\303\244/"; // a umlaut
  char path[6001] = "";
  for (int shift = 0; shift < 3; shift++) { // the cut falls on each of its bytes
    memset(path, 'p', sizeof path - 1);
    for (size_t i = (size_t)shift; i + 4 < sizeof path; i += 3) memcpy(path + i, more, 3);
    bike_output o;
    bike_file_error error = {""};
    assert_int_equal(bike_output_begin(&o, path, &error), BIKE_ERROR_FILE);
    const size_t length = strlen(error.text);
    assert_true(length < sizeof error.text && length > sizeof error.text - 8);
    assert_string_equal(error.text + length - strlen(reason), reason);
    assert_memory_equal(error.text, path, 200);
    const char *gap = strstr(error.text, "...");
    assert_non_null(gap);
    assert_int_not_equal((unsigned char)gap[-1], 0xc3);       // begun
    assert_int_not_equal((unsigned char)gap[3] & 0xc0, 0x80); // ended
  }
}

static void refuses_without_permission(void **state) {
  (void)state;
  scratch_write("locked", "old");
  assert_int_equal(chmod(scratch_path("locked"), 0444), 0);
  scratch_be_nobody(true);
  check_refused(scratch_path("locked"), "Permission denied");
  scratch_be_self();
  scratch_be_nobody(false);
  check_refused(scratch_path("new"), "Permission denied");
  scratch_be_self();
}

// The target becomes a folder on the way: nothing may be left beside it.
static void cleans_up_a_failed_commit(void **state) {
  (void)state;
  bike_output o;
  bike_file_error error = {""};
  begin(&o, "taken");
  fputs("new", o.stream);
  assert_int_equal(mkdir(scratch_path("taken"), 0700), 0);
  const int before = scratch_count();
  assert_int_equal(bike_output_commit(&o, &error), BIKE_ERROR_FILE);
  assert_non_null(strstr(error.text, "taken: Is a directory"));
  assert_int_equal(scratch_count(), before);
}

// A full disk: /dev/full directly, and a file size limit for a file written aside.
static void notices_failed_writes(void **state) {
  (void)state;
  bike_output o;
  bike_file_error error = {""};
  assert_int_equal(bike_output_begin(&o, "/dev/full", &error), BIKE_OK);
  fputs("x", o.stream);
  assert_int_equal(bike_output_commit(&o, &error), BIKE_ERROR_FILE);
  assert_non_null(strstr(error.text, "No space left on device"));

  scratch_write("limited", "old");
  const int before = scratch_count();
  struct rlimit old;
  getrlimit(RLIMIT_FSIZE, &old);
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &(struct rlimit){4096, old.rlim_max});
  begin(&o, "limited");
  for (int i = 0; i < 10000; ++i) fputs("0123456789", o.stream);
  setrlimit(RLIMIT_FSIZE, &old); // the last flush succeeds: the middle is missing all the same
  assert_int_equal(bike_output_commit(&o, &error), BIKE_ERROR_FILE);
  assert_non_null(strstr(error.text, "limited: "));
  check_content("limited", "old");
  assert_int_equal(scratch_count(), before);
}

// A killed program leaves the old file and nothing else.
static void survives_a_kill(void **state) {
  (void)state;
  scratch_write("important", "old");
  const int before = scratch_count();
  const pid_t child = fork();
  if (child == 0) {
    bike_output o;
    if (bike_output_begin(&o, scratch_path("important"), NULL) != BIKE_OK) _exit(1);
    fputs("half", o.stream);
    fflush(o.stream);
    raise(SIGKILL);
  }
  int status;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  check_content("important", "old");
  assert_int_equal(scratch_count(), before);
}

static void writes_to_stdout(void **state) {
  (void)state;
  bike_output o;
  assert_int_equal(bike_output_begin(&o, "-", NULL), BIKE_OK);
  assert_ptr_equal(o.stream, stdout);
  assert_int_equal(bike_output_commit(&o, NULL), BIKE_OK);
  assert_int_equal(bike_output_begin(&o, NULL, NULL), BIKE_OK);
  bike_output_abort(&o);
  assert_int_equal(fputs("", stdout) >= 0, 1); // still open
  assert_int_equal(bike_output_commit(&o, NULL), BIKE_ERROR_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(commits),
      cmocka_unit_test(replaces_and_keeps_the_mode),
      cmocka_unit_test(new_files_obey_the_mask),
      cmocka_unit_test(aborts),
      cmocka_unit_test(follows_links),
      cmocka_unit_test(refuses),
      cmocka_unit_test(long_paths_keep_their_reason),
      cmocka_unit_test(refuses_without_permission),
      cmocka_unit_test(cleans_up_a_failed_commit),
      cmocka_unit_test(notices_failed_writes),
      cmocka_unit_test(survives_a_kill),
      cmocka_unit_test(writes_to_stdout),
  };
  return cmocka_run_group_tests(tests, scratch_create, scratch_remove);
}
