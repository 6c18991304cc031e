// SPDX-License-Identifier: Apache-2.0
// A run of a sweep, from what the command line asks to what is told at the end.
#ifndef SWEEP_RUN_H
#define SWEEP_RUN_H

#include "ranks.h"

typedef struct sweep_run {
  const char *spec_path; //
  const char *result;    // what its files are called: RESULT.log, RESULT.csv
  long threads;          // of each process; 0: as many as make sense
  sweep_shard shard;     // 1/1: the whole
  bool fresh, json;      //
} sweep_run;

// Runs it, in all ranks. A term_exit, or 128 + the number of the signal that stopped it.
int sweep_run_all(const sweep_run *run);

// What rank 0 says when all is done, and the table of a whole sweep. Same result.
int sweep_conclude(const sweep_run *run, sweep_job *job, const char *log_path, double seconds,
                   sweep_ranks ranks);

#endif
