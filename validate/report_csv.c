// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <string.h>

static bool is_contact(const trace_signal *signal) {
  return strstr(signal->name, "_slip") || strstr(signal->name, "_height");
}

// What an engine does not know has no column.
static bool has_column(const trace *t, const trace_signal *signal) {
  return trace_has(t, signal) && (t->has_contacts || !is_contact(signal));
}

void report_trace_csv(const trace *t, FILE *stream) {
  fputs("time", stream);
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    if (has_column(t, &trace_signals[i])) fprintf(stream, ",%s", trace_signals[i].name);
  fputc('\n', stream);
  for (size_t k = 0; k < t->count; k++) {
    fprintf(stream, "%.17g", t->rows[k].sample.time);
    for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
      if (has_column(t, &trace_signals[i]))
        fprintf(stream, ",%.17g", trace_value(&t->rows[k], &trace_signals[i]));
    fputc('\n', stream);
  }
}

void report_residual_csv(const comparison *c, FILE *stream) {
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  const trace_signal *shared[TRACE_SIGNAL_COUNT];
  int count = 0;
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    if (has_column(a, &trace_signals[i]) && has_column(b, &trace_signals[i]))
      shared[count++] = &trace_signals[i];
  fputs("time", stream);
  for (int i = 0; i < count; i++) fprintf(stream, ",%s", shared[i]->name);
  fputc('\n', stream);
  for (size_t k = 0; k < comparison_rows(c); k++) {
    fprintf(stream, "%.17g", a->rows[k].sample.time);
    for (int i = 0; i < count; i++)
      fprintf(stream, ",%.17g",
              trace_value(&b->rows[k], shared[i]) - trace_value(&a->rows[k], shared[i]));
    fputc('\n', stream);
  }
}
