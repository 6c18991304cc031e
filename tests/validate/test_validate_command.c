// SPDX-License-Identifier: Apache-2.0
// The program itself: exit codes, streams, and all shipped scenarios.
#include "support/near.h"
#include "validate_support.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

#include <jansson.h>

static void write_scenario(const char *name, const char *from, const char *to) {
  char *text = support_replace(support_scenario_text, from, to);
  free(support_write(support_home, name, text));
  free(text);
}

// What the whole project is for.
static void test_shipped_scenarios_agree(void **state) {
  (void)state;
  int code = support_validate("");
  if (code != 0) {
    char *text = support_output("out");
    print_error("%s\n", text);
    free(text);
  }
  assert_int_equal(code, 0);
  // Those on contacts are meant to differ; half of the gates hold numbers that were copied.
  support_expect_text("out", "AGREE: 23 scenarios agree, 2 differ as expected; ");
  support_expect_text("out", " independent measurements within their limits\n");
  support_expect_text("bicycle-report/report.json", "\"verdict\": \"agree\"");
  support_expect_text("bicycle-report/benchmark_m1-residuals.csv", "time,x,y");
  char *errors = support_output("err");
  assert_string_equal(errors, ""); // no progress but on a terminal
  free(errors);
}

static void test_failure_is_1(void **state) {
  (void)state;
  write_scenario("strict.yml", "limit: 1e-11", "limit: 1e-22");
  assert_int_equal(support_validate("strict.yml"), 1);
  support_expect_text("out", "FAIL");
  support_expect_text("out", "L2 traces");
}

static void test_invalid_run_is_3(void **state) {
  (void)state;
  // MuJoCo calls velocities above 1e10 unstable, warns, and resets its state.
  write_scenario("wild.yml", "speed: 4.6, lean_rate: 0.5", "speed: 1e11");
  assert_int_equal(support_validate("wild.yml"), 3);
  support_expect_text("out", "INVALID");
  support_expect_text("out", "MuJoCo raised a warning");
  support_expect_text("bicycle-report/report.json", "\"verdict\": \"invalid\"");
}

// A recording with a NaN is invalid, and every view says where it stands.
static void test_nan_recording_is_3(void **state) {
  (void)state;
  static const char *const views[] = {"out", "bicycle-report/report.json",
                                      "bicycle-report/report.html", "bicycle-report/junit.xml",
                                      "bicycle-report/summary.md"};
  free(support_write(support_home, "nan.csv", "time,lean\n0,0\n0.01,nan\n0.02,0\n"));
  free(support_write(support_home, "nan.yml",
                     "title: nan\nbicycle: benchmark\nstart: {speed: 5}\nduration: 0.02\n"
                     "sample: 0.01\nreference: {engine: analytic}\n"
                     "candidate: {engine: file, file: nan.csv}\ngates:\n"
                     "  - {layer: L2, metric: max, signals: [lean], limit: 1, reason: test}\n"));
  assert_int_equal(support_validate("nan.yml"), 3);
  for (size_t i = 0; i < sizeof views / sizeof *views; i++)
    support_expect_text(views[i], "nan.csv:3: lean: not a finite number at 0.01 s");
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
      {"--jobs 0", "not a whole number from 1"},
      {"-j many", "not a whole number from 1"},
      {"-o /dev/null roadster_straight", "not a folder"},
      {"-o none/report roadster_straight", "none: No such file"},
      {"-o . roadster_straight", "is not a report"},
      {"roadster_straight roadster_straight", "roadster_straight.yml: two scenarios have the name"},
      {"list roadster_straight", "one argument too many"},
      {"''", "the name of a scenario"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    assert_int_equal(support_validate(cases[i].arguments), 2);
    support_expect_text("err", cases[i].message);
    char *errors = support_output("err");
    assert_ptr_equal(strchr(errors, '\n'), errors + strlen(errors) - 1); // one line
    free(errors);
    char *printed = support_output("out");
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
                       support_home) > 0);
  int status = system(command);
  free(command);
  assert_true(WIFEXITED(status));
  assert_int_equal(WEXITSTATUS(status), 2);
  support_expect_text("err", "File too large");
  char *printed = support_output("out");
  assert_string_equal(printed, "");
  free(printed);
}

static void test_json(void **state) {
  (void)state;
  write_scenario("short.yml", NULL, "");
  assert_int_equal(support_validate("--json short.yml"), 0);
  char *text = support_output("out"), *written = support_output("bicycle-report/report.json");
  json_t *document = json_loads(text, 0, NULL);
  assert_non_null(document);
  assert_string_equal(text, written);
  json_decref(document);
  free(text);
  free(written);
}

static void test_help_and_list(void **state) {
  (void)state;
  assert_int_equal(support_validate("--help"), 0);
  char *text = support_output("out");
  assert_ptr_equal(strstr(text, "Example: "), text);
  free(text);
  assert_int_equal(support_validate("list"), 0);
  support_expect_text("out", "penny_farthing");
  assert_int_equal(support_validate("list --json"), 0);
  support_expect_text("out", "\"bicycle\": \"recumbent\"");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_shipped_scenarios_agree, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_failure_is_1, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_invalid_run_is_3, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_nan_recording_is_3, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_usage_is_2, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_no_verdict_without_report, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_json, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_help_and_list, support_enter, support_leave),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
