// SPDX-License-Identifier: Apache-2.0
// Independent pieces of work over threads.
#ifndef BICYCLE_BATCH_PARALLEL_H
#define BICYCLE_BATCH_PARALLEL_H

#include <stddef.h>

enum { PARALLEL_MOST_THREADS = 256 };

// Calls body(i, user) for i = 0 .. count - 1, each once, in no order. `progress` may be NULL; it is
// called by the calling thread alone, with the share that has been begun; with 1 when all is done.
void parallel_run(size_t count, int threads, void (*body)(size_t i, void *user), void *user,
                  void (*progress)(double done, void *user), void *progress_user);

#endif
