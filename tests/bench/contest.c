// SPDX-License-Identifier: Apache-2.0
#include "contest.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

bench_effort bench_usual_effort(void) {
  return (bench_effort){.round = 1e-3, .total = 2.5, .fewest_rounds = 5, .most_rounds = 301};
}

bench_effort bench_quick_effort(void) {
  return (bench_effort){.round = 1e-4, .total = 0.02, .fewest_rounds = 3, .most_rounds = 11};
}

static double now(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// Seconds for all repeats.
static double spent(const bench_runner *runner, long repeats) {
  if (runner->timed) return runner->timed(runner->context, repeats);
  clockid_t clock = runner->threads ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID;
  double begin = now(clock);
  runner->work(runner->context, repeats);
  return now(clock) - begin;
}

// Seconds for one unit.
static double timed(const bench_runner *runner, long repeats) {
  double units = runner->units > 0 ? runner->units : 1;
  return spent(runner, repeats) / ((double)repeats * units);
}

// How often the work fits into a round. Warms caches and branch predictors on the way.
static long repeats_for(const bench_runner *runner, double round) {
  enum { MOST = 1L << 30 };
  long repeats = 1;
  for (;;) {
    double took = spent(runner, repeats);
    if (!(took < round) || repeats >= MOST) return repeats; // NaN too
    // not too far at once: the first calls are slow
    double more = took > 0 ? fmin(4, round / took) : 4;
    repeats = (long)ceil((double)repeats * fmax(more, 1.1));
  }
}

static int rising(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

// The share-th of the values, which are sorted.
static double quantile(double *values, int count, double share) {
  qsort(values, (size_t)count, sizeof values[0], rising);
  return values[(int)(share * (count - 1) + 0.5)];
}

static double ratio_of(const bench_contest *contest, double ours, double theirs) {
  return contest->sense == BENCH_AT_LEAST ? theirs / ours : ours / theirs;
}

static bool compete(bench_result *r, const bench_contest *c, const bench_effort *effort) {
  static double ours[BENCH_MOST_ROUNDS], theirs[BENCH_MOST_ROUNDS], ratio[BENCH_MOST_ROUNDS];
  long our_repeats = repeats_for(&c->ours, effort->round);
  long their_repeats = repeats_for(&c->theirs, effort->round);
  double begin = now(CLOCK_MONOTONIC);
  int n = 0;
  while (n < effort->fewest_rounds ||
         (n < effort->most_rounds && now(CLOCK_MONOTONIC) - begin < effort->total)) {
    ours[n] = timed(&c->ours, our_repeats);
    theirs[n] = timed(&c->theirs, their_repeats);
    ratio[n] = ratio_of(c, ours[n], theirs[n]);
    if (!isfinite(ratio[n]))
      return bench_note_reason(&r->notes, "a side failed while it was timed");
    n++;
  }
  r->rounds = n;
  r->ours = quantile(ours, n, 0.5);
  r->theirs = quantile(theirs, n, 0.5);
  r->ratio = ratio_of(c, r->ours, r->theirs);
  r->low = quantile(ratio, n, 0.25);
  r->high = quantile(ratio, n, 0.75);
  return true;
}

void bench_run(bench_result *out, const bench_contest *c, const bench_effort *effort) {
  *out = (bench_result){.status = BENCH_NOT_MEASURED,
                        .ours = NAN,
                        .theirs = NAN,
                        .ratio = NAN,
                        .low = NAN,
                        .high = NAN};
  if (c->prepare && !c->prepare(c->context, &out->notes)) return;
  const bench_note *broken = bench_broken_check(&out->notes);
  if (broken) {
    bench_note_reason(&out->notes, "%s is %.3g, allowed %.3g", broken->name, broken->value,
                      broken->limit);
    out->status = BENCH_REFUSED;
  } else if (compete(out, c, effort)) {
    out->status = BENCH_MEASURED;
  }
}

bool bench_met(const bench_contest *contest, const bench_result *result) {
  if (contest->asked == 0) return true;
  return contest->sense == BENCH_AT_LEAST ? result->ratio >= contest->asked
                                          : result->ratio <= contest->asked;
}

bool bench_noisy(const bench_result *result) {
  return result->high - result->low > 0.1 * result->ratio;
}
