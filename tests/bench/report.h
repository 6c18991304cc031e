// SPDX-License-Identifier: Apache-2.0
// The results as a table for a person and as JSON.
#ifndef BICYCLE_BENCH_REPORT_H
#define BICYCLE_BENCH_REPORT_H

#include "list.h"

#include <stddef.h>

// One contest and what came of it.
typedef struct bench_line {
  const bench_contest *contest;
  bench_result result;
} bench_line;

// Both write to stdout; false where memory is short.
bool bench_print_table(const bench_line *lines, size_t count);
bool bench_print_json(const bench_line *lines, size_t count, const bench_subject *subject);

#endif
