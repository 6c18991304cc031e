// SPDX-License-Identifier: Apache-2.0
// The scenarios of one run: all read before the first is played, so that a mistake in the last one
// does not cost the work on the others.
#ifndef VALIDATE_SUITE_H
#define VALIDATE_SUITE_H

#include "comparison.h"

typedef struct suite {
  scenario *scenarios;
  comparison *comparisons;
  size_t count;
} suite;

// Reads scenarios given by path or by the name of a shipped one; all shipped ones for a count of 0.
// TERM_USAGE with one line; the suite is then empty.
term_exit suite_load(suite *out, char *const *given, int given_count, problem *p);

// Plays all of them on up to `jobs` threads, with progress on stderr. What comes out does not
// depend on their number but for timings. The problem is that of the first scenario in order that
// has one.
term_exit suite_play(suite *s, int jobs, problem *p);

void suite_clear(suite *s);

#endif
