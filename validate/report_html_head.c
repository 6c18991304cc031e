// SPDX-License-Identifier: Apache-2.0
// The first screen of report.html: the verdict, and all scenarios at a glance.
#include "report_html.h"

#include "layer.h"
#include "report_markup.h"
#include "report_read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The gate that uses up most of its limit in all scenarios, and where; layer NULL if there is none.
static report_gate closest_gate(const json_t *document, const json_t **where) {
  report_gate closest = {0};
  size_t i;
  const json_t *entry;
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    for (size_t k = 0; k < report_count(entry, "gates"); k++) {
      report_gate g = report_gate_at(entry, k);
      if (closest.layer && !(report_gate_use(&g) > report_gate_use(&closest))) continue;
      closest = g;
      *where = entry;
    }
  }
  return closest;
}

static void print_closest(FILE *stream, const json_t *document) {
  const json_t *entry = NULL;
  char value[REPORT_NUMBER], limit[REPORT_NUMBER], margin[REPORT_NUMBER];
  report_gate g = closest_gate(document, &entry);
  if (!g.layer) return;
  report_markup(
      stream,
      "<p>Closest to its limit: <a href='#%u'>%s</a>, %s %s %s: %s of %s (margin %s).</p>\n",
      report_text(entry, "name"), report_text(entry, "name"), g.layer, g.signal, g.metric_words,
      report_number(value, g.value), report_quantity(limit, g.limit, g.unit),
      report_margin(margin, report_gate_use(&g)));
}

static void print_failure(FILE *stream, const json_t *document) {
  const json_t *entry = report_first_failing(document);
  const layer *l = layer_find(report_text(document, "first_failure"));
  const char *name = entry ? report_text(entry, "name") : "";
  report_markup(stream, "<p class=cause>First failure: <a href='#%u'>%s</a>, %s %s: %s</p>\n", name,
                name, l ? l->name : "", l ? l->title : "", report_text(document, "cause"));
}

static void print_names(FILE *stream, const char *words, const char *of, const json_t *names) {
  size_t i;
  const json_t *name;
  json_array_foreach(names, i, name) {
    report_markup(stream, "<p class=cause>%s: %s%s%s</p>\n", words, of, *of ? " " : "",
                  json_string_value(name));
  }
}

static void print_baseline(FILE *stream, const json_t *document) {
  size_t i;
  const json_t *entry, *b = json_object_get(document, "baseline");
  if (json_object_get(document, "baseline_problem"))
    report_markup(stream, "<p class=cause>Not compared with the baseline: %s</p>\n",
                  report_text(document, "baseline_problem"));
  if (!b) return;
  char counts[160];
  snprintf(counts, sizeof counts, "%.0f better, %.0f same, %.0f worse", report_real(b, "better"),
           report_real(b, "same"), report_real(b, "worse"));
  report_markup(stream, "<p>Against the baseline of %s: <b>%s</b>.</p>\n",
                report_text(b, "created"), counts);
  print_names(stream, "Missing scenario", "", json_object_get(b, "missing"));
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    print_names(stream, "No longer measured", report_text(entry, "name"),
                json_object_get(json_object_get(entry, "baseline"), "gone"));
  }
}

void report_html_verdict(FILE *stream, const json_t *document) {
  char counts[REPORT_COUNTS_TEXT];
  const json_t *origin = json_object_get(document, "provenance");
  const char *but = report_baseline_words(document);
  report_markup(stream, "<header class='%s'>\n<h1>%s<span>: %s%s</span></h1>\n",
                *but && report_passed(document) ? "worse" : report_text(document, "verdict"),
                report_verdict_title(document), report_describe_counts(counts, document), but);
  if (report_passed(document))
    print_closest(stream, document);
  else
    print_failure(stream, document);
  print_baseline(stream, document);
  report_markup(stream, "<p class=dim>%s &middot; %s &middot; bicycle %s</p>\n</header>\n",
                report_text(origin, "created"), report_text(origin, "command"),
                report_text(origin, "project"));
}

// The smallest margin of a layer, or its failures. That two rides end together is asked of all, and
// says nothing of what is between: it is no margin of the traces.
static void print_layer_cell(FILE *stream, const json_t *entry, const char *name) {
  size_t gates = 0, failed = 0;
  double use = 0;
  for (size_t i = 0; i < report_count(entry, "gates"); i++) {
    report_gate g = report_gate_at(entry, i);
    if (strcmp(g.layer, name) != 0 || (g.pass && strcmp(g.signal, "end_time") == 0)) continue;
    gates++;
    failed += !g.pass;
    use = fmax(use, report_gate_use(&g));
  }
  char margin[REPORT_NUMBER];
  if (gates == 0)
    fputs("<td class=dim>-", stream);
  else if (failed)
    fprintf(stream, "<td class=fail>%zu of %zu fail", failed, gates);
  else
    fprintf(stream, "<td class=%s>%s", use > 0.5 ? "near" : "ok", report_margin(margin, use));
}

static bool is_gated(const json_t *document, const char *name) {
  size_t i;
  const json_t *entry;
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    for (size_t k = 0; k < report_count(entry, "gates"); k++)
      if (strcmp(report_gate_at(entry, k).layer, name) == 0) return true;
  }
  return false;
}

static void print_row(FILE *stream, const json_t *document, const json_t *entry) {
  const json_t *a = report_engine(entry, "reference"), *b = report_engine(entry, "candidate");
  report_markup(stream, "<tr><td class='%s'>%s<td><a href='#%u'>%s</a>",
                report_text(entry, "verdict"), report_verdict_title(entry),
                report_text(entry, "name"), report_text(entry, "name"));
  for (int i = 0; layer_at(i); i++)
    if (is_gated(document, layer_at(i)->name)) print_layer_cell(stream, entry, layer_at(i)->name);
  report_markup(stream, "<td class=ride>%s<td>%s<td>%s - %s</tr>\n", report_text(entry, "title"),
                report_text(entry, "bicycle"), report_text(a, "label"), report_text(b, "label"));
}

void report_html_overview(FILE *stream, const json_t *document) {
  size_t i;
  const json_t *entry;
  fputs(
      "<section class=overview>\n<h2>Scenarios</h2>\n<div class=wide><table class=sortable><thead>"
      "<tr><th>Verdict<th>Scenario",
      stream);
  for (int k = 0; layer_at(k); k++)
    if (is_gated(document, layer_at(k)->name))
      report_markup(stream, "<th>%s %s", layer_at(k)->name, layer_at(k)->title);
  fputs("<th>Ride<th>Bicycle<th>Engines</tr></thead><tbody>\n", stream);
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    print_row(stream, document, entry);
  }
  fputs("</tbody></table></div>\n<p class=dim>Under each layer its smallest margin: how many times "
        "the value fits into its limit.</p>\n</section>\n",
        stream);
}
