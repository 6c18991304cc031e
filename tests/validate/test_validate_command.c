// SPDX-License-Identifier: Apache-2.0
// The program itself: exit codes, streams, and all shipped scenarios.
#include "support/near.h"
#include "validate_support.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <jansson.h>

static char *folder;

// Runs the program in the test's folder; stdout and stderr go to the files "out" and "err".
static int run(const char *arguments) {
  char *command = NULL;
  assert_true(asprintf(&command,
                       "cd %s && " BICYCLE_BINARY_DIR "/bin/bicycle-validate %s >out 2>err", folder,
                       arguments) > 0);
  int status = system(command);
  free(command);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

static char *output(const char *name) {
  char *path = NULL;
  assert_true(asprintf(&path, "%s/%s", folder, name) > 0);
  char *text = support_read(path);
  free(path);
  return text;
}

static void expect_text(const char *name, const char *part) {
  char *text = output(name);
  if (!text || !strstr(text, part)) fail_msg("no '%s' in '%s'", part, text ? text : "nothing");
  free(text);
}

static void write_scenario(const char *name, const char *from, const char *to) {
  char *text = NULL;
  const char *at = from ? strstr(support_scenario_text, from) : support_scenario_text;
  assert_non_null(at);
  assert_true(asprintf(&text, "%.*s%s%s", (int)(at - support_scenario_text), support_scenario_text,
                       to, at + (from ? strlen(from) : 0)) > 0);
  free(support_write(folder, name, text));
  free(text);
}

// What the whole project is for.
static void test_shipped_scenarios_agree(void **state) {
  (void)state;
  int code = run("");
  if (code != 0) {
    char *text = output("out");
    print_error("%s\n", text);
    free(text);
  }
  assert_int_equal(code, 0);
  expect_text("out", "AGREE");
  expect_text("bicycle-report/report.json", "\"verdict\": \"agree\"");
  expect_text("bicycle-report/benchmark_m1-residuals.csv", "time,x,y");
  char *errors = output("err");
  assert_string_equal(errors, ""); // no progress but on a terminal
  free(errors);
}

static void test_failure_is_1(void **state) {
  (void)state;
  write_scenario("strict.yml", "limit: 1e-11", "limit: 1e-22");
  assert_int_equal(run("strict.yml"), 1);
  expect_text("out", "FAIL");
  expect_text("out", "L2 traces");
}

static void test_invalid_run_is_3(void **state) {
  (void)state;
  // MuJoCo calls velocities above 1e10 unstable, warns, and resets its state.
  write_scenario("wild.yml", "speed: 4.6, lean_rate: 0.5", "speed: 1e11");
  assert_int_equal(run("wild.yml"), 3);
  expect_text("out", "INVALID");
  expect_text("out", "MuJoCo raised a warning");
  expect_text("bicycle-report/report.json", "\"verdict\": \"invalid\"");
}

static void test_usage_is_2(void **state) {
  (void)state;
  static const struct {
    const char *arguments, *message;
  } cases[] = {
      {"nonsense", "neither a file nor a shipped scenario"},
      {"none.yml", "none.yml: No such file"},
      {".", "Is a directory"},
      {"/", "the name of a scenario"},
      {"--limits", "unrecognized option"},
      {"-o", "requires an argument"},
      {"-o /dev/null roadster_straight", "not a folder"},
      {"-o none/report roadster_straight", "none: No such file"},
      {"-o . roadster_straight", "is not a report"},
      {"roadster_straight roadster_straight", "two scenarios have the name"},
      {"list roadster_straight", "one argument too many"},
      {"''", "the name of a scenario"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    assert_int_equal(run(cases[i].arguments), 2);
    expect_text("err", cases[i].message);
    char *errors = output("err");
    assert_ptr_equal(strchr(errors, '\n'), errors + strlen(errors) - 1); // one line
    free(errors);
    char *printed = output("out");
    assert_string_equal(printed, "");
    free(printed);
  }
}

// A disk that is full, here by the largest size of a file: without a report there is no verdict.
static void test_no_verdict_without_report(void **state) {
  (void)state;
  char *command = NULL;
  write_scenario("good.yml", NULL, "");
  assert_true(asprintf(&command,
                       "cd %s && trap '' XFSZ && ulimit -f 8 && " BICYCLE_BINARY_DIR
                       "/bin/bicycle-validate good.yml -o lost >out 2>err",
                       folder) > 0);
  int status = system(command);
  free(command);
  assert_true(WIFEXITED(status));
  assert_int_equal(WEXITSTATUS(status), 2);
  expect_text("err", "File too large");
  char *printed = output("out");
  assert_string_equal(printed, "");
  free(printed);
}

static void test_json(void **state) {
  (void)state;
  write_scenario("short.yml", NULL, "");
  assert_int_equal(run("--json short.yml"), 0);
  char *text = output("out"), *written = output("bicycle-report/report.json");
  json_t *document = json_loads(text, 0, NULL);
  assert_non_null(document);
  assert_string_equal(text, written);
  json_decref(document);
  free(text);
  free(written);
}

static void test_help_and_list(void **state) {
  (void)state;
  assert_int_equal(run("--help"), 0);
  char *text = output("out");
  assert_ptr_equal(strstr(text, "Example: "), text);
  free(text);
  assert_int_equal(run("list"), 0);
  expect_text("out", "penny_farthing");
  assert_int_equal(run("list --json"), 0);
  expect_text("out", "\"bicycle\": \"recumbent\"");
}

static int make_folder(void **state) {
  (void)state;
  folder = support_folder();
  return 0;
}

static int remove_folder(void **state) {
  (void)state;
  support_remove(folder);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_shipped_scenarios_agree, make_folder, remove_folder),
      cmocka_unit_test_setup_teardown(test_failure_is_1, make_folder, remove_folder),
      cmocka_unit_test_setup_teardown(test_invalid_run_is_3, make_folder, remove_folder),
      cmocka_unit_test_setup_teardown(test_usage_is_2, make_folder, remove_folder),
      cmocka_unit_test_setup_teardown(test_no_verdict_without_report, make_folder, remove_folder),
      cmocka_unit_test_setup_teardown(test_json, make_folder, remove_folder),
      cmocka_unit_test_setup_teardown(test_help_and_list, make_folder, remove_folder),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
