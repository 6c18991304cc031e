// SPDX-License-Identifier: Apache-2.0
// Tables of gates, and why the limits have their values.
#include "report_html.h"

#include "report_markup.h"
#include "report_read.h"
#include "terminal/message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Number of a reason, from 1; 0 for none or when out of memory.
static size_t number_of(report_reasons *reasons, const char *text) {
  if (!*text) return 0;
  for (size_t i = 0; i < reasons->count; i++)
    if (strcmp(reasons->items[i], text) == 0) return i + 1;
  const char **items = realloc(reasons->items, (reasons->count + 1) * sizeof *items);
  if (!items) {
    term_lose();
    return 0;
  }
  reasons->items = items;
  items[reasons->count++] = text;
  return reasons->count;
}

static void print_change(FILE *stream, const report_gate *g) {
  char before[REPORT_NUMBER];
  report_markup(stream, "<td class='%s'>%s (was %s)", g->change, g->change,
                report_number(before, g->before));
}

// A row; times to 0.1 ms, which no sample undercuts.
static void print_gate(FILE *stream, const report_gate *g, bool baseline, size_t reason) {
  char value[REPORT_NUMBER], limit[REPORT_NUMBER], margin[REPORT_NUMBER], time[REPORT_NUMBER] = "";
  double use = report_gate_use(g);
  if (isfinite(g->time)) snprintf(time, sizeof time, "%.4f s", g->time);
  report_markup(stream, "<tr class=%s><td>%s<td class=r>%s<td>%s<td>%s<td>%s",
                g->pass ? (use > 0.5 ? "near" : "ok") : "fail", g->pass ? "holds" : "fails",
                report_margin(margin, use), g->layer, g->signal, g->metric_words);
  report_markup(stream, "<td class=r>%s<td class=r>%s<td class=r>%s",
                report_number(value, g->value), report_quantity(limit, g->limit, g->unit), time);
  if (baseline) print_change(stream, g);
  fputs("<td class=r>", stream);
  if (reason) fprintf(stream, "<a href='#/why%zu'>%zu</a>", reason, reason);
  report_markup(stream, "<td class=dim>%s</tr>\n", g->detail);
}

bool report_html_gates(FILE *stream, const json_t *entry, report_reasons *reasons) {
  size_t count;
  report_gate *gates = report_gates_by_margin(entry, &count);
  if (!gates) return false;
  bool baseline = count > 0 && *gates[0].change;
  fprintf(stream,
          "<h3>Gates</h3>\n<div class='wide tall'><table class=sortable><thead><tr><th><th>Margin"
          "<th>Layer<th>Signal<th>Metric<th>Value<th>Limit<th>At%s<th>Why<th>Seen</tr></thead>"
          "<tbody>\n",
          baseline ? "<th>Baseline" : "");
  for (size_t i = 0; i < count; i++)
    print_gate(stream, &gates[i], baseline, number_of(reasons, gates[i].reason));
  fputs("</tbody></table></div>\n", stream);
  free(gates);
  return true;
}

void report_html_reasons(FILE *stream, const report_reasons *reasons) {
  if (reasons->count == 0) return;
  fputs("<section class=reasons>\n<h2>Why the limits have their values</h2>\n<ol>\n", stream);
  for (size_t i = 0; i < reasons->count; i++) {
    fprintf(stream, "<li id=/why%zu>", i + 1);
    report_markup(stream, "%s</li>\n", reasons->items[i]);
  }
  fputs("</ol>\n</section>\n", stream);
}
