// SPDX-License-Identifier: Apache-2.0
#include "work.h"

#include "files/memory_stream.h"
#include "interrupt.h"

#include <stdlib.h>
#include <time.h>

static bool own_next(sweep_range *out, double rate, void *user) {
  return sweep_job_next(user, out, rate);
}

static void own_deliver(const sweep_batch *batch, void *user) {
  sweep_job_deliver(user, batch);
}

sweep_desk sweep_own_desk(sweep_job *job) {
  return (sweep_desk){own_next, own_deliver, job};
}

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

typedef struct worker {
  const sweep_spec *spec;
  sweep_evaluate_function *evaluate;
  sweep_row *rows; // SWEEP_MOST_ROWS
} worker;

// Computes a range, or its first part where a signal comes, and writes its records.
static bool write_records(sweep_batch *out, const worker *w, sweep_range range, FILE *stream) {
  out->range = (sweep_range){.first = range.first};
  while (out->range.count < range.count && (!sweep_interrupted() || out->range.count == 0)) {
    const long left = range.count - out->range.count;
    const long count = left < SWEEP_MOST_ROWS ? left : SWEEP_MOST_ROWS;
    if (!w->evaluate(w->rows, w->spec, range.first + out->range.count, count)) return false;
    for (long i = 0; i < count; i++) {
      if (!sweep_print_record(stream, &w->rows[i], w->spec)) return false;
      out->failed += sweep_row_failed(&w->rows[i], w->spec);
    }
    out->range.count += count;
  }
  return true;
}

static bool compute(sweep_batch *out, const worker *w, sweep_range range) {
  *out = (sweep_batch){0};
  FILE *stream = bike_memory_stream(&out->text, &out->size);
  if (!stream) return false;
  const bool written = write_records(out, w, range, stream);
  return fclose(stream) == 0 && written;
}

static bool work_alone(const sweep_spec *spec, sweep_evaluate_function *evaluate,
                       const sweep_desk *desk) {
  worker w = {spec, evaluate, calloc(SWEEP_MOST_ROWS, sizeof *w.rows)};
  double rate = 0; // points a second
  bool going = w.rows != NULL, kept = going;
  while (going) {
    sweep_range range;
    sweep_batch batch;
#pragma omp critical(desk)
    going = desk->next(&range, rate, desk->user);
    if (!going) break;
    const double begun = now();
    going = kept = compute(&batch, &w, range);
    rate = (double)batch.range.count / (now() - begun + 1e-9);
    if (kept) {
#pragma omp critical(desk)
      desk->deliver(&batch, desk->user);
    }
    free(batch.text);
  }
  free(w.rows);
  return kept;
}

bool sweep_work(const sweep_spec *spec, sweep_evaluate_function *evaluate, const sweep_desk *desk,
                int threads) {
  bool kept = true;
#pragma omp parallel num_threads(threads) reduction(&& : kept)
  kept = work_alone(spec, evaluate, desk) && kept;
  return kept;
}
