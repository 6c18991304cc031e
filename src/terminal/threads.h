// SPDX-License-Identifier: Apache-2.0
// How many threads a command uses.
#ifndef BICYCLE_TERMINAL_THREADS_H
#define BICYCLE_TERMINAL_THREADS_H

enum { TERM_MOST_THREADS = 256 };

// The processors that this process may run on.
int term_processors(void);

// The argument of an option such as --threads: 1 to TERM_MOST_THREADS; ends the program otherwise.
int term_threads_of(const char *option, const char *text);

#endif
