// SPDX-License-Identifier: Apache-2.0
// What the pictures show: columns over time, derived from the traces of a comparison.
#ifndef VALIDATE_REPORT_SERIES_H
#define VALIDATE_REPORT_SERIES_H

#include "comparison.h"

// A column of numbers, one for each row of the side it belongs to.
typedef struct report_series {
  double *value;
  size_t count;
} report_series;

// A signal of one side; an empty series when out of memory. Free each with report_series_clear.
report_series report_series_of(const comparison *c, int side, const trace_signal *signal);

// A signal of the reference and, where that has no row or does not know it, of the candidate; as
// long as the longer ride. `ends`: up to which row each side knows it.
report_series report_series_either(const comparison *c, const trace_signal *signal, size_t ends[2]);

// Candidate minus reference, of the rows that both have.
report_series report_series_residual(const comparison *c, const trace_signal *signal);

// Energy balance (E(t) - E(0) - work) / E(0) of one side.
report_series report_series_balance(const comparison *c, int side);

// Times of a side's rows, s.
report_series report_series_time(const comparison *c, int side);

void report_series_clear(report_series *s);

// The largest and smallest finite value; false if there is none.
bool report_series_range(const report_series *s, double *low, double *high);

#endif
