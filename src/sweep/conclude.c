// SPDX-License-Identifier: Apache-2.0
// The end of a run: what came of it, and the table of a whole sweep.
#include "run.h"

#include "interrupt.h"
#include "merge.h"
#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"

#include <bicycle/error.h>
#include <stdio.h>

enum { SIGNAL_BASE = 128 }; // of exit codes, as shells have it

// Writes the table; NULL in `csv` where that is another's affair.
static term_exit write_table(const sweep_run *run, const char *log_path, char csv[TERM_PATH_SIZE]) {
  sweep_merged merged;
  bike_file_error error;
  if (snprintf(csv, TERM_PATH_SIZE, "%s.csv", run->result) >= TERM_PATH_SIZE)
    return term_fail(TERM_USAGE, "-o: the path is too long");
  const int code = sweep_merge(&merged, &log_path, 1, csv, false, &error);
  if (code) return term_fail(term_exit_of(code), "%s", error.text);
  return TERM_DONE;
}

static bool print_json(const sweep_run *run, const sweep_job *job, const char *log_path,
                       const char *csv, double seconds, sweep_ranks ranks) {
  return term_json_write(
      json_pack("{s:o, s:s, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:i, s:o, s:o, s:o, s:b}",
                "spec", term_json_text(run->spec_path), "bicycle", job->spec->file.bicycle.name,
                "sha256", job->spec->hash, "points", (json_int_t)job->spec->points, "shard",
                (json_int_t)run->shard.number, "shards", (json_int_t)run->shard.count,
                "shard_points", (json_int_t)job->tasks.own, "done", (json_int_t)job->done,
                "resumed", (json_int_t)job->resumed, "failed", (json_int_t)job->failed, "ranks",
                ranks.count, "seconds", term_json_number(seconds), "log", term_json_text(log_path),
                "csv", csv ? term_json_text(csv) : json_null(), "interrupted",
                sweep_interrupted() != 0),
      stdout);
}

static void say(const sweep_run *run, const sweep_job *job, const char *log_path, const char *csv) {
  if (job->damaged) term_message("%s: %ld damaged lines were passed over", log_path, job->damaged);
  if (job->failed)
    term_message("%ld of %ld points lack outputs: column 'error' says why", job->failed, job->done);
  if (job->done < job->tasks.own)
    term_message("stopped with %ld of %ld points done; the same command goes on from there",
                 job->done, job->tasks.own);
  else if (!csv)
    term_message("shard %ld of %ld is done; when all are: bicycle sweep merge %s.*of%ld.log -o "
                 "%s.csv",
                 run->shard.number, run->shard.count, run->result, run->shard.count, run->result);
}

int sweep_conclude(const sweep_run *run, sweep_job *job, const char *log_path, double seconds,
                   sweep_ranks ranks) {
  char path[TERM_PATH_SIZE];
  const char *csv = NULL;
  if (job->broken) return term_fail(TERM_USAGE, "%s", job->error.text);
  const bool all = job->done == job->tasks.own;
  if (all && run->shard.count == 1) {
    const term_exit status = write_table(run, log_path, path);
    if (status != TERM_DONE) return status;
    csv = path;
  }
  say(run, job, log_path, csv);
  if (run->json && !print_json(run, job, log_path, csv, seconds, ranks))
    return term_fail_bike(BIKE_ERROR_MEMORY, "--json");
  if (!run->json)
    printf("%s: %ld points, %ld with errors\n", csv ? csv : log_path, job->done, job->failed);
  if (!all) return sweep_interrupted() ? SIGNAL_BASE + sweep_interrupted() : TERM_INVALID;
  return job->done > 0 && job->failed == job->done ? TERM_INVALID : TERM_DONE;
}
