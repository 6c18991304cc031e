// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <string.h>

static bool is_contact(const trace_signal *signal) {
  return strstr(signal->name, "_slip") || strstr(signal->name, "_height");
}

static void print_header(FILE *stream, bool contacts) {
  fputs("time", stream);
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    if (contacts || !is_contact(&trace_signals[i])) fprintf(stream, ",%s", trace_signals[i].name);
  fputc('\n', stream);
}

void report_trace_csv(const trace *t, FILE *stream) {
  print_header(stream, t->has_contacts);
  for (size_t k = 0; k < t->count; k++) {
    fprintf(stream, "%.17g", t->rows[k].sample.time);
    for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
      if (t->has_contacts || !is_contact(&trace_signals[i]))
        fprintf(stream, ",%.17g", trace_value(&t->rows[k], &trace_signals[i]));
    fputc('\n', stream);
  }
}

void report_residual_csv(const comparison *c, FILE *stream) {
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  bool contacts = a->has_contacts && b->has_contacts;
  print_header(stream, contacts);
  for (size_t k = 0; k < comparison_rows(c); k++) {
    fprintf(stream, "%.17g", a->rows[k].sample.time);
    for (int i = 0; i < TRACE_SIGNAL_COUNT; i++) {
      const trace_signal *signal = &trace_signals[i];
      if (contacts || !is_contact(signal))
        fprintf(stream, ",%.17g",
                trace_value(&b->rows[k], signal) - trace_value(&a->rows[k], signal));
    }
    fputc('\n', stream);
  }
}
