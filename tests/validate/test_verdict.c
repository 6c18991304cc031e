// SPDX-License-Identifier: Apache-2.0
// What the verdict says: that models differ as expected is not that they agree, and what is counted
// are measurements, not gates.
#include "junit_check.h"
#include "support/near.h"
#include "validate_support.h"

#include <report.h>
#include <report_counts.h>
#include <report_read.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// MuJoCo's soft contacts against exact rolling, half a second.
static const char contact_text[] =
    "title: contacts\nbicycle: benchmark\nstart: {speed: 5, lean_rate: 0.5}\nduration: 0.5\n"
    "sample: 0.02\ninstants: {count: 0}\nreference: {engine: analytic}\n"
    "candidate: {engine: mujoco, rolling: contact, integrator: implicit, solref: 0.02}\n"
    "convergence: {timesteps: [1e-3, 5e-4, 2.5e-4, 2e-4], tolerance: 1e-6, expect: %s}\n"
    "gates:\n  - {layer: L4, metric: plateau, limit: %s, reason: test}\n";

static support_run *play_contact(const char *expect, const char *limit) {
  char text[900];
  snprintf(text, sizeof text, contact_text, expect, limit);
  support_run *run = support_open(NULL, text);
  support_play(run);
  return run;
}

static void expect_part(const char *text, const char *part) {
  if (!text || !strstr(text, part)) fail_msg("no '%s' in '%s'", part, text ? text : "nothing");
}

static void check_file(const char *folder, const char *name, const char *part) {
  char *path = NULL;
  assert_true(asprintf(&path, "%s/%s", folder, name) > 0);
  char *text = support_read(path);
  expect_part(text, part);
  if (strcmp(name, "junit.xml") == 0) junit_check(text);
  free(text);
  free(path);
}

static void check_terminal(const json_t *document, const char *part) {
  char *text = NULL;
  size_t size;
  FILE *stream = open_memstream(&text, &size);
  assert_non_null(stream);
  report_print(document, false, stream);
  assert_int_equal(fclose(stream), 0);
  expect_part(text, part);
  free(text);
}

static json_t *document_of(report *r, const char *folder) {
  problem p = {""};
  char *target = NULL;
  assert_true(provenance_begin(&r->provenance, NULL, 0));
  json_t *document = report_document(r);
  assert_non_null(document);
  assert_true(asprintf(&target, "%s/report", folder) > 0);
  assert_int_equal(report_write(r, document, target, &p), TERM_DONE);
  free(target);
  provenance_clear(&r->provenance);
  return document;
}

static void test_differs_in_every_view(void **state) {
  (void)state;
  support_run *run = play_contact("different-model", "0.1");
  assert_string_equal(run->comparison.cause, "");
  assert_int_equal(run->comparison.verdict, VERDICT_DIFFER);
  assert_int_equal(verdict_exit(VERDICT_DIFFER), TERM_DONE);
  report r = {.comparisons = &run->comparison, .count = 1};
  json_t *document = document_of(&r, run->folder);
  static const struct {
    const char *file, *part;
  } views[] = {
      {"report/report.json", "\"verdict\": \"differs as expected\""},
      {"report/report.html", "<h1>Differs as expected<span>: 1 scenario differs as"},
      {"report/report.html", "<span class='badge differs as expected'>differs as expected<"},
      {"report/report.html", "<td class='differs as expected'>Differs as expected<"},
      // Only the ends of the rides are judged in L2: that is no margin of the traces, which differ.
      {"report/report.html", ">test</a><td class=dim>-<td"},
      {"report/summary.md", "## Differs as expected: 1 scenario differs as expected; "},
      {"report/summary.md", "| differs as expected | test |"},
      {"report/junit.xml", "<testcase classname=\"test\" name=\"differs as expected\"/>"}};
  for (size_t i = 0; i < sizeof views / sizeof *views; i++)
    check_file(run->folder, views[i].file, views[i].part);
  check_terminal(document, "DIFFERS AS EXPECTED: 1 scenario differs as expected; ");
  check_terminal(document, "\ndiffers as expected  test: contacts (");
  json_decref(document);
  support_close(run);
}

// Only a difference that was measured and is within all limits is as expected.
static void test_other_differences_fail(void **state) {
  (void)state;
  support_run *same = play_contact("same-equations", "0.1");
  support_expect_failure(&same->comparison, "L4", "different model");
  support_close(same);
  support_run *large = play_contact("different-model", "1e-9");
  support_expect_failure(&large->comparison, "L4", "plateau");
  support_close(large);
  char text[900];
  snprintf(text, sizeof text, contact_text, "different-model", "0.1");
  char *rolling = support_replace(text, "rolling: contact, integrator: implicit, solref: 0.02",
                                  "integrator: rk4");
  char *equal = support_replace(rolling, "1e-3, 5e-4, 2.5e-4, 2e-4", "1e-2, 5e-3, 2.5e-3, 1.25e-3");
  support_expect_fault(NULL, equal, "L4", "do not converge as expected");
  support_expect_fault(NULL, equal, "L4", "same equations");
  free(rolling);
  free(equal);
}

// A scenario that differs among others that agree, and then beside one that fails.
static void test_mixed_documents(void **state) {
  (void)state;
  static const struct {
    verdict verdicts[3], all;
    const char *counts;
  } cases[] = {
      {{VERDICT_AGREE, VERDICT_DIFFER, VERDICT_AGREE},
       VERDICT_AGREE,
       "2 scenarios agree, 1 differs as expected; "},
      {{VERDICT_DIFFER, VERDICT_DIFFER, VERDICT_DIFFER},
       VERDICT_DIFFER,
       "3 scenarios differ as expected; "},
      {{VERDICT_DIFFER, VERDICT_FAIL, VERDICT_AGREE},
       VERDICT_FAIL,
       "1 scenario fails, 1 agrees, 1 differs as expected; "},
      {{VERDICT_FAIL, VERDICT_INVALID, VERDICT_DIFFER},
       VERDICT_INVALID,
       "1 scenario could not be played, 1 fails, 1 differs as expected; "},
  };
  support_run *run = support_open(NULL, support_scenario_text);
  support_play(run);
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    comparison three[3];
    char counts[REPORT_COUNTS_TEXT];
    for (int k = 0; k < 3; k++) {
      three[k] = run->comparison;
      three[k].verdict = cases[i].verdicts[k];
    }
    report r = {.comparisons = three, .count = 3};
    assert_true(provenance_begin(&r.provenance, NULL, 0));
    json_t *document = report_document(&r);
    assert_int_equal(report_verdict(&r), cases[i].all);
    assert_string_equal(report_text(document, "verdict"), verdict_string(cases[i].all));
    assert_ptr_equal(strstr(report_describe_counts(counts, document), cases[i].counts), counts);
    assert_int_equal(report_passed(document), cases[i].all <= VERDICT_DIFFER);
    json_decref(document);
    provenance_clear(&r.provenance);
  }
  support_close(run);
}

static void expect_counts(const char *scenarios, int measurements, int failed) {
  json_t *list = json_loads(scenarios, 0, NULL), *counts = report_counts(list);
  assert_non_null(counts);
  assert_int_equal(json_integer_value(json_object_get(counts, "measurements")), measurements);
  assert_int_equal(json_integer_value(json_object_get(counts, "failed")), failed);
  json_decref(counts);
  json_decref(list);
}

#define GATE(layer, signal, metric, value, pass)                                                   \
  "{\"layer\": \"" layer "\", \"signal\": \"" signal "\", \"metric\": \"" metric                   \
  "\", \"value\": " value ", \"limit\": 1, \"pass\": " pass "}"
#define SCENARIO(name, bicycle, gates)                                                             \
  "{\"name\": \"" name "\", \"parameter_sha256\": \"" bicycle "\", \"gates\": [" gates "]}"

static void test_independent_measurements(void **state) {
  (void)state;
  // Two metrics and a part of the ride are one quantity; another engine's and another layer's are
  // not.
  expect_counts("[" SCENARIO("a", "b",
                             GATE("L2", "lean", "max", "1e-12", "true") "," GATE(
                                 "L2", "lean", "rmse", "1e-13",
                                 "true") "," GATE("L3", "u.energy", "max", "1e-13",
                                                  "true") "," GATE("L3", "v.energy", "max", "1e-13",
                                                                   "true")) "]",
                3, 0);
  // A copied number is exactly zero; beside a metric that is not it does not hide the quantity.
  expect_counts("[" SCENARIO("a", "b",
                             GATE("Lp", "u.trail", "relative", "0.0", "true") "," GATE(
                                 "L2", "lean", "end", "0.0", "true") "," GATE("L2", "lean", "max",
                                                                              "1e-13", "true")) "]",
                1, 0);
  // Repeated to the last bit for the same bicycle, not for another one, nor with another value.
  expect_counts(
      "[" SCENARIO("a", "b", GATE("L0", "pitch", "relative", "1e-13", "true")) "," SCENARIO(
          "c", "b",
          GATE("L0", "pitch", "relative", "1e-13",
               "true")) "," SCENARIO("d", "e",
                                     GATE("L0", "pitch", "relative", "1e-13",
                                          "true")) "," SCENARIO("f", "b",
                                                                GATE("L0", "pitch", "relative",
                                                                     "1.0000000000000002e-13",
                                                                     "true")) "]",
      3, 0);
  // A limit on what could not be measured fails; a quantity fails with any of its metrics.
  expect_counts(
      "[" SCENARIO("a", "b",
                   GATE("L2", "x", "max", "null", "false") "," GATE(
                       "L2", "lean", "max", "0.5",
                       "true") "," GATE("L2", "lean", "end", "2.5",
                                        "false") "," GATE("L2", "steer", "max", "0.5", "true")) "]",
      3, 2);
  expect_counts("[" SCENARIO("a", "b", "") "]", 0, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_differs_in_every_view),
      cmocka_unit_test(test_other_differences_fail),
      cmocka_unit_test(test_mixed_documents),
      cmocka_unit_test(test_independent_measurements),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
