// SPDX-License-Identifier: Apache-2.0
#include "batch/parallel.h"

#include <pthread.h>
#include <stdatomic.h>

typedef struct work {
  atomic_size_t next;
  size_t count;
  void (*body)(size_t i, void *user);
  void *user;
} work;

static void run(work *w, void (*progress)(double done, void *user), void *user) {
  for (size_t i = atomic_fetch_add(&w->next, 1); i < w->count; i = atomic_fetch_add(&w->next, 1)) {
    w->body(i, w->user);
    if (progress && i + 1 < w->count) progress((double)(i + 1) / (double)w->count, user);
  }
}

static void *help(void *user) {
  run(user, NULL, NULL);
  return NULL;
}

void parallel_run(size_t count, int threads, void (*body)(size_t i, void *user), void *user,
                  void (*progress)(double done, void *user), void *progress_user) {
  work w = {.count = count, .body = body, .user = user};
  pthread_t helpers[PARALLEL_MOST_THREADS];
  int started = 0;
  // a thread that cannot be had leaves its share to the others
  while (started < threads - 1 && started < PARALLEL_MOST_THREADS && (size_t)started + 1 < count &&
         !pthread_create(&helpers[started], NULL, help, &w))
    started++;
  run(&w, progress, progress_user);
  for (int i = 0; i < started; i++) pthread_join(helpers[i], NULL);
  if (progress) progress(1, progress_user); // when the helpers are done too
}
