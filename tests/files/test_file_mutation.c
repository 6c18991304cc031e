// SPDX-License-Identifier: Apache-2.0
// Good files cut off at, and damaged in, every byte: an answer each time, never a crash, and a
// message of one line with every error. (Under the sanitizers this also looks for leaks.)
#include "samples.h"
#include "scratch.h"

#include "support/near.h"

#include <bicycle/error.h>
#include <bicycle/file.h>
#include <stdio.h>
#include <string.h>

typedef struct tally {
  int accepted, refused;
} tally;

static void try_file(tally *t, const char *text, size_t length) {
  const char *path = scratch_write_bytes("mutant.yml", text, length);
  bike_file file;
  bike_file_error error = {""};
  const int code = bike_file_read(&file, path, &error);
  if (code == BIKE_OK) {
    ++t->accepted;
    assert_int_equal(bike_check(&file.bicycle, NULL, NULL), BIKE_OK);
    return;
  }
  ++t->refused;
  if (strncmp(error.text, path, strlen(path)) != 0 || strpbrk(error.text, "\n\r\t"))
    fail_msg("message '%s'", error.text);
}

static const char *const SAMPLES[] = {SAMPLE_VALUES, SAMPLE_TEXT, SAMPLE_COMPONENTS};

// Only a cut in the last number, or behind it, may leave a whole file.
static void truncated(void **state) {
  (void)state;
  for (int s = 0; s < 3; ++s) {
    tally t = {0};
    const size_t length = strlen(SAMPLES[s]);
    for (size_t cut = 0; cut < length; ++cut) try_file(&t, SAMPLES[s], cut);
    assert_in_range(t.accepted, 1, 8);
    assert_true(t.refused > (int)length - 9);
  }
}

static void damaged(void **state) {
  (void)state;
  static const char bytes[] = "\0\n\t :#[]{}&*!|>'\"%@`-?,=9\xff";
  for (int s = 0; s < 3; ++s) {
    char text[4096];
    const size_t length = strlen(SAMPLES[s]);
    tally t = {0};
    for (size_t at = 0; at < length; ++at) {
      memcpy(text, SAMPLES[s], length);
      text[at] = bytes[at % (sizeof bytes - 1)];
      try_file(&t, text, length);
    }
    assert_true(t.refused > (int)length / 2);
    assert_true(t.accepted > 0); // comments, digits of numbers
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(truncated), cmocka_unit_test(damaged)};
  return cmocka_run_group_tests(tests, scratch_create, scratch_remove);
}
