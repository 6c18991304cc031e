// SPDX-License-Identifier: Apache-2.0
#include "report_series.h"

#include "terminal/message.h"

#include <math.h>
#include <stdlib.h>

static report_series of_size(size_t count) {
  report_series s = {calloc(count + 1, sizeof *s.value), count};
  if (!s.value) {
    term_lose();
    s.count = 0;
  }
  return s;
}

report_series report_series_of(const comparison *c, int side, const trace_signal *signal) {
  const trace *t = &c->side[side].trace;
  report_series s = of_size(t->count);
  for (size_t k = 0; k < s.count; k++) s.value[k] = trace_value(&t->rows[k], signal);
  return s;
}

report_series report_series_either(const comparison *c, const trace_signal *signal,
                                   size_t ends[2]) {
  for (int i = 0; i < 2; i++)
    ends[i] = trace_has(&c->side[i].trace, signal) ? c->side[i].trace.count : 0;
  report_series s = of_size(ends[0] > ends[1] ? ends[0] : ends[1]);
  for (size_t k = 0; k < s.count; k++)
    s.value[k] = trace_value(&c->side[k < ends[0] ? REFERENCE : CANDIDATE].trace.rows[k], signal);
  return s;
}

report_series report_series_residual(const comparison *c, const trace_signal *signal) {
  const trace_row *a = c->side[REFERENCE].trace.rows, *b = c->side[CANDIDATE].trace.rows;
  report_series s = of_size(comparison_rows(c));
  for (size_t k = 0; k < s.count; k++)
    s.value[k] = trace_value(&b[k], signal) - trace_value(&a[k], signal);
  return s;
}

report_series report_series_balance(const comparison *c, int side) {
  const trace *t = &c->side[side].trace;
  report_series s = of_size(t->count);
  for (size_t k = 0; k < s.count; k++) {
    double start = t->rows[0].sample.energy;
    s.value[k] = (t->rows[k].sample.energy - start - t->rows[k].more.work) / start;
  }
  return s;
}

report_series report_series_time(const comparison *c, int side) {
  const trace *t = &c->side[side].trace;
  report_series s = of_size(t->count);
  for (size_t k = 0; k < s.count; k++) s.value[k] = t->rows[k].sample.time;
  return s;
}

void report_series_clear(report_series *s) {
  free(s->value);
  *s = (report_series){0};
}

bool report_series_range(const report_series *s, double *low, double *high) {
  bool found = false;
  for (size_t k = 0; k < s->count; k++) {
    double v = s->value[k];
    if (!isfinite(v)) continue;
    if (!found || v < *low) *low = v;
    if (!found || v > *high) *high = v;
    found = true;
  }
  return found;
}
