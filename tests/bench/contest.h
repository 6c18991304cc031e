// SPDX-License-Identifier: Apache-2.0
// Timing by contest: two pieces of work in turn, many rounds, the ratio of their medians. What
// else the machine does hits both alike. What counts is the processor's time of the thread that
// works, so that waiting for a core does not; work in several threads is timed by the clock.
#ifndef BICYCLE_BENCH_CONTEST_H
#define BICYCLE_BENCH_CONTEST_H

#include "notes.h"

// Does the work `repeats` times.
typedef void bench_work(void *context, long repeats);

// Does it, and says how long that took: for work in another process. NaN: it failed.
typedef double bench_timed_work(void *context, long repeats);

typedef struct bench_runner {
  const char *name;
  bench_work *work;        // one of these two
  bench_timed_work *timed; //
  void *context;
  bool threads; // it runs in several
  double units; // that one piece of work treats, as lanes or matrices; 0: 1. Times are for one unit
} bench_runner;

typedef enum bench_sense {
  BENCH_AT_LEAST, // ratio = theirs / ours, the more the better
  BENCH_AT_MOST   // ratio = ours / theirs, the less the better
} bench_sense;

// Makes a contest ready: starts peers, tunes, and compares what both sides answer. False with a
// reason in the notes: it cannot be measured here.
typedef bool bench_prepare(void *context, bench_notes *notes);

// One question. Only `name`, `question` and the two sides are required.
typedef struct bench_contest {
  const char *name;     // for --only, as in "rhs-sympy": its group comes first
  const char *question; // "sympy's C / ours"
  bench_runner ours, theirs;
  bench_sense sense;
  double asked, possible; // asked of the ratio, and known to be possible; 0: nothing
  bench_prepare *prepare; // may be NULL
  void *context;          // for `prepare`
} bench_contest;

typedef enum bench_status {
  BENCH_MEASURED,
  BENCH_NOT_MEASURED, // the peer is not there
  BENCH_REFUSED       // the peer answers something else: its time would mean nothing
} bench_status;

typedef struct bench_result {
  bench_status status;
  double ours, theirs; // s        median of one unit of work
  double ratio;        //          of the medians, in the contest's sense
  double low, high;    //          quartiles of the ratio round by round
  int rounds;          //
  bench_notes notes;   //
} bench_result;

// How long to take for a contest.
typedef struct bench_effort {
  double round;                   // s  a piece of work is repeated until it takes this long
  double total;                   // s  rounds go on for this long, within the limits below
  int fewest_rounds, most_rounds; //
} bench_effort;

enum { BENCH_MOST_ROUNDS = 301 };
bench_effort bench_usual_effort(void);
bench_effort bench_quick_effort(void); // enough to see that everything works, no more

void bench_run(bench_result *out, const bench_contest *contest, const bench_effort *effort);

// Whether the ratio is what was asked; true where nothing was.
bool bench_met(const bench_contest *contest, const bench_result *result);

// Whether half the rounds differ by more than 10 % from each other: the second digit means little.
bool bench_noisy(const bench_result *result);

#endif
