// SPDX-License-Identifier: Apache-2.0
// A sweep being run: the list of points, the log, and what is told of both. One process owns it.
#ifndef SWEEP_JOB_H
#define SWEEP_JOB_H

#include "log.h"
#include "tasks.h"
#include "terminal/progress.h"

// Finished points: neighbours, as records of the log.
typedef struct sweep_batch {
  sweep_range range;
  long failed; // of them: without all their outputs
  char *text;  //
  size_t size; //
} sweep_batch;

typedef struct sweep_job {
  const sweep_spec *spec;
  sweep_log log;
  sweep_tasks tasks;
  term_progress progress;
  int workers;  // who share the points
  long resumed; // points of this shard that were in the log
  long damaged; // lines of the log that are passed over
  long done;    // points of this shard, those resumed included
  long failed;  // of them
  bool broken;  // the log cannot be written; `error` says why
  bike_file_error error;
} sweep_job;

// Opens or resumes the log and finds out what is left. BIKE_ERROR_... with one line in job->error;
// the job is safe to end always.
int sweep_job_begin(sweep_job *out, const sweep_spec *spec, const char *log_path, sweep_shard shard,
                    bool fresh);
void sweep_job_end(sweep_job *job);

// The next points for a worker who computes `rate` points a second (0: not known yet). False where
// none is left, or the sweep is being stopped.
bool sweep_job_next(sweep_job *job, sweep_range *out, double rate);

// Keeps finished points.
void sweep_job_deliver(sweep_job *job, const sweep_batch *batch);

#endif
