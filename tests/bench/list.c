// SPDX-License-Identifier: Apache-2.0
#include "list.h"

#include "terminal/message.h"

#include <stdlib.h>

void bench_add(bench_list *list, const bench_contest *contest) {
  if (list->count == BENCH_MAX_CONTESTS) abort(); // a mistake in the bench
  list->contests[list->count++] = *contest;
}

void bench_add_all(bench_list *list, const bench_contest *contests, size_t count, void *context) {
  for (size_t i = 0; i < count; i++) {
    bench_contest contest = contests[i];
    contest.context = context;
    bench_add(list, &contest);
  }
}

void *bench_new(bench_list *list, size_t size, void (*end)(void *)) {
  void *context = calloc(1, size);
  if (!context || list->owned_count == BENCH_MAX_CONTESTS) {
    term_message("out of memory");
    exit(TERM_INVALID);
  }
  list->owned[list->owned_count++] = (bench_owned){context, end};
  return context;
}

bool bench_list_open(bench_list *out, bench_subject *subject) {
  static bench_group *const GROUPS[] = BENCH_GROUPS;
  *out = (bench_list){.subject = subject, .python = python_open()};
  if (!out->python) return !term_fail(TERM_INVALID, "out of memory");
  for (size_t i = 0; i < sizeof GROUPS / sizeof GROUPS[0]; i++)
    if (!GROUPS[i](out)) return false;
  return true;
}

void bench_list_close(bench_list *list) {
  while (list->owned_count > 0) {
    bench_owned *last = &list->owned[--list->owned_count];
    if (last->end) last->end(last->context);
    free(last->context);
  }
  python_close(list->python);
}
