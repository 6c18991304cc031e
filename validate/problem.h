// SPDX-License-Identifier: Apache-2.0
// What stops a comparison, as opposed to what makes it fail: one line and an exit code.
#ifndef VALIDATE_PROBLEM_H
#define VALIDATE_PROBLEM_H

#include "terminal/exit_code.h"

enum { PROBLEM_SIZE = 1024 };

typedef struct problem {
  char text[PROBLEM_SIZE];
} problem;

// Writes one line and returns `code`: TERM_USAGE (the input is to blame) or TERM_INVALID (the run
// means nothing). What was there before may be among the arguments. Functions of the comparator
// return TERM_DONE or what this returned.
term_exit problem_set(problem *p, term_exit code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

term_exit problem_memory(problem *p);

// A system call failed, `number` being its errno: out of memory, or TERM_USAGE.
term_exit problem_system(problem *p, const char *path, int number);

// Puts "prefix: " before the text; returns `code`.
term_exit problem_prefix(problem *p, term_exit code, const char *prefix);

#endif
