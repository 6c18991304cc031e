// SPDX-License-Identifier: Apache-2.0
// `bicycle NAME` runs bicycle-NAME that stands beside the program, and nothing else.
#include "run.h"
#include "support/near.h"

#include <string.h>

static void expect(const char *command, int status, const char *out, const char *says) {
  run_result result = run_command(command);
  if (result.status != status) print_error("%s: %s\n", command, result.err);
  assert_int_equal(result.status, status);
  assert_string_equal(result.out, out);
  if (!strstr(result.err, says)) fail_msg("'%s' does not say '%s'", result.err, says);
  run_free(&result);
}

// A copy of the program with neighbours of the test's own.
static int enter(void **state) {
  (void)state;
  return run_enter_filled(
      "mkdir bin && cp \"$(command -v bicycle)\" bin && "
      "printf '#!/bin/sh\\necho \"hello: $*\"\\nexit 3\\n' > bin/bicycle-hello && "
      "chmod +x bin/bicycle-hello && : > bin/bicycle-plain && mkdir -p elsewhere/bin && "
      "printf '#!/bin/sh\\necho wrong one\\n' > elsewhere/bicycle-far && "
      "chmod +x elsewhere/bicycle-far");
}

static void a_neighbour_runs_with_its_arguments_and_status(void **state) {
  (void)state;
  expect("bin/bicycle hello a 'b c' --json", 3, "hello: a b c --json\n", "");
  expect("cd elsewhere && ../bin/bicycle hello", 3, "hello: \n", "");
}

static void programs_elsewhere_do_not_run(void **state) {
  (void)state;
  expect("PATH=$PWD/elsewhere:$PATH bin/bicycle far", 2, "", "'far' is not a command");
  expect("cd elsewhere && ../bin/bicycle far", 2, "", "'far' is not a command");
}

static void a_slash_is_refused(void **state) {
  (void)state;
  expect("mkdir -p bin/bicycle-x && cp bin/bicycle-hello bin/bicycle-x/y && bin/bicycle x/y", 2, "",
         "'x/y' is not a command");
}

static void what_cannot_run_is_named(void **state) {
  (void)state;
  expect("bin/bicycle plain", 2, "", "bicycle-plain: Permission denied");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_neighbour_runs_with_its_arguments_and_status),
      cmocka_unit_test(programs_elsewhere_do_not_run),
      cmocka_unit_test(a_slash_is_refused),
      cmocka_unit_test(what_cannot_run_is_named),
  };
  return cmocka_run_group_tests(tests, enter, run_leave_group);
}
