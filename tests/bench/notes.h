// SPDX-License-Identifier: Apache-2.0
// What there is to say of a contest beside its times: counts, tolerances, how well both sides
// agree.
#ifndef BICYCLE_BENCH_NOTES_H
#define BICYCLE_BENCH_NOTES_H

#include <stdbool.h>

typedef struct bench_note {
  const char *name; // static text, as in "evaluations"
  double value;     //
  double limit;     // of a check: the value must not exceed it; NaN: nothing is checked
} bench_note;

enum { BENCH_MAX_NOTES = 8, BENCH_REASON_SIZE = 256 };

// Zero-initialised means none.
typedef struct bench_notes {
  bench_note list[BENCH_MAX_NOTES];
  int count;
  char reason[BENCH_REASON_SIZE]; // why there is no measurement; empty where there is one
} bench_notes;

// Adds a number; those beyond BENCH_MAX_NOTES would be a mistake in the bench and end it.
void bench_note_value(bench_notes *notes, const char *name, double value);

// Adds a number that must not exceed a limit (NaN does).
void bench_note_check(bench_notes *notes, const char *name, double value, double limit);

// Gives the reason, and returns false: `return bench_note_reason(notes, "...")`.
bool bench_note_reason(bench_notes *notes, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// The first check that fails; NULL where all hold.
const bench_note *bench_broken_check(const bench_notes *notes);

#endif
