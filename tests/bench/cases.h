// SPDX-License-Identifier: Apache-2.0
// What is timed: one bicycle in the analytic model and in MuJoCo.
#ifndef BICYCLE_BENCH_CASES_H
#define BICYCLE_BENCH_CASES_H

#include "contest.h"
#include "terminal/exit_code.h"

#include <bicycle/state.h>

typedef struct bench_cases bench_cases;

// NULL with one line on stderr.
bench_cases *bench_cases_create(const bike_bicycle *bicycle, const bike_state *state);
void bench_cases_free(bench_cases *cases);

enum { BENCH_CONTESTS = 5 };
void bench_contests(bench_contest out[BENCH_CONTESTS], bench_cases *cases);

#endif
