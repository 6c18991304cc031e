// SPDX-License-Identifier: Apache-2.0
#include "run.h"

#include "interrupt.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/threads.h"

#include <bicycle/error.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

// "RESULT.log", or "RESULT.KofN.log" for a shard.
static bool find_log_path(char out[TERM_PATH_SIZE], const sweep_run *run) {
  const int length = run->shard.count == 1
                         ? snprintf(out, TERM_PATH_SIZE, "%s.log", run->result)
                         : snprintf(out, TERM_PATH_SIZE, "%s.%ldof%ld.log", run->result,
                                    run->shard.number, run->shard.count);
  return length < TERM_PATH_SIZE;
}

// All processors for one process; ranks are one to a processor already.
static int threads_of(const sweep_run *run, sweep_ranks ranks) {
  if (run->threads > 0) return (int)run->threads;
  return ranks.count > 1 ? 1 : term_processors();
}

// Ends where any rank fails, and says so once.
static term_exit agree(sweep_ranks ranks, int code, const bike_file_error *error) {
  bool speaks;
  const term_exit mine = term_exit_of(code), worst = sweep_ranks_agree(ranks, mine, &speaks);
  if (mine != TERM_DONE && speaks) term_message("%s", error->text);
  return worst;
}

static term_exit read_spec(sweep_spec *spec, const char *path, sweep_ranks ranks) {
  bike_file_error error = {""};
  int code = sweep_spec_read(spec, path, &error);
  const term_exit status = agree(ranks, code, &error);
  if (status != TERM_DONE) return status;
  if (!sweep_ranks_same(ranks, spec->hash, sizeof spec->hash)) {
    code = BIKE_ERROR_FILE;
    snprintf(error.text, sizeof error.text, "%.900s: rank %d reads another text than rank 0", path,
             ranks.rank);
  }
  return agree(ranks, code, &error);
}

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

// The others of many ranks.
static int help(const sweep_run *run, const sweep_spec *spec, sweep_ranks ranks) {
  const sweep_desk desk = sweep_ranks_desk();
  const bike_file_error none = {""};
  const term_exit status = agree(ranks, BIKE_OK, &none);
  if (status != TERM_DONE) return status;
  const bool kept = sweep_work(spec, sweep_evaluate, &desk, threads_of(run, ranks));
  sweep_ranks_leave();
  return kept ? TERM_DONE : (int)term_fail_bike(BIKE_ERROR_MEMORY, run->spec_path);
}

// Computes what is left, alone or by handing it out.
static bool compute(sweep_job *job, int threads, sweep_ranks ranks) {
  job->workers = threads * (ranks.count > 1 ? ranks.count - 1 : 1);
  if (ranks.count > 1) {
    sweep_ranks_serve(ranks, job);
    return true;
  }
  const sweep_desk desk = sweep_own_desk(job);
  return sweep_work(job->spec, sweep_evaluate, &desk, threads);
}

static int lead(const sweep_run *run, const sweep_spec *spec, sweep_ranks ranks) {
  char log_path[TERM_PATH_SIZE] = "";
  sweep_job job = {.log.descriptor = -1};
  int code = BIKE_OK;
  if (find_log_path(log_path, run)) {
    code = sweep_job_begin(&job, spec, log_path, run->shard, run->fresh);
  } else {
    code = BIKE_ERROR_ARGUMENT;
    snprintf(job.error.text, sizeof job.error.text, "-o: the path is too long");
  }
  int status = agree(ranks, code, &job.error);
  if (status == TERM_DONE) {
    const double begun = now();
    if (job.resumed)
      term_message("%s: goes on, %ld of %ld points are done", log_path, job.resumed, job.tasks.own);
    const bool kept = compute(&job, threads_of(run, ranks), ranks);
    term_progress_clear(&job.progress);
    status = kept ? sweep_conclude(run, &job, log_path, now() - begun, ranks)
                  : (int)term_fail_bike(BIKE_ERROR_MEMORY, run->spec_path);
  }
  sweep_job_end(&job);
  return status;
}

int sweep_run_all(const sweep_run *run) {
  sweep_spec spec;
  const sweep_ranks ranks = sweep_ranks_begin();
  sweep_listen_to_signals();
  int status = read_spec(&spec, run->spec_path, ranks);
  if (status == TERM_DONE)
    status = ranks.rank == 0 ? lead(run, &spec, ranks) : help(run, &spec, ranks);
  sweep_spec_free(&spec);
  sweep_ranks_end(ranks);
  return status;
}
