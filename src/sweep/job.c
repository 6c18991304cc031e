// SPDX-License-Identifier: Apache-2.0
#include "job.h"

#include "files/message.h"
#include "interrupt.h"

#include <bicycle/error.h>
#include <errno.h>
#include <string.h>

static void see_record(const sweep_record *record, void *user) {
  sweep_job *job = user;
  if (!sweep_tasks_mark(&job->tasks, record->index)) return;
  job->resumed++;
  job->failed += record->failed;
}

int sweep_job_begin(sweep_job *out, const sweep_spec *spec, const char *log_path, sweep_shard shard,
                    bool fresh) {
  *out = (sweep_job){.spec = spec, .log.descriptor = -1, .workers = 1};
  if (!sweep_tasks_begin(&out->tasks, spec->points, shard))
    return bike_message(&out->error, BIKE_ERROR_MEMORY, "out of memory");
  const int code =
      sweep_log_open(&out->log, log_path, spec, fresh, see_record, out, &out->damaged, &out->error);
  out->done = out->resumed;
  return code;
}

void sweep_job_end(sweep_job *job) {
  term_progress_clear(&job->progress);
  sweep_log_close(&job->log);
  sweep_tasks_end(&job->tasks);
}

bool sweep_job_next(sweep_job *job, sweep_range *out, double rate) {
  if (job->broken || sweep_interrupted()) return false;
  return sweep_tasks_next(&job->tasks, out, sweep_tasks_share(&job->tasks, rate, job->workers));
}

void sweep_job_deliver(sweep_job *job, const sweep_batch *batch) {
  if (job->broken) return;
  if (!sweep_log_append(&job->log, batch->text, batch->size)) {
    bike_message_system(&job->error, job->log.path, errno);
    job->broken = true;
    return;
  }
  job->done += batch->range.count;
  job->failed += batch->failed;
  term_progress_show_left(&job->progress, "sweep", (double)job->done / (double)job->tasks.own);
}
