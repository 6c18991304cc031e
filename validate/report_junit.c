// SPDX-License-Identifier: Apache-2.0
// junit.xml: a suite for each scenario, a test for each gate; the form that Jenkins and GitLab
// read.
#include "report_views.h"

#include "report_markup.h"
#include "report_read.h"

#include <math.h>
#include <string.h>

// Seconds that the rides of a scenario took.
static double ride_seconds(const json_t *document, const char *name) {
  size_t i;
  const json_t *ride;
  const json_t *origin = json_object_get(document, "provenance");
  double sum = 0;
  json_array_foreach(json_object_get(json_object_get(origin, "timings"), "rides"), i, ride) {
    const char *key;
    json_t *value;
    if (strcmp(report_text(ride, "scenario"), name) != 0) continue;
    json_object_foreach((json_t *)ride, key, value) {
      if (json_is_real(value)) sum += json_real_value(value);
    }
  }
  return sum;
}

static bool is_worse(const report_gate *g) {
  return strcmp(g->change, "worse") == 0;
}

static bool is_invalid(const json_t *entry) {
  return strcmp(report_text(entry, "verdict"), "invalid") == 0;
}

//---------------------------------- counting ------------------------------------------------------

// What a suite, or the whole, holds.
typedef struct tally {
  size_t tests, failures, errors;
} tally;

// What has no gate of its own: one test that passes says it.
static bool is_different(const json_t *entry) {
  return report_passed(entry) && strcmp(report_text(entry, "verdict"), "agree") != 0;
}

static size_t gone_count(const json_t *entry) {
  return report_count(json_object_get(entry, "baseline"), "gone");
}

static tally tally_of(const json_t *entry) {
  size_t gates = report_count(entry, "gates"), gone = gone_count(entry);
  tally t = {gates + gone, gone, 0};
  for (size_t i = 0; i < gates; i++) {
    report_gate g = report_gate_at(entry, i);
    t.failures += !g.pass || is_worse(&g);
  }
  t.errors = is_invalid(entry);
  t.tests += t.errors + is_different(entry);
  return t;
}

static tally tally_of_all(const json_t *document) {
  size_t i, missing = report_count(json_object_get(document, "baseline"), "missing");
  size_t problems = json_object_get(document, "baseline_problem") != NULL;
  const json_t *entry;
  tally sum = {missing + problems, missing, problems};
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    tally t = tally_of(entry);
    sum.tests += t.tests;
    sum.failures += t.failures;
    sum.errors += t.errors;
  }
  return sum;
}

static void print_tally(FILE *stream, tally t) {
  fprintf(stream, " tests=\"%zu\" failures=\"%zu\" errors=\"%zu\"", t.tests, t.failures, t.errors);
}

//---------------------------------- printing ------------------------------------------------------

// A test that did not pass: `kind` is "failure" or "error".
static void print_fault(FILE *stream, const char *class, const char *name, const char *kind,
                        const char *message) {
  report_markup(stream, "    <testcase classname=\"%s\" name=\"%s\">\n      <", class, name);
  fputs(kind, stream);
  report_markup(stream, " message=\"%s\"/>\n    </testcase>\n", message);
}

// "0.012 rad, limit 1e-09 rad, at 1.2 s; worse than the baseline's 0.011"
static void print_value(FILE *stream, const report_gate *g) {
  char value[REPORT_NUMBER], limit[REPORT_NUMBER], time[REPORT_NUMBER];
  report_markup(stream, "%s, limit %s", report_quantity(value, g->value, g->unit),
                report_quantity(limit, g->limit, g->unit));
  if (!isnan(g->time)) report_markup(stream, ", at %s", report_quantity(time, g->time, "s"));
  if (is_worse(g))
    report_markup(stream, "; worse than the baseline's %s", report_number(value, g->before));
}

// The message of a gate that fails ends with the scenario's cause.
static void print_gate(FILE *stream, const char *name, const char *cause, const report_gate *g) {
  report_markup(stream, "    <testcase classname=\"%s.%s\" name=\"%s %s\"", name, g->layer,
                g->signal, g->metric_words);
  if (g->pass && !is_worse(g)) {
    fputs("/>\n", stream);
    return;
  }
  fputs(">\n      <failure message=\"", stream);
  print_value(stream, g);
  if (!g->pass && *cause) report_markup(stream, ": %s", cause);
  report_markup(stream, "\">%s%s%s</failure>\n    </testcase>\n", g->detail, *g->detail ? ". " : "",
                g->reason);
}

static void print_gone(FILE *stream, const char *name, const json_t *entry) {
  size_t i;
  const json_t *gone;
  json_array_foreach(json_object_get(json_object_get(entry, "baseline"), "gone"), i, gone) {
    print_fault(stream, name, json_string_value(gone), "failure",
                "no longer measured: the baseline has this gate");
  }
}

// Times have three decimals: Jenkins' schema (junit-10.xsd, SUREFIRE_TIME) allows no more.
static void print_suite(FILE *stream, const json_t *document, const json_t *entry) {
  const char *name = report_text(entry, "name"), *cause = report_text(entry, "cause");
  report_markup(stream, "  <testsuite name=\"%s\"", name);
  print_tally(stream, tally_of(entry));
  fprintf(stream, " skipped=\"0\" time=\"%.3f\"", ride_seconds(document, name));
  report_markup(stream, " timestamp=\"%s\">\n",
                report_text(json_object_get(document, "provenance"), "created"));
  if (is_invalid(entry)) print_fault(stream, name, "the run is valid", "error", cause);
  if (is_different(entry))
    report_markup(stream, "    <testcase classname=\"%s\" name=\"%s\"/>\n", name,
                  report_text(entry, "verdict"));
  for (size_t i = 0; i < report_count(entry, "gates"); i++) {
    report_gate g = report_gate_at(entry, i);
    print_gate(stream, name, cause, &g);
  }
  print_gone(stream, name, entry);
  fputs("  </testsuite>\n", stream);
}

// A suite of one test that did not pass.
static void print_lone(FILE *stream, const char *suite, const char *test, const char *kind,
                       const char *message) {
  const bool failure = strcmp(kind, "failure") == 0;
  report_markup(stream, "  <testsuite name=\"%s\"", suite);
  print_tally(stream, (tally){1, failure, !failure});
  fputs(">\n", stream);
  print_fault(stream, suite, test, kind, message);
  fputs("  </testsuite>\n", stream);
}

// Scenarios of the baseline that were not played, and a baseline that cannot be compared with.
static void print_baseline(FILE *stream, const json_t *document) {
  size_t i;
  const json_t *name;
  if (json_object_get(document, "baseline_problem"))
    print_lone(stream, "baseline", "the baseline can be compared with", "error",
               report_text(document, "baseline_problem"));
  json_array_foreach(json_object_get(json_object_get(document, "baseline"), "missing"), i, name) {
    print_lone(stream, json_string_value(name), "the scenario is played", "failure",
               "missing: the baseline has this scenario");
  }
}

bool report_junit(const report *r, const json_t *document, FILE *stream) {
  size_t i;
  const json_t *entry;
  (void)r;
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"bicycle validate\"",
        stream);
  print_tally(stream, tally_of_all(document));
  fputs(">\n", stream);
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    print_suite(stream, document, entry);
  }
  print_baseline(stream, document);
  fputs("</testsuites>\n", stream);
  return true;
}
