// SPDX-License-Identifier: Apache-2.0
// The same bicycle in MuJoCo.
#ifndef BICYCLE_BENCH_TWIN_H
#define BICYCLE_BENCH_TWIN_H

#include "runner.h"

typedef struct bench_twin {
  runner *runner;
  mjData *start; // a copy of the state to go back to
} bench_twin;

// Places the bicycle at a state. False with one line on stderr; close it in any case.
bool bench_twin_open(bench_twin *out, const bike_bicycle *bicycle, const bike_state *state);
void bench_twin_close(bench_twin *twin);

// Neither contacts nor sensors, which rolling does not need; gives the flags to go back to.
int bench_twin_bare(const bench_twin *twin);
void bench_twin_restore(const bench_twin *twin, int flags);

#endif
