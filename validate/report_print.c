// SPDX-License-Identifier: Apache-2.0
// The report for a person at a terminal.
#include "report.h"

#include "layer.h"
#include "report_read.h"
#include "terminal/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Gates shown of a scenario that agrees, beside those that fail: enough to see what limits it.
enum { SHOWN_GATES = 5, CELL = 48 };

static size_t gate_total(const report *r) {
  size_t total = 0;
  for (size_t i = 0; i < r->count; i++) total += r->comparisons[i].gates.count;
  return total;
}

static size_t failed_total(const report *r) {
  size_t total = 0;
  for (size_t i = 0; i < r->count; i++) total += gates_failed(&r->comparisons[i].gates);
  return total;
}

static const char *plural(size_t count) {
  return count == 1 ? "" : "s";
}

static void print_counts(const report *r, FILE *stream) {
  size_t gates = gate_total(r), failed = failed_total(r);
  fprintf(stream, "%zu scenario%s, ", r->count, plural(r->count));
  if (report_verdict(r) == VERDICT_INVALID)
    fprintf(stream, "not all of which could be played\n");
  else if (failed)
    fprintf(stream, "%zu of %zu gates fail\n", failed, gates);
  else
    fprintf(stream, "all %zu gates hold\n", gates);
}

static void print_cause(const comparison *c, FILE *stream) {
  fprintf(stream, "%s %s: %s\n", c->first_failure->name, c->first_failure->title, c->cause);
}

static void print_verdict(const report *r, FILE *stream) {
  static const char *const words[] = {"AGREE", "FAIL", "INVALID"};
  verdict v = report_verdict(r);
  term_style style = v == VERDICT_AGREE ? TERM_GOOD : TERM_BAD;
  const comparison *failure = report_first_failure(r);
  fprintf(stream, "%s%s%s: ", term_style_begin(stream, style), words[v],
          term_style_end(stream, style));
  print_counts(r, stream);
  if (!failure) return;
  fprintf(stream, "First failure: %s, ", failure->scenario->name);
  print_cause(failure, stream);
}

// "12x" within the limit, "0.5x": beyond it.
static void print_margin(char out[CELL], const gate *g) {
  double use = gate_use(g);
  if (use == 0)
    snprintf(out, CELL, "exact");
  else if (isinf(use))
    snprintf(out, CELL, "-");
  else
    snprintf(out, CELL, "%.3gx", 1 / use);
}

// `change`: against the baseline.
static void add_row(term_table *table, const gate *g, const char *change) {
  char signal[MEASUREMENT_FULL_NAME], metric[MEASUREMENT_METRIC], value[CELL], limit[CELL],
      margin[CELL], at[CELL] = "";
  const char *space = *g->what.unit ? " " : "";
  snprintf(value, sizeof value, "%.3g", g->what.value);
  snprintf(limit, sizeof limit, "%.3g%s%s", g->rule->limit, space, g->what.unit);
  print_margin(margin, g);
  if (isfinite(g->what.time)) snprintf(at, sizeof at, "%.4g s", g->what.time);
  term_table_add(
      table, g->pass ? TERM_PLAIN : TERM_BAD,
      (const char *const[]){"", g->what.layer, measurement_full_name(signal, &g->what),
                            measurement_metric(metric, g->what.metric, g->what.from, g->what.to),
                            value, limit, margin, at, change});
}

// `entry` is the scenario in the document.
static void print_gates(const comparison *c, const json_t *entry, bool all, FILE *stream) {
  static const term_column columns[] = {
      {"", TERM_LEFT},        {"layer", TERM_LEFT},  {"signal", TERM_LEFT},
      {"metric", TERM_LEFT},  {"value", TERM_RIGHT}, {"limit", TERM_RIGHT},
      {"margin", TERM_RIGHT}, {"at", TERM_RIGHT},    {"baseline", TERM_LEFT}};
  int count = sizeof columns / sizeof *columns - !json_object_get(entry, "baseline");
  const gate **sorted = gates_by_margin(&c->gates);
  term_table *table = term_table_create(columns, count);
  size_t shown = gates_failed(&c->gates) + SHOWN_GATES;
  if (all || shown > c->gates.count) shown = c->gates.count;
  for (size_t i = 0; sorted && i < shown; i++)
    add_row(table, sorted[i], report_gate_at(entry, (size_t)(sorted[i] - c->gates.items)).change);
  if (shown > 0) term_table_print(table, stream);
  term_table_free(table);
  free(sorted);
}

static void print_scenario(const comparison *c, const json_t *entry, bool explained, bool all,
                           FILE *stream) {
  const scenario *s = c->scenario;
  term_style style = c->verdict == VERDICT_AGREE ? TERM_GOOD : TERM_BAD;
  fprintf(stream, "\n%s%s%s  %s: %s (%zu gate%s)\n", term_style_begin(stream, style),
          verdict_string(c->verdict), term_style_end(stream, style), s->name, s->title,
          c->gates.count, plural(c->gates.count));
  if (c->first_failure && !explained) print_cause(c, stream);
  print_gates(c, entry, all, stream);
}

void report_print(const report *r, const json_t *document, bool all, FILE *stream) {
  const json_t *scenarios = json_object_get(document, "scenarios");
  const comparison *failure = report_first_failure(r);
  print_verdict(r, stream);
  for (size_t i = 0; i < r->count; i++) {
    const comparison *c = &r->comparisons[i];
    print_scenario(c, json_array_get(scenarios, i), c == failure, all, stream);
  }
  if (!all)
    fprintf(stream,
            "\nShown: the %d gates closest to their limits of each scenario (--all: every one); "
            "margin: limit over value.\n",
            SHOWN_GATES);
}
