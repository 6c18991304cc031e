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

static void print_gate(FILE *stream, const char *name, const report_gate *g) {
  char value[REPORT_NUMBER], limit[REPORT_NUMBER], time[REPORT_NUMBER];
  report_markup(stream, "    <testcase classname=\"%s.%s\" name=\"%s %s\"", name, g->layer,
                g->signal, g->metric_words);
  bool worse = strcmp(g->change, "worse") == 0;
  if (g->pass && !worse) {
    fputs("/>\n", stream);
    return;
  }
  report_markup(stream, ">\n      <failure message=\"%s, limit %s%s%s\">",
                report_quantity(value, g->value, g->unit),
                report_quantity(limit, g->limit, g->unit), isnan(g->time) ? "" : ", at ",
                isnan(g->time) ? "" : report_quantity(time, g->time, "s"));
  if (worse)
    report_markup(stream, "worse than the baseline's %s. ", report_number(value, g->before));
  report_markup(stream, "%s%s%s</failure>\n    </testcase>\n", g->detail, *g->detail ? ". " : "",
                g->reason);
}

static size_t count_failures(const json_t *entry) {
  size_t failures = 0;
  for (size_t i = 0; i < report_count(entry, "gates"); i++) {
    report_gate g = report_gate_at(entry, i);
    failures += !g.pass || strcmp(g.change, "worse") == 0;
  }
  return failures;
}

static bool is_invalid(const json_t *entry) {
  return strcmp(report_text(entry, "verdict"), "invalid") == 0;
}

static void print_suite(FILE *stream, const json_t *document, const json_t *entry) {
  const char *name = report_text(entry, "name");
  size_t gates = report_count(entry, "gates");
  bool invalid = is_invalid(entry);
  report_markup(stream, "  <testsuite name=\"%s\"", name);
  fprintf(stream, " tests=\"%zu\" failures=\"%zu\" errors=\"%d\" skipped=\"0\" time=\"%.6f\"",
          gates + invalid, count_failures(entry), invalid, ride_seconds(document, name));
  report_markup(stream, " timestamp=\"%s\">\n",
                report_text(json_object_get(document, "provenance"), "created"));
  if (invalid)
    report_markup(stream,
                  "    <testcase classname=\"%s\" name=\"the run is valid\">\n      <error "
                  "message=\"%s\"/>\n    </testcase>\n",
                  name, report_text(entry, "cause"));
  for (size_t i = 0; i < gates; i++) {
    report_gate g = report_gate_at(entry, i);
    print_gate(stream, name, &g);
  }
  fputs("  </testsuite>\n", stream);
}

bool report_junit(const report *r, const json_t *document, FILE *stream) {
  size_t i, tests = 0, failures = 0, errors = 0;
  const json_t *entry, *scenarios = json_object_get(document, "scenarios");
  (void)r;
  json_array_foreach(scenarios, i, entry) {
    bool invalid = is_invalid(entry);
    tests += report_count(entry, "gates") + invalid;
    failures += count_failures(entry);
    errors += invalid;
  }
  fprintf(stream,
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"bicycle validate\" "
          "tests=\"%zu\" failures=\"%zu\" errors=\"%zu\">\n",
          tests, failures, errors);
  json_array_foreach(scenarios, i, entry) {
    print_suite(stream, document, entry);
  }
  fputs("</testsuites>\n", stream);
  return true;
}
