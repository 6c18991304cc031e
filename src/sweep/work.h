// SPDX-License-Identifier: Apache-2.0
// Computing points with threads, wherever they are handed out.
#ifndef SWEEP_WORK_H
#define SWEEP_WORK_H

#include "job.h"

// Where workers get points and leave what they found. Called by one thread at a time.
typedef struct sweep_desk {
  bool (*next)(sweep_range *out, double rate, void *user); // false: there are no more
  void (*deliver)(const sweep_batch *batch, void *user);   //
  void *user;                                              //
} sweep_desk;

// The desk of a job in this process.
sweep_desk sweep_own_desk(sweep_job *job);

// Computes until the desk has no more points, or a signal asks to stop. False when memory is short.
bool sweep_work(const sweep_spec *spec, sweep_evaluate_function *evaluate, const sweep_desk *desk,
                int threads);

#endif
