// SPDX-License-Identifier: Apache-2.0
#include "report_read.h"

#include "baseline.h"

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
  if (!gates) return NULL;
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

bool report_agrees(const json_t *object) {
  return strcmp(report_text(object, "verdict"), "agree") == 0;
}

const json_t *report_first_failing(const json_t *document) {
  size_t i;
  const json_t *entry;
  const char *worst = report_text(document, "verdict");
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    if (!report_agrees(document) && strcmp(report_text(entry, "verdict"), worst) == 0) return entry;
  }
  return NULL;
}

const char *report_baseline_words(const json_t *document) {
  if (json_object_get(document, "baseline_problem")) return ", but not compared with the baseline";
  return report_agrees(document) && baseline_is_worse(document) ? ", but worse than the baseline"
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

void report_describe_counts(char *out, size_t size, const json_t *document) {
  size_t i, gates = 0, failed = 0;
  const json_t *entry, *scenarios = json_object_get(document, "scenarios");
  json_array_foreach(scenarios, i, entry) {
    gates += report_count(entry, "gates");
    failed += report_failed_gates(entry);
  }
  int used = snprintf(out, size, "%zu scenario%s, ", i, i == 1 ? "" : "s");
  if (used < 0 || (size_t)used >= size) return;
  if (strcmp(report_text(document, "verdict"), "invalid") == 0)
    snprintf(out + used, size - (size_t)used, "not all of which could be played");
  else if (failed)
    snprintf(out + used, size - (size_t)used, "%zu of %zu gates fail", failed, gates);
  else
    snprintf(out + used, size - (size_t)used, "all %zu gates hold", gates);
}
