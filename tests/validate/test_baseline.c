// SPDX-License-Identifier: Apache-2.0
// Baselines: what counts as better, same, worse; what cannot be compared; the commands.
#include "support/near.h"
#include "validate_support.h"

#include <baseline.h>
#include <math.h>
#include <report.h>
#include <report_read.h>
#include <stdlib.h>
#include <string.h>

static json_t *original; // a report of the test scenario, never changed

static json_t *copy(void) {
  json_t *document = json_deep_copy(original);
  assert_non_null(document);
  return document;
}

static json_t *entry_of(const json_t *document) {
  return json_array_get(json_object_get(document, "scenarios"), 0);
}

static json_t *gate_of(const json_t *document, const char *signal) {
  const json_t *entry = entry_of(document);
  for (size_t i = 0; i < report_count(entry, "gates"); i++)
    if (strcmp(report_gate_at(entry, i).signal, signal) == 0)
      return json_array_get(json_object_get(entry, "gates"), i);
  fail_msg("no gate of %s", signal);
  return NULL;
}

// How the gate of `signal` changes from value `before` to `now`; NaN is null.
static void expect_change(const char *signal, double before, double now, const char *change) {
  json_t *a = copy(), *b = copy();
  json_object_set_new(gate_of(a, signal), "value", isnan(before) ? json_null() : json_real(before));
  json_object_set_new(gate_of(b, signal), "value", isnan(now) ? json_null() : json_real(now));
  assert_true(baseline_compare(b, a));
  const json_t *block = json_object_get(gate_of(b, signal), "baseline");
  assert_string_equal(report_text(block, "change"), change);
  assert_int_equal(baseline_is_worse(b), strcmp(change, "worse") == 0);
  json_decref(a);
  json_decref(b);
}

static void test_changes(void **state) {
  (void)state;
  // 500 steps of MuJoCo: sqrt(500) roundings of a signal of order 1 are 5e-15.
  expect_change("lean", 1e-12, 1e-12, "same");
  expect_change("lean", 1e-12, 1e-12 + 4e-15, "same");
  expect_change("lean", 1e-12, 1e-12 - 4e-15, "same");
  expect_change("lean", 1e-12, 1e-12 + 7e-15, "worse");
  expect_change("lean", 1e-12, 1e-12 - 7e-15, "better");
  expect_change("lean", 1e-12, NAN, "worse");
  expect_change("lean", NAN, 1e-12, "better");
  expect_change("lean", NAN, NAN, "same");
  // L0: 1e4 roundings
  expect_change("lean_acceleration", 0, 2e-12, "same");
  expect_change("lean_acceleration", 0, 3e-12, "worse");
}

static void add_study(json_t *document) {
  json_object_set_new(
      entry_of(document), "convergence",
      json_pack("[{s:s, s:f, s:f}]", "signal", "lean", "uncertainty", 3e-13, "scatter", 0.01));
}

// Where there is a convergence study, its uncertainty is the floor.
static void test_floor_of_study(void **state) {
  (void)state;
  static const double nows[] = {1.2e-12, 1.4e-12};
  static const char *const changes[] = {"same", "worse"};
  for (int i = 0; i < 2; i++) {
    json_t *a = copy(), *b = copy();
    add_study(a);
    add_study(b);
    json_object_set_new(gate_of(a, "lean"), "value", json_real(1e-12));
    json_object_set_new(gate_of(b, "lean"), "value", json_real(nows[i]));
    assert_true(baseline_compare(b, a));
    const json_t *block = json_object_get(gate_of(b, "lean"), "baseline");
    assert_string_equal(report_text(block, "change"), changes[i]);
    assert_string_equal(report_text(block, "floor_source"), "convergence study");
    assert_near(report_real(block, "floor"), 3e-13, 0);
    json_decref(a);
    json_decref(b);
  }
}

// A gate that is no longer there hides what it would have found.
static void test_gates_that_come_and_go(void **state) {
  (void)state;
  json_t *a = copy(), *b = copy();
  json_array_remove(json_object_get(entry_of(b), "gates"), 0);
  assert_true(baseline_compare(b, a));
  assert_true(baseline_is_worse(b));
  assert_int_equal(report_count(json_object_get(entry_of(b), "baseline"), "gone"), 1);
  json_decref(b);
  b = copy();
  json_array_remove(json_object_get(entry_of(a), "gates"), 0);
  assert_true(baseline_compare(b, a));
  assert_false(baseline_is_worse(b));
  assert_near(report_real(json_object_get(b, "baseline"), "new"), 1, 0);
  json_decref(a);
  json_decref(b);
}

// A limit for another part of the ride is another gate, and the old one is missed.
static void test_windows_are_noticed(void **state) {
  (void)state;
  json_t *a = copy(), *b = copy();
  json_object_set_new(gate_of(b, "lean"), "from", json_real(0.25));
  assert_true(baseline_compare(b, a));
  assert_string_equal(report_text(json_object_get(gate_of(b, "lean"), "baseline"), "change"),
                      "new");
  const json_t *gone = json_object_get(json_object_get(entry_of(b), "baseline"), "gone");
  assert_string_equal(json_string_value(json_array_get(gone, 0)), "L2 lean max");
  assert_true(baseline_is_worse(b));
  json_decref(b);
  b = copy();
  json_object_set_new(gate_of(a, "lean"), "from", json_real(0.25));
  json_object_set_new(gate_of(b, "lean"), "from", json_real(0.25));
  assert_true(baseline_compare(b, a));
  assert_false(baseline_is_worse(b));
  json_decref(a);
  json_decref(b);
}

static void test_timings_never_count(void **state) {
  (void)state;
  json_t *a = copy(), *b = copy();
  json_t *timings = json_object_get(json_object_get(b, "provenance"), "timings");
  json_object_set_new(timings, "elapsed", json_real(1e6));
  assert_true(baseline_compare(b, a));
  assert_false(baseline_is_worse(b));
  json_decref(a);
  json_decref(b);
}

static void expect_misfit(const json_t *a, const char *message) {
  problem p = {""};
  assert_int_equal(baseline_match(original, a, &p), TERM_BASELINE);
  if (!strstr(p.text, message)) fail_msg("'%s' instead of '%s'", p.text, message);
}

static void test_misfits(void **state) {
  (void)state;
  problem p = {""};
  json_t *a = copy();
  assert_int_equal(baseline_match(original, a, &p), TERM_DONE);
  json_object_set_new(json_object_get(entry_of(a), "setup"), "growth_rate", json_real(1e-17));
  assert_int_equal(baseline_match(original, a, &p), TERM_DONE); // derived, off by a rounding
  json_object_set_new(json_object_get(entry_of(a), "setup"), "duration", json_real(9));
  expect_misfit(a, "duration differs");
  json_decref(a);
  a = copy();
  json_object_set_new(entry_of(a), "parameter_sha256", json_string("0"));
  expect_misfit(a, "parameter_sha256 differs");
  json_decref(a);
  a = copy();
  json_t *candidate = json_array_get(json_object_get(entry_of(a), "engines"), 1);
  json_object_set_new(json_object_get(candidate, "options"), "timestep", json_real(0.002));
  expect_misfit(a, "options differs");
  json_object_set_new(candidate, "version", json_string("MuJoCo 9"));
  expect_misfit(a, "version differs");
  json_decref(a);
  a = copy();
  json_object_set_new(entry_of(a), "name", json_string("other"));
  expect_misfit(a, "no scenario 'test'");
  json_decref(a);
}

//---------------------------------- the commands --------------------------------------------------

static void save(const json_t *document, const char *name) {
  char *text = json_dumps(document, 0);
  free(support_write(support_home, name, text));
  free(text);
}

static void test_bless_and_compare(void **state) {
  (void)state;
  free(support_write(support_home, "test.yml", support_scenario_text));
  assert_int_equal(support_validate("bless"), 4); // nothing to bless yet
  assert_int_equal(support_validate("test.yml --baseline none.json"), 4);
  support_expect_text("err", "none.json: No such file");
  assert_int_equal(support_validate("test.yml"), 0);
  assert_int_equal(support_validate("bless"), 0);
  assert_int_equal(support_validate("bless bicycle-report -o again.json"), 0);
  assert_int_equal(support_validate("compare bicycle-baseline.json again.json"), 0);
  support_expect_text("out", "0 better");
  assert_int_equal(support_validate("compare again.json bicycle-report --json"), 0);
  support_expect_text("out", "\"change\": \"same\"");
  assert_int_equal(support_validate("test.yml --baseline again.json"), 0);
  support_expect_text("out", "SAME as the baseline");
  assert_int_equal(support_validate("benchmark_m1 --baseline again.json"), 4);
  support_expect_text("err", "no scenario 'benchmark_m1'");
  assert_int_equal(support_validate("compare again.json bicycle-report"), 4);
  support_expect_text("err", "compare: again.json: the baseline has no scenario 'benchmark_m1'");
  assert_int_equal(support_validate("list"), 0); // the report of that run is there all the same
  assert_int_equal(support_validate("bless bicycle-report -o m1.json"), 0);
}

static void test_worse_fails(void **state) {
  (void)state;
  free(support_write(support_home, "test.yml", support_scenario_text));
  assert_int_equal(support_validate("test.yml"), 0);
  char *path = NULL;
  assert_true(asprintf(&path, "%s/bicycle-report/report.json", support_home) > 0);
  json_t *document = json_load_file(path, 0, NULL);
  double value = report_real(gate_of(document, "steer"), "value");
  json_object_set_new(gate_of(document, "steer"), "value", json_real(0.5 * value));
  save(document, "better.json");
  assert_int_equal(support_validate("compare better.json bicycle-report"), 1);
  support_expect_text("out", "WORSE than");
  assert_int_equal(support_validate("compare bicycle-report better.json"), 0);
  support_expect_text("out", "BETTER than");
  assert_int_equal(support_validate("test.yml --baseline better.json"), 1);
  support_expect_text("out", "1 worse");
  json_object_set_new(document, "version", json_integer(2));
  save(document, "newer.json");
  assert_int_equal(support_validate("test.yml --baseline newer.json"), 4);
  json_object_set_new(document, "verdict", json_string("invalid"));
  json_object_set_new(document, "version", json_integer(1));
  save(document, "invalid.json");
  assert_int_equal(support_validate("bless invalid.json -o no.json"), 3);
  json_decref(document);
  free(path);
}

static void test_wrong_files(void **state) {
  (void)state;
  free(support_write(support_home, "list.json", "[1, 2]"));
  free(support_write(support_home, "broken.json", "{\"schema\": \n 12,,"));
  free(support_write(support_home, "empty.json", ""));
  free(support_write(support_home, "other.json", "{\"schema\": \"something else\"}"));
  assert_int_equal(support_validate("compare list.json list.json"), 4);
  support_expect_text("err", "list.json: schema");
  assert_int_equal(support_validate("compare broken.json list.json"), 4);
  support_expect_text("err", "broken.json:2:");
  static const char *const scenarios[] = {"[1]", "[{\"name\": \"a\"}]",
                                          "[{\"name\": \"a\", \"gates\": [1]}]"};
  for (size_t i = 0; i < sizeof scenarios / sizeof *scenarios; i++) {
    char text[200];
    snprintf(text, sizeof text, "{\"schema\": \"%s\", \"version\": %d, \"scenarios\": %s}",
             REPORT_SCHEMA, REPORT_VERSION, scenarios[i]);
    free(support_write(support_home, "shape.json", text));
    assert_int_equal(support_validate("compare shape.json shape.json"), 4);
    support_expect_text("err", "shape.json: scenarios: number 1 is none");
  }
  assert_int_equal(support_validate("bless empty.json"), 4);
  assert_int_equal(support_validate("bless other.json"), 4);
  assert_int_equal(support_validate("compare other.json"), 2);
  assert_int_equal(support_validate("compare a b c"), 2);
  assert_int_equal(support_validate("bless a b"), 2);
  assert_int_equal(support_validate("compare --nonsense"), 2);
}

static int play(void **state) {
  (void)state;
  support_run *run_of = support_open(NULL, support_scenario_text);
  report r = {.comparisons = support_play(run_of), .count = 1};
  assert_true(provenance_begin(&r.provenance, NULL, 0));
  original = report_document(&r);
  provenance_clear(&r.provenance);
  support_close(run_of);
  return original ? 0 : 1;
}

static int forget(void **state) {
  (void)state;
  json_decref(original);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_changes),
      cmocka_unit_test(test_floor_of_study),
      cmocka_unit_test(test_gates_that_come_and_go),
      cmocka_unit_test(test_windows_are_noticed),
      cmocka_unit_test(test_timings_never_count),
      cmocka_unit_test(test_misfits),
      cmocka_unit_test_setup_teardown(test_bless_and_compare, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_worse_fails, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_wrong_files, support_enter, support_leave),
  };
  return cmocka_run_group_tests(tests, play, forget);
}
