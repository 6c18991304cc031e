// SPDX-License-Identifier: Apache-2.0
// A folder of files that appears whole or not at all: it is filled under another name beside its
// place and takes that when complete. Only an earlier report is ever replaced.
#ifndef VALIDATE_FOLDER_H
#define VALIDATE_FOLDER_H

#include "problem.h"
#include "terminal/hold.h"

#include <stdbool.h>
#include <stdio.h>

typedef struct folder {
  char *target;     // the folder that commit brings about
  char *aside;      // where it is filled
  sigset_t signals; // blocked before, by the caller
} folder;

// Whether a report can be written there: a folder that does not exist yet, an empty one, or an
// earlier report with nothing else in it, in a folder that can be written to. TERM_USAGE if not.
term_exit folder_check(const char *path, problem *p);

// The same, and begins to fill it. Commit or abort it in the end. Until then signals that would end
// the program wait; it has one thread.
term_exit folder_begin(folder *out, const char *path, problem *p);

// Opens a new file in it; close it with folder_close.
term_exit folder_open(FILE **out, const folder *f, const char *name, problem *p);
term_exit folder_close(FILE *stream, const char *name, problem *p);

term_exit folder_commit(folder *f, problem *p);

// Removes what was written; nothing is left. Does nothing to a folder that has ended.
void folder_abort(folder *f);

#endif
