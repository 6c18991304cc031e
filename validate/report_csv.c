// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include "files/csv.h"

// What an engine does not know has no column.
static bool has_column(const trace *t, const trace_signal *signal) {
  return trace_has(t, signal) && (t->has_contacts || !trace_is_contact(signal));
}

// The columns that all of some rides have, after the time.
typedef struct columns {
  const trace_signal *signal[TRACE_SIGNAL_COUNT];
  int count;
} columns;

static columns shared_columns(const trace *a, const trace *b) {
  columns shared = {.count = 0};
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    if (has_column(a, &trace_signals[i]) && has_column(b, &trace_signals[i]))
      shared.signal[shared.count++] = &trace_signals[i];
  return shared;
}

static void write_header(FILE *stream, const columns *c) {
  const char *names[1 + TRACE_SIGNAL_COUNT] = {"time"};
  for (int i = 0; i < c->count; i++) names[1 + i] = c->signal[i]->name;
  bike_csv_write_names(stream, names, 1 + c->count);
}

void report_trace_csv(const trace *t, FILE *stream) {
  const columns own = shared_columns(t, t);
  write_header(stream, &own);
  for (size_t k = 0; k < t->count; k++) {
    double row[1 + TRACE_SIGNAL_COUNT] = {t->rows[k].sample.time};
    for (int i = 0; i < own.count; i++) row[1 + i] = trace_value(&t->rows[k], own.signal[i]);
    bike_csv_write_row(stream, row, 1 + own.count);
  }
}

void report_residual_csv(const comparison *c, FILE *stream) {
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  const columns shared = shared_columns(a, b);
  write_header(stream, &shared);
  for (size_t k = 0; k < comparison_rows(c); k++) {
    double row[1 + TRACE_SIGNAL_COUNT] = {a->rows[k].sample.time};
    for (int i = 0; i < shared.count; i++)
      row[1 + i] =
          trace_value(&b->rows[k], shared.signal[i]) - trace_value(&a->rows[k], shared.signal[i]);
    bike_csv_write_row(stream, row, 1 + shared.count);
  }
}
