// SPDX-License-Identifier: Apache-2.0
// Broken files: the right code, one line naming file, line and key, and an untouched result.
#include "samples.h"
#include "scratch.h"
#include "wrong_edits.h"

#include "support/near.h"

#include <bicycle/file.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

// Reads a file that must be refused so: path, then `message`.
static void check_refused(const char *path, int code, const char *message, const char *label) {
  static const bike_file untouched = {.bicycle.name = "untouched", .bicycle.part_count = 7};
  bike_file file = untouched;
  bike_file_error error = {""};
  const int found = bike_file_read(&file, path, &error);
  char expected[1024];
  snprintf(expected, sizeof expected, "%s%s", path, message);
  if (found != code || strncmp(error.text, expected, strlen(expected)) != 0)
    fail_msg("%s: code %d, not %d; message '%s', not '%s'", label, found, code, error.text,
             expected);
  assert_null(strchr(error.text, '\n'));
  assert_memory_equal(&file, &untouched, sizeof file);
  assert_int_equal(bike_file_read(&file, path, NULL), code); // the message may be unwanted
}

static void edits(void **state) {
  (void)state;
  for (int i = 0; i < WRONG_EDIT_COUNT; ++i) {
    const wrong_edit *e = &WRONG_EDITS[i];
    const char *at = strstr(e->good, e->from);
    if (!at) fail_msg("edit %d: '%s' is not in the good file", i, e->from);
    char text[4096];
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - e->good), e->good, e->to,
             at + strlen(e->from));
    check_refused(scratch_write("wrong.yml", text), e->code, e->message, e->to);
  }
}

static void whole_files(void **state) {
  (void)state;
  static const struct {
    const char *text, *message;
  } files[] = {
      {"", ": the file is empty"},
      {"\n\n", ": the file is empty"},
      {"# nothing\n", ": the file is empty"},
      {"\xef\xbb\xbf", ": the file is empty"},
      {"just words\n", ":1: must hold `key: value` pairs"},
      {"- a\n- b\n", ":1: must hold `key: value` pairs"},
      {"{}\n", ": key 'w' is missing"},
      {"*a\n", ":1: "},
      {"parameterization: components\n", ": key 'g' is missing"},
      {"parameterization: Meijaard2007\n", ": key 'values' is missing"},
      {"parameterization: [components]\n", ":1: parameterization: must be"},
      {"parameterization:\n", ":1: parameterization: must be"},
      {"%YAML 9.9\n---\nw: 1\n", ":"},
      {"\x7f"
       "ELF\x02\x01\x01",
       ":1: control character"},
  };
  for (size_t i = 0; i < sizeof files / sizeof *files; ++i)
    check_refused(scratch_write("wrong.yml", files[i].text), BIKE_ERROR_SYNTAX, files[i].message,
                  files[i].text);
}

static void too_many_parts(void **state) {
  (void)state;
  char text[16384];
  int length = snprintf(text, sizeof text, "%s", SAMPLE_COMPONENTS);
  for (int i = 0; i < BIKE_MAX_PARTS; ++i)
    length += snprintf(text + length, sizeof text - (size_t)length,
                       "  - {name: p%d, assembly: rear, mass: 1, position: [0, 0, 1], inertia: "
                       "none}\n",
                       i);
  check_refused(scratch_write("wrong.yml", text), BIKE_ERROR_PARAMETER,
                ":65: parts: more than 32 parts", "parts");
}

// Aliases that would unfold into 10^9 entries are refused where they stand, not unfolded.
static void billion_laughs(void **state) {
  (void)state;
  char text[2048];
  int length = snprintf(text, sizeof text, "a: &a [x,x,x,x,x,x,x,x,x,x]\n");
  for (char c = 'b'; c <= 'i'; ++c)
    length += snprintf(text + length, sizeof text - (size_t)length,
                       "%c: &%c [*%c,*%c,*%c,*%c,*%c,*%c,*%c,*%c,*%c,*%c]\n", c, c, c - 1, c - 1,
                       c - 1, c - 1, c - 1, c - 1, c - 1, c - 1, c - 1, c - 1);
  check_refused(scratch_write("wrong.yml", text), BIKE_ERROR_SYNTAX,
                ":1: a: anchors are not accepted", "laughs");
}

static void deep_nesting(void **state) {
  (void)state;
  static char text[100000];
  memset(text, '[', sizeof text - 1);
  check_refused(scratch_write("wrong.yml", text), BIKE_ERROR_SYNTAX, ":1: ", "[[[[");
}

static long peak_memory(void) { // KiB
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// 100 MB of zeros, and as much of them as the size limit lets through, cost next to nothing.
static void zeros(void **state) {
  (void)state;
  const long before = peak_memory();
  const char *path = scratch_write("zeros.yml", "");
  assert_int_equal(truncate(path, 100L * 1000 * 1000), 0);
  check_refused(path, BIKE_ERROR_FILE, ": is larger than 262144 bytes", "100 MB");
  assert_int_equal(truncate(path, 200000), 0);
  check_refused(path, BIKE_ERROR_SYNTAX, ":1: control character", "200 kB");
  check_refused("/dev/zero", BIKE_ERROR_SYNTAX, ":1: control character", "/dev/zero");
  assert_true(peak_memory() - before < 4096); // buffers are 16 KiB; room for the allocator
}

static void no_files(void **state) {
  (void)state;
  check_refused(scratch_folder(), BIKE_ERROR_FILE, ": Is a directory", "folder");
  check_refused(scratch_path("absent.yml"), BIKE_ERROR_FILE, ": No such file or directory", "none");
  check_refused("", BIKE_ERROR_FILE, ": No such file or directory", "empty path");
  bike_file file;
  bike_file_error error;
  assert_int_equal(bike_file_read(&file, "a\nb", &error), BIKE_ERROR_FILE);
  assert_string_equal(error.text, "a?b: No such file or directory"); // one line all the same
}

static void unreadable(void **state) {
  (void)state;
  const char *path = scratch_write("secret.yml", SAMPLE_VALUES);
  assert_int_equal(chmod(path, 0), 0);
  scratch_be_nobody(true);
  check_refused(path, BIKE_ERROR_FILE, ": Permission denied", "unreadable");
  scratch_be_self();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edits),        cmocka_unit_test(whole_files),
      cmocka_unit_test(zeros),        cmocka_unit_test(too_many_parts),
      cmocka_unit_test(deep_nesting), cmocka_unit_test(billion_laughs),
      cmocka_unit_test(no_files),     cmocka_unit_test(unreadable),
  };
  return cmocka_run_group_tests(tests, scratch_create, scratch_remove);
}
