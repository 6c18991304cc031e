// SPDX-License-Identifier: Apache-2.0
// Sweeps run as a user runs them, and their tables.
#ifndef TESTS_SWEEP_SWEEPS_H
#define TESTS_SWEEP_SWEEPS_H

#include "cli/run.h"
#include "support/near.h"

// Writes a file into the folder of the test.
void sweep_write(const char *name, const char *text);

// The whole of a file there; free it. Fails the test where there is none.
char *sweep_read(const char *name);

// Runs a command and fails the test unless it ends with `status`.
void sweep_run(int status, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Fails unless two files there have the same bytes.
void sweep_assert_same(const char *name, const char *other);

// A number of the report of `bicycle sweep merge`.
long sweep_merged_count(const char *logs, const char *key);

// A sweep of 60 rides, some of which fail, with draws: 0.3 s optimised on one processor.
extern const char SWEEP_RIDES[];

#endif
