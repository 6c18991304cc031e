// SPDX-License-Identifier: Apache-2.0
// Timing by contest: two pieces of work in turn, many rounds, the ratio of their medians. What
// else the machine does hits both alike.
#ifndef BICYCLE_BENCH_CONTEST_H
#define BICYCLE_BENCH_CONTEST_H

// Does the work `repeats` times.
typedef void bench_work(void *context, int repeats);

typedef struct bench_runner {
  const char *name;
  bench_work *work;
  void *context;
} bench_runner;

// One question: how long does `ours` take in units of `theirs`, and at most how long may it.
typedef struct bench_contest {
  const char *question;
  bench_runner ours, theirs;
  int repeats;    // of the work per round: a few milliseconds
  double at_most; // asked
} bench_contest;

typedef struct bench_result {
  double ours, theirs; // s        median of one piece of work
  double ratio;        //          of the medians
  double low, high;    //          quartiles of the ratio round by round
} bench_result;

enum { BENCH_ROUNDS = 101 };

bench_result bench_run(const bench_contest *contest);

#endif
