// SPDX-License-Identifier: Apache-2.0
// Baselines: what counts as better, same, worse; what cannot be compared; the commands.
#include "junit_check.h"
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

// In time that is not quadratic: with that, 30000 gates take some minutes, beyond the time limit.
static void test_many_gates(void **state) {
  (void)state;
  enum { GATES = 30000 };
  json_t *a = copy(), *gates = json_object_get(entry_of(a), "gates");
  json_t *like = json_deep_copy(gate_of(a, "lean"));
  json_array_clear(gates);
  for (int i = 0; i < GATES; i++) {
    json_t *one = json_deep_copy(like);
    json_object_set_new(one, "signal", json_sprintf("lean%d", i));
    json_array_append_new(gates, one);
  }
  json_decref(like);
  json_t *b = json_deep_copy(a);
  json_array_remove(json_object_get(entry_of(b), "gates"), GATES / 2);
  assert_true(baseline_compare(b, a));
  const json_t *block = json_object_get(entry_of(b), "baseline");
  assert_near(report_real(block, "same"), GATES - 1, 0);
  assert_near(report_real(block, "new"), 0, 0);
  const json_t *gone = json_object_get(block, "gone");
  assert_string_equal(json_string_value(json_array_get(gone, 0)), "L2 lean15000 max");
  json_decref(a);
  json_decref(b);
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
  // Version 1 had no counts, and knew no scenario that differs as expected.
  json_t *older = json_deep_copy(document);
  json_object_set_new(older, "version", json_integer(1));
  json_object_del(older, "counts");
  save(older, "older.json");
  json_decref(older);
  assert_int_equal(support_validate("compare older.json bicycle-report"), 1);
  assert_int_equal(support_validate("compare bicycle-report older.json"), 0);
  support_expect_text("out", "BETTER than");
  json_object_set_new(document, "version", json_integer(REPORT_VERSION + 1));
  save(document, "newer.json");
  assert_int_equal(support_validate("test.yml --baseline newer.json"), 4);
  json_object_set_new(document, "verdict", json_string("invalid"));
  json_object_set_new(document, "version", json_integer(REPORT_VERSION));
  save(document, "invalid.json");
  assert_int_equal(support_validate("bless invalid.json -o no.json"), 3);
  json_decref(document);
  free(path);
}

static json_t *with_another_scenario(void) {
  json_t *document = copy(), *other = json_deep_copy(entry_of(document));
  json_object_set_new(other, "name", json_string("a <lost> one"));
  json_array_append_new(json_object_get(document, "scenarios"), other);
  return document;
}

static void expect_junit(void) {
  char *text = support_output("bicycle-report/junit.xml");
  assert_non_null(text);
  junit_check(text);
  free(text);
}

// A scenario that is no longer played hides all that it would have found: every view names it.
static void test_missing_scenario(void **state) {
  (void)state;
  free(support_write(support_home, "test.yml", support_scenario_text));
  json_t *a = with_another_scenario();
  save(a, "two.json");
  save(original, "one.json");
  assert_int_equal(support_validate("compare two.json one.json"), 1);
  support_expect_text("out", "WORSE than");
  support_expect_text("out", "missing scenario: a <lost> one");
  assert_int_equal(support_validate("compare two.json one.json --json"), 1);
  support_expect_text("out", "\"missing\": [\n      \"a <lost> one\"");
  assert_int_equal(support_validate("compare two.json two.json"), 0);
  assert_int_equal(support_validate("test.yml --baseline two.json"), 1);
  support_expect_text("out", "missing scenario: a <lost> one");
  support_expect_text("bicycle-report/report.html", "Missing scenario: a &lt;lost&gt; one");
  support_expect_text("bicycle-report/report.html", "but worse than the baseline");
  support_expect_text("bicycle-report/summary.md", "- missing scenario: a \\<lost\\> one");
  support_expect_text("bicycle-report/summary.md", "but worse than the baseline");
  support_expect_text("bicycle-report/junit.xml",
                      "<testsuite name=\"a &lt;lost&gt; one\" tests=\"1\" "
                      "failures=\"1\" errors=\"0\">");
  expect_junit();
  json_decref(a);
}

// So does a gate that is no longer measured.
static void test_gone_gate_in_views(void **state) {
  (void)state;
  json_t *a = copy();
  json_t *gone = json_deep_copy(gate_of(a, "lean"));
  json_object_set_new(gone, "signal", json_string("pitch"));
  json_array_append_new(json_object_get(entry_of(a), "gates"), gone);
  save(a, "more.json");
  free(support_write(support_home, "test.yml", support_scenario_text));
  assert_int_equal(support_validate("test.yml --baseline more.json"), 1);
  support_expect_text("out", "no longer measured: test L2 pitch max");
  support_expect_text("bicycle-report/report.html", "No longer measured: test L2 pitch max");
  support_expect_text("bicycle-report/summary.md", "- no longer measured: test L2 pitch max");
  support_expect_text("bicycle-report/junit.xml",
                      "<testcase classname=\"test\" name=\"L2 pitch max\">\n      <failure");
  expect_junit();
  json_decref(a);
}

static void expect_told(const char *why) {
  static const char *const views[] = {"out",
                                      "err",
                                      "bicycle-report/report.json",
                                      "bicycle-report/report.html",
                                      "bicycle-report/junit.xml",
                                      "bicycle-report/summary.md"};
  for (size_t i = 0; i < sizeof views / sizeof *views; i++) support_expect_text(views[i], why);
  support_expect_text("bicycle-report/report.json", "\"baseline_problem\": ");
  support_expect_text("bicycle-report/report.html", "but not compared with the baseline");
  support_expect_text("bicycle-report/junit.xml", "errors=\"1\">\n  <testsuite name=\"test\"");
  support_expect_text("bicycle-report/junit.xml", "<testsuite name=\"baseline\" tests=\"1\"");
  expect_junit();
}

// With exit status 4 every view says why: no file, a damaged one, one of other rides.
static void test_no_comparison_is_told(void **state) {
  (void)state;
  free(support_write(support_home, "test.yml", support_scenario_text));
  assert_int_equal(support_validate("test.yml --baseline none.json"), 4);
  expect_told("none.json: No such file");
  free(support_write(support_home, "half.json", "{\"schema\": "));
  assert_int_equal(support_validate("test.yml --baseline half.json"), 4);
  expect_told("half.json:1: ");
  json_t *a = copy();
  json_object_set_new(json_object_get(entry_of(a), "setup"), "duration", json_real(9));
  save(a, "other.json");
  assert_int_equal(support_validate("test.yml --baseline other.json"), 4);
  expect_told("is another ride: duration differs");
  json_decref(a);
}

// A pipe that nobody writes to is not waited for; what the shell has opened is read.
static void test_pipes(void **state) {
  (void)state;
  free(support_write(support_home, "test.yml", support_scenario_text));
  free(support_write(support_home, "again.sh",
                     "exec timeout 20 \"$1\" compare <(cat one.json) /dev/stdin <one.json\n"));
  save(original, "one.json");
  assert_int_equal(support_validate("list >/dev/null; mkfifo pipe; ln -s pipe link"), 0);
  static const char *const commands[] = {
      "compare pipe one.json",  "compare one.json link",    "bless pipe",
      "bless one.json -o pipe", "test.yml --baseline pipe", "pipe",
      "./pipe -o report"};
  for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
    assert_int_equal(support_validate(commands[i]), 2);
    support_expect_text("err", "is a named pipe");
  }
  assert_int_equal(support_validate("list >/dev/null; bash again.sh " BICYCLE_BINARY_DIR
                                    "/bin/bicycle-validate"),
                   0);
  support_expect_text("out", "SAME as");
  // A report folder of which the list of files is such a pipe is no report.
  assert_int_equal(support_validate("list >/dev/null; mkdir folder; mkfifo folder/report.json"), 0);
  assert_int_equal(support_validate("test.yml -o folder"), 2);
}

// One change of a saved report, JSON at a path, makes it none.
static void test_damaged_reports(void **state) {
  (void)state;
  static const struct {
    const char *key, *value, *message; // of the document; "/KEY" of its scenario, "//KEY" of a gate
  } cases[] = {
      {"version", "null", ": version: 0, but"},
      {"version", "1.5", ": version: 0, but"},
      {"verdict", "null", ": 'verdict' is missing"},
      {"verdict", "\"good\"", ": 'verdict' is missing"},
      {"scenarios", "null", ": 'scenarios' is missing"},
      {"scenarios", "{}", ": 'scenarios' is missing"},
      {"scenarios", "[null]", ": scenarios: number 1: 'name'"},
      {"/name", "null", ": scenarios: number 1: 'name'"},
      {"/verdict", "1", ": scenarios: number 1: 'verdict'"},
      {"/gates", "null", ": scenarios: number 1: 'gates'"},
      {"/gates", "[null]", ": scenarios: number 1: gates: number 1: 'layer'"},
      {"//layer", "7", ": scenarios: number 1: gates: number 1: 'layer'"},
      {"//signal", "\"\"", ": scenarios: number 1: gates: number 1: 'signal'"},
      {"//value", "\"small\"", ": scenarios: number 1: gates: number 1: 'value'"},
      {"//limit", "null", ": scenarios: number 1: gates: number 1: 'limit'"},
      {"//pass", "1", ": scenarios: number 1: gates: number 1: 'pass'"},
      {"//from", "null", ": scenarios: number 1: gates: number 1: 'from'"},
  };
  char *path = support_write(support_home, "damaged.json", "");
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    json_t *document = copy(), *read = NULL, *of = document;
    const char *key = cases[i].key;
    problem p = {""};
    if (*key == '/') of = entry_of(document), key++;
    if (*key == '/') of = json_array_get(json_object_get(of, "gates"), 0), key++;
    json_object_set_new(of, key, json_loads(cases[i].value, JSON_DECODE_ANY, NULL));
    save(document, "damaged.json");
    assert_int_equal(baseline_read(&read, path, &p), TERM_BASELINE);
    assert_null(read);
    if (!strstr(p.text, cases[i].message)) fail_msg("'%s' instead of %s", p.text, cases[i].message);
    json_decref(document);
  }
  free(path);
}

static void expect_damaged(const char *text, const char *message) {
  char *path = support_write(support_home, "damaged.json", text);
  json_t *read = NULL;
  problem p = {""};
  assert_int_equal(baseline_read(&read, path, &p), TERM_BASELINE);
  assert_null(read);
  if (!strstr(p.text, message)) fail_msg("'%s' instead of '%s'", p.text, message);
  free(path);
}

// Whatever the text is cut to, and whatever else JSON may hold.
static void test_damaged_texts(void **state) {
  (void)state;
  char *text = json_dumps(original, 0), *deep = calloc(1, 100001);
  size_t length = strlen(text);
  for (size_t cut = 0; cut < length; cut += 1 + length / 50) {
    char *part = strndup(text, cut);
    expect_damaged(part, "damaged.json:");
    free(part);
  }
  memset(deep, '[', 100000);
  expect_damaged(deep, "damaged.json:1: maximum parsing depth reached");
  expect_damaged("{\"schema\": 1, \"schema\": 2}", "damaged.json:1: duplicate object key");
  expect_damaged("{\"version\": 1e999}", "damaged.json:1: real number overflow");
  expect_damaged("{\"version\": 1\\u0000}", "damaged.json:1: ");
  expect_damaged("{\"a\": \"\xff\"}", "damaged.json:1: ");
  json_t *twice = copy();
  json_array_append(json_object_get(twice, "scenarios"), entry_of(twice));
  char *again = json_dumps(twice, 0);
  expect_damaged(again, ": scenarios: two have the name 'test'");
  json_decref(twice);
  free(again);
  free(deep);
  free(text);
}

// Names in a saved report are anything; a message stays one line that a terminal can show.
static void test_odd_names(void **state) {
  (void)state;
  problem p = {""};
  json_t *now = json_pack("{s:[{s:s}]}", "scenarios", "name", "a\033[2J\nb\xc3\xa9"),
         *before = json_pack("{s:[]}", "scenarios");
  assert_int_equal(baseline_match(now, before, &p), TERM_BASELINE);
  assert_string_equal(p.text, "the baseline has no scenario 'a?[2J?b\xc3\xa9'");
  json_decref(now);
  json_decref(before);
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
      cmocka_unit_test(test_many_gates),
      cmocka_unit_test(test_odd_names),
      cmocka_unit_test_setup_teardown(test_bless_and_compare, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_worse_fails, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_missing_scenario, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_gone_gate_in_views, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_no_comparison_is_told, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_pipes, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_damaged_reports, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_damaged_texts, support_enter, support_leave),
      cmocka_unit_test_setup_teardown(test_wrong_files, support_enter, support_leave),
  };
  return cmocka_run_group_tests(tests, play, forget);
}
