// SPDX-License-Identifier: Apache-2.0
#include "terminal/threads.h"

#include "terminal/command.h"
#include "terminal/number.h"

#include <sched.h>

int term_processors(void) {
  cpu_set_t mine;
  if (sched_getaffinity(0, sizeof mine, &mine)) return 1;
  int count = CPU_COUNT(&mine);
  return count < TERM_MOST_THREADS ? count : TERM_MOST_THREADS;
}

int term_threads_of(const char *option, const char *text) {
  long threads;
  if (!term_parse_integer(&threads, text, 1, TERM_MOST_THREADS))
    term_usage("%s: '%s' is not a whole number from 1 to %d", option, text, TERM_MOST_THREADS);
  return (int)threads;
}
