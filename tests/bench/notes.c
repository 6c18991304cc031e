// SPDX-License-Identifier: Apache-2.0
#include "notes.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

void bench_note_check(bench_notes *notes, const char *name, double value, double limit) {
  if (notes->count == BENCH_MAX_NOTES) abort();
  notes->list[notes->count++] = (bench_note){name, value, limit};
}

void bench_note_value(bench_notes *notes, const char *name, double value) {
  bench_note_check(notes, name, value, NAN);
}

bool bench_note_reason(bench_notes *notes, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(notes->reason, sizeof notes->reason, format, arguments);
  va_end(arguments);
  return false;
}

const bench_note *bench_broken_check(const bench_notes *notes) {
  for (int i = 0; i < notes->count; i++) {
    const bench_note *note = &notes->list[i];
    if (!isnan(note->limit) && !(note->value <= note->limit)) return note;
  }
  return NULL;
}
