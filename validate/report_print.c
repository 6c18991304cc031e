// SPDX-License-Identifier: Apache-2.0
// The report for a person at a terminal.
#include "report.h"

#include "layer.h"
#include "report_markup.h"
#include "report_read.h"
#include "terminal/table.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Gates shown of a scenario that agrees, beside those that fail: enough to see what limits it.
enum { SHOWN_GATES = 5 };

static void print_coloured(FILE *stream, const json_t *object, const char *word) {
  term_style style = report_passed(object) ? TERM_GOOD : TERM_BAD;
  fprintf(stream, "%s%s%s", term_style_begin(stream, style), word, term_style_end(stream, style));
}

static void print_cause(const json_t *object, FILE *stream) {
  const layer *l = layer_find(report_text(object, "first_failure"));
  fprintf(stream, "%s %s: %s\n", l ? l->name : "", l ? l->title : "", report_text(object, "cause"));
}

static void print_verdict(const json_t *document, FILE *stream) {
  char counts[REPORT_COUNTS_TEXT], title[32];
  const json_t *failing = report_first_failing(document);
  snprintf(title, sizeof title, "%s", report_verdict_title(document));
  for (char *at = title; *at; at++) *at = (char)toupper((unsigned char)*at);
  print_coloured(stream, document, title);
  fprintf(stream, ": %s\n", report_describe_counts(counts, document));
  if (!failing) return;
  fprintf(stream, "First failure: %s, ", report_text(failing, "name"));
  print_cause(failing, stream);
}

static void add_row(term_table *table, const report_gate *g) {
  char value[REPORT_NUMBER], limit[REPORT_NUMBER], margin[REPORT_NUMBER], at[REPORT_NUMBER] = "";
  if (isfinite(g->time)) snprintf(at, sizeof at, "%.4g s", g->time);
  term_table_add(table, g->pass ? TERM_PLAIN : TERM_BAD,
                 (const char *const[]){"", g->layer, g->signal, g->metric_words,
                                       report_number(value, g->value),
                                       report_quantity(limit, g->limit, g->unit),
                                       report_margin(margin, report_gate_use(g)), at, g->change});
}

static void print_gates(const json_t *entry, bool all, FILE *stream) {
  static const term_column columns[] = {
      {"", TERM_LEFT},        {"layer", TERM_LEFT},  {"signal", TERM_LEFT},
      {"metric", TERM_LEFT},  {"value", TERM_RIGHT}, {"limit", TERM_RIGHT},
      {"margin", TERM_RIGHT}, {"at", TERM_RIGHT},    {"baseline", TERM_LEFT}};
  size_t count, shown = report_failed_gates(entry) + SHOWN_GATES;
  report_gate *gates = report_gates_by_margin(entry, &count);
  term_table *table = term_table_create(columns, sizeof columns / sizeof *columns -
                                                     !json_object_get(entry, "baseline"));
  if (all || shown > count) shown = count;
  for (size_t i = 0; gates && i < shown; i++) add_row(table, &gates[i]);
  if (shown > 0) term_table_print(table, stream);
  term_table_free(table);
  free(gates);
}

static void print_scenario(const json_t *entry, bool explained, bool all, FILE *stream) {
  size_t gates = report_count(entry, "gates");
  fputc('\n', stream);
  print_coloured(stream, entry, report_text(entry, "verdict"));
  fprintf(stream, "  %s: %s (%zu gate%s)\n", report_text(entry, "name"),
          report_text(entry, "title"), gates, gates == 1 ? "" : "s");
  if (!report_passed(entry) && !explained) print_cause(entry, stream);
  print_gates(entry, all, stream);
}

void report_print(const json_t *document, bool all, FILE *stream) {
  size_t i;
  const json_t *entry, *failing = report_first_failing(document);
  print_verdict(document, stream);
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    print_scenario(entry, entry == failing, all, stream);
  }
  if (!all)
    fprintf(stream,
            "\nShown: the %d gates closest to their limits of each scenario (--all: every one); "
            "margin: limit over value.\n",
            SHOWN_GATES);
}
