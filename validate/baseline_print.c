// SPDX-License-Identifier: Apache-2.0
#include "baseline.h"

#include "report_markup.h"
#include "report_read.h"
#include "terminal/table.h"

#include <math.h>
#include <string.h>

static void add_rows(term_table *table, const json_t *document, const char *change,
                     term_style style) {
  size_t i;
  const json_t *entry;
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    for (size_t k = 0; k < report_count(entry, "gates"); k++) {
      report_gate g = report_gate_at(entry, k);
      char before[REPORT_NUMBER], now[REPORT_NUMBER], floor[REPORT_NUMBER];
      const json_t *gate = json_array_get(json_object_get(entry, "gates"), k);
      const json_t *block = json_object_get(gate, "baseline");
      if (strcmp(g.change, change) != 0) continue;
      term_table_add(table, style,
                     (const char *const[]){change, report_text(entry, "name"), g.layer, g.signal,
                                           g.metric_words, report_number(before, g.before),
                                           report_quantity(now, g.value, g.unit),
                                           report_number(floor, report_real(block, "floor")),
                                           report_text(block, "floor_source")});
    }
  }
}

static void print_gone(const json_t *document, FILE *stream) {
  size_t i, k;
  const json_t *entry, *name, *block = json_object_get(document, "baseline");
  json_array_foreach(json_object_get(block, "missing"), i, name) {
    fprintf(stream, "missing scenario: %s\n", json_string_value(name));
  }
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    json_array_foreach(json_object_get(json_object_get(entry, "baseline"), "gone"), k, name) {
      fprintf(stream, "no longer measured: %s %s\n", report_text(entry, "name"),
              json_string_value(name));
    }
  }
}

static void print_counts(const json_t *block, bool worse, FILE *stream) {
  term_style style = worse ? TERM_BAD : TERM_GOOD;
  const char *word = worse                              ? "WORSE than"
                     : report_real(block, "better") > 0 ? "BETTER than"
                                                        : "SAME as";
  fprintf(stream, "%s%s%s the baseline of %s: %.0f better, %.0f same, %.0f worse",
          term_style_begin(stream, style), word, term_style_end(stream, style),
          report_text(block, "created"), report_real(block, "better"), report_real(block, "same"),
          report_real(block, "worse"));
  if (report_real(block, "new") > 0) fprintf(stream, ", %.0f new", report_real(block, "new"));
  if (report_real(block, "gone") > 0)
    fprintf(stream, ", %.0f no longer measured", report_real(block, "gone"));
  size_t missing = report_count(block, "missing");
  if (missing > 0) fprintf(stream, ", %zu scenario%s missing", missing, missing == 1 ? "" : "s");
  fputc('\n', stream);
}

void baseline_print(const json_t *document, FILE *stream) {
  static const term_column columns[] = {
      {"", TERM_LEFT},       {"scenario", TERM_LEFT}, {"layer", TERM_LEFT},
      {"signal", TERM_LEFT}, {"metric", TERM_LEFT},   {"before", TERM_RIGHT},
      {"now", TERM_RIGHT},   {"noise", TERM_RIGHT},   {"from", TERM_LEFT}};
  const json_t *block = json_object_get(document, "baseline");
  if (json_object_get(document, "baseline_problem"))
    fprintf(stream, "%sNOT COMPARED%s with the baseline: %s\n", term_style_begin(stream, TERM_BAD),
            term_style_end(stream, TERM_BAD), report_text(document, "baseline_problem"));
  if (!block) return;
  print_counts(block, baseline_is_worse(document), stream);
  print_gone(document, stream);
  if (report_real(block, "worse") + report_real(block, "better") + report_real(block, "new") == 0)
    return;
  term_table *table = term_table_create(columns, sizeof columns / sizeof *columns);
  add_rows(table, document, "worse", TERM_BAD);
  add_rows(table, document, "better", TERM_GOOD);
  add_rows(table, document, "new", TERM_PLAIN);
  term_table_print(table, stream);
  term_table_free(table);
}
