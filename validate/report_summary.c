// SPDX-License-Identifier: Apache-2.0
// summary.md: the verdict for the page of a CI run, GitHub's Markdown.
#include "report_views.h"

#include "report_markup.h"
#include "report_read.h"

#include <stdlib.h>
#include <string.h>

enum { SHOWN_FAILURES = 20 }; // of each scenario; the page has all

// Text in a cell of a table: marks that Markdown would take for its own are escaped.
static void print_text(FILE *stream, const char *text) {
  for (; *text; text++) {
    if (strchr("\\`*_[]<>|#&~", *text)) fputc('\\', stream);
    fputc(*text == '\n' ? ' ' : *text, stream);
  }
}

static void print_list(FILE *stream, const char *words, const char *of, const json_t *names) {
  size_t i;
  const json_t *name;
  json_array_foreach(names, i, name) {
    fprintf(stream, "- %s: ", words);
    print_text(stream, of);
    fputs(*of ? " " : "", stream);
    print_text(stream, json_string_value(name));
    fputc('\n', stream);
  }
}

// Why there is no comparison with the baseline, or what it has and this run has not.
static void print_baseline(FILE *stream, const json_t *document) {
  size_t i;
  const json_t *entry, *block = json_object_get(document, "baseline");
  if (json_object_get(document, "baseline_problem")) {
    fputs("Not compared with the baseline: ", stream);
    print_text(stream, report_text(document, "baseline_problem"));
    fputs("\n\n", stream);
  }
  if (report_count(block, "missing") == 0 && !(report_real(block, "gone") > 0)) return;
  print_list(stream, "missing scenario", "", json_object_get(block, "missing"));
  json_array_foreach(json_object_get(document, "scenarios"), i, entry) {
    print_list(stream, "no longer measured", report_text(entry, "name"),
               json_object_get(json_object_get(entry, "baseline"), "gone"));
  }
  fputc('\n', stream);
}

static void print_verdict(FILE *stream, const json_t *document) {
  char counts[REPORT_COUNTS_TEXT];
  fprintf(stream, "## %s: %s%s\n\n", report_verdict_title(document),
          report_describe_counts(counts, document), report_baseline_words(document));
  print_baseline(stream, document);
  if (report_passed(document)) return;
  fputs("First failure: ", stream);
  print_text(stream, report_text(document, "first_failure"));
  fputs(", ", stream);
  print_text(stream, report_text(document, "cause"));
  fputs("\n\n", stream);
}

static void print_row(FILE *stream, const json_t *entry) {
  size_t count;
  char margin[REPORT_NUMBER];
  report_gate *gates = report_gates_by_margin(entry, &count);
  fprintf(stream, "| %s | ", report_text(entry, "verdict"));
  print_text(stream, report_text(entry, "name"));
  fputs(" | ", stream);
  print_text(stream, report_text(entry, "title"));
  fprintf(stream, " | %zu of %zu | ", count - report_failed_gates(entry), count);
  if (gates && count > 0) {
    fprintf(stream, "`%s %s` | %s |", gates[0].signal, gates[0].metric_words,
            report_margin(margin, report_gate_use(&gates[0])));
  } else {
    fputs("- | - |", stream);
  }
  if (json_object_get(entry, "baseline"))
    fprintf(stream, " %zu better, %zu worse |", report_changed_gates(entry, "better"),
            report_changed_gates(entry, "worse"));
  fputc('\n', stream);
  free(gates);
}

static void print_failures(FILE *stream, const json_t *entry) {
  size_t count, failed = report_failed_gates(entry);
  char value[REPORT_NUMBER], limit[REPORT_NUMBER];
  report_gate *gates = failed ? report_gates_by_margin(entry, &count) : NULL;
  if (!gates) return;
  fputs("\n**", stream);
  print_text(stream, report_text(entry, "name"));
  fputs("**: ", stream);
  print_text(stream, report_text(entry, "cause"));
  fputs("\n\n", stream);
  for (size_t i = 0; i < failed && i < SHOWN_FAILURES; i++) {
    fprintf(stream, "- `%s %s %s`: %s, limit %s\n", gates[i].layer, gates[i].signal,
            gates[i].metric_words, report_number(value, gates[i].value),
            report_quantity(limit, gates[i].limit, gates[i].unit));
  }
  if (failed > SHOWN_FAILURES) fprintf(stream, "- and %zu more\n", failed - SHOWN_FAILURES);
  free(gates);
}

bool report_summary(const report *r, const json_t *document, FILE *stream) {
  size_t i;
  const json_t *entry, *scenarios = json_object_get(document, "scenarios");
  (void)r;
  print_verdict(stream, document);
  bool compared = json_object_get(document, "baseline");
  fprintf(stream, "| verdict | scenario | ride | gates hold | closest | margin |%s\n",
          compared ? " baseline |" : "");
  fprintf(stream, "|---|---|---|---|---|---|%s\n", compared ? "---|" : "");
  json_array_foreach(scenarios, i, entry) {
    print_row(stream, entry);
  }
  json_array_foreach(scenarios, i, entry) {
    print_failures(stream, entry);
  }
  fputs("\nDetails: `report.html`; ", stream);
  print_text(stream, report_text(json_object_get(document, "provenance"), "command"));
  fputc('\n', stream);
  return true;
}
