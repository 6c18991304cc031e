// SPDX-License-Identifier: Apache-2.0
// A progress bar on stderr; silent unless stderr is a terminal.
#ifndef BICYCLE_TERMINAL_PROGRESS_H
#define BICYCLE_TERMINAL_PROGRESS_H

#include <stdbool.h>

// Zero-initialised means ready. The bar is redrawn when a visible part of it changed.
typedef struct term_progress {
  bool decided, shown; // whether stderr was asked, and what it answered
  int drawn;           // percent that stands on the terminal, plus one
  double begun;        // when an estimate was first asked for, and how much was done then
  double done_before;  //
  long second;         // of the estimate that stands on the terminal
} term_progress;

// Shows `label` and how much is done, 0 <= done <= 1.
void term_progress_show(term_progress *progress, const char *label, double done);

// The same with an estimate of the time that is left: at the rate since the first call. Of a job
// that goes on where another ended, the first call may have much done already.
void term_progress_show_left(term_progress *progress, const char *label, double done);

// Wipes the bar, before any other line goes to stderr and at the end.
void term_progress_clear(term_progress *progress);

#endif
