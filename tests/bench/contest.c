// SPDX-License-Identifier: Apache-2.0
#include "contest.h"

#include <stdlib.h>
#include <time.h>

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double timed(const bench_runner *runner, int repeats) {
  double begin = now();
  runner->work(runner->context, repeats);
  return (now() - begin) / repeats;
}

static int rising(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

// The share-th of the sorted values.
static double quantile(double values[BENCH_ROUNDS], double share) {
  qsort(values, BENCH_ROUNDS, sizeof values[0], rising);
  return values[(int)(share * (BENCH_ROUNDS - 1) + 0.5)];
}

bench_result bench_run(const bench_contest *contest) {
  double ours[BENCH_ROUNDS], theirs[BENCH_ROUNDS], ratio[BENCH_ROUNDS];
  timed(&contest->ours, contest->repeats); // warm caches and branch predictors
  timed(&contest->theirs, contest->repeats);
  for (int i = 0; i < BENCH_ROUNDS; i++) {
    ours[i] = timed(&contest->ours, contest->repeats);
    theirs[i] = timed(&contest->theirs, contest->repeats);
    ratio[i] = ours[i] / theirs[i];
  }
  bench_result r = {.ours = quantile(ours, 0.5), .theirs = quantile(theirs, 0.5)};
  r.ratio = r.ours / r.theirs;
  r.low = quantile(ratio, 0.25);
  r.high = quantile(ratio, 0.75);
  return r;
}
