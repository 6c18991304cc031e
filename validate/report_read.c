// SPDX-License-Identifier: Apache-2.0
#include "report_read.h"

#include "baseline.h"
#include "terminal/message.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *report_text(const json_t *object, const char *key) {
  const char *text = json_string_value(json_object_get(object, key));
  return text ? text : "";
}

double report_real(const json_t *object, const char *key) {
  const json_t *value = json_object_get(object, key);
  return json_is_number(value) ? json_number_value(value) : NAN;
}

size_t report_count(const json_t *object, const char *key) {
  return json_array_size(json_object_get(object, key));
}

// Of `from` and `to`: without them the part begins at the start and ends at the end.
static double bound(const json_t *measured, const char *key) {
  double time = report_real(measured, key);
  return isnan(time) ? 0 : time;
}

const char *report_metric(char out[MEASUREMENT_METRIC], const json_t *measured) {
  return measurement_metric(out, report_text(measured, "metric"), bound(measured, "from"),
                            bound(measured, "to"));
}

report_gate report_gate_at(const json_t *entry, size_t index) {
  const json_t *g = json_array_get(json_object_get(entry, "gates"), index);
  const json_t *baseline = json_object_get(g, "baseline");
  report_gate gate = {
      .layer = report_text(g, "layer"),
      .signal = report_text(g, "signal"),
      .metric = report_text(g, "metric"),
      .unit = report_text(g, "unit"),
      .detail = report_text(g, "detail"),
      .reason = report_text(g, "reason"),
      .value = report_real(g, "value"),
      .limit = report_real(g, "limit"),
      .time = report_real(g, "time"),
      .from = bound(g, "from"),
      .to = bound(g, "to"),
      .pass = json_is_true(json_object_get(g, "pass")),
      .change = report_text(baseline, "change"),
      .before = report_real(baseline, "value"),
      .index = index,
  };
  report_metric(gate.metric_words, g);
  return gate;
}

double report_gate_use(const report_gate *g) {
  if (g->value == 0) return 0;
  if (isnan(g->value)) return INFINITY;
  return g->value / g->limit;
}

static int by_margin(const void *a, const void *b) {
  const report_gate *x = a, *y = b;
  if (x->pass != y->pass) return x->pass ? 1 : -1;
  double use_x = report_gate_use(x), use_y = report_gate_use(y);
  if (use_x != use_y) return use_x < use_y ? 1 : -1;
  return x->index < y->index ? -1 : x->index > y->index;
}

report_gate *report_gates_by_margin(const json_t *entry, size_t *count) {
  *count = report_count(entry, "gates");
  report_gate *gates = calloc(*count + 1, sizeof *gates);
  if (!gates) {
    term_lose();
    *count = 0;
    return NULL;
  }
  for (size_t i = 0; i < *count; i++) gates[i] = report_gate_at(entry, i);
  qsort(gates, *count, sizeof *gates, by_margin);
  return gates;
}

size_t report_failed_gates(const json_t *entry) {
  size_t failed = 0, count = report_count(entry, "gates");
  for (size_t i = 0; i < count; i++) failed += !report_gate_at(entry, i).pass;
  return failed;
}

size_t report_changed_gates(const json_t *entry, const char *change) {
  size_t changed = 0, count = report_count(entry, "gates");
  for (size_t i = 0; i < count; i++)
    changed += strcmp(report_gate_at(entry, i).change, change) == 0;
  return changed;
}

static const char *const verdicts[][2] = {{"agree", "Agree"},
                                          {"differs as expected", "Differs as expected"},
                                          {"fail", "Fail"},
                                          {"invalid", "Invalid"}};

// Index in the table; beyond the verdicts that passed for anything unknown.
static int verdict_index(const json_t *object) {
  const char *v = report_text(object, "verdict");
  int i = 0;
  while (i < 3 && strcmp(v, verdicts[i][0]) != 0) i++;
  return i;
}

bool report_passed(const json_t *object) {
  return verdict_index(object) < 2;
}

const char *report_verdict_title(const json_t *object) {
  return verdicts[verdict_index(object)][1];
}

const json_t *report_first_failing(const json_t *document) {
  size_t i;
  const json_t *entry;
  const char *worst = report_text(document, "verdict");
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    if (!report_passed(document) && strcmp(report_text(entry, "verdict"), worst) == 0) return entry;
  }
  return NULL;
}

const char *report_baseline_words(const json_t *document) {
  if (json_object_get(document, "baseline_problem")) return ", but not compared with the baseline";
  return report_passed(document) && baseline_is_worse(document) ? ", but worse than the baseline"
                                                                : "";
}

const json_t *report_engine(const json_t *entry, const char *role) {
  size_t i;
  const json_t *player;
  json_array_foreach(json_object_get(entry, "engines"), i, player) {
    if (strcmp(report_text(player, "role"), role) == 0) return player;
  }
  return NULL;
}

const char *report_describe_counts(char out[REPORT_COUNTS_TEXT], const json_t *document) {
  static const struct {
    const char *key, *one, *many;
  } kinds[] = {{"invalid", "could not be played", "could not be played"},
               {"fail", "fails", "fail"},
               {"agree", "agrees", "agree"},
               {"differ", "differs as expected", "differ as expected"}};
  const json_t *counts = json_object_get(document, "counts");
  double all = report_real(counts, "measurements"), failed = report_real(counts, "failed");
  size_t used = 0;
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    double count = report_real(counts, kinds[i].key);
    if (!(count > 0)) continue;
    const char *noun = used ? "" : count == 1 ? "scenario " : "scenarios ";
    used += (size_t)snprintf(out + used, REPORT_COUNTS_TEXT - used, "%s%.0f %s%s", used ? ", " : "",
                             count, noun, count == 1 ? kinds[i].one : kinds[i].many);
  }
  char of[32] = "";
  if (failed > 0) snprintf(of, sizeof of, "%.0f of ", failed);
  snprintf(out + used, REPORT_COUNTS_TEXT - used, "; %s%.0f independent measurement%s %s limits",
           of, all, all == 1 ? "" : "s", failed > 0 ? "beyond their" : "within their");
  return out;
}
