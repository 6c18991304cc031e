// SPDX-License-Identifier: Apache-2.0
// Rides of any model: steps, their checks, lift-offs and samples.
#include "runner_any_internal.h"
#include "runner_guard.h"

#include <math.h>
#include <stdlib.h>

// A ride under way.
typedef struct journey {
  runner_any *r;
  const runner_any_def *def;
  runner_any_result *out;
  mjcf_error *error;
  double step;  // s
  double *load; // N   normal force of each disc at the moment before
} journey;

runner_status runner_any_check(const runner_any *r, const runner_any_def *def, mjcf_error *error) {
  bool right = def->on_sample &&
               runner_check_times(def->duration, def->sample, r->model->opt.timestep, error);
  if (!def->on_sample) mjcf_fail(error, "a ride needs on_sample");
  return right ? RUNNER_OK : RUNNER_ARGUMENT;
}

static void tell(const journey *j, const char *note) {
  if (*note && j->def->on_note) j->def->on_note(note, j->def->user);
}

static runner_status measure(const journey *j) {
  char note[RUNNER_NOTE_SIZE];
  runner_status status = runner_any_measure(j->r, note, j->error);
  if (status == RUNNER_OK) tell(j, note);
  return status == RUNNER_OK ? runner_any_check_rolling(j->r, j->error) : status;
}

// Nonzero if the caller wants to stop.
static int emit(const journey *j, double time) {
  const runner_moment moment = {time, j->r->probe, j->r->discs, j->r->drives};
  return j->def->on_sample(&moment, j->def->user);
}

// The time of the first lift-off since the moment before, `now` being the end of the step; NAN for
// none. What lifts at the start lifts at 0.
static double find_lifts(journey *j, double now) {
  double first = NAN;
  for (int i = 0; i < j->r->disc_count; i++) {
    double before = j->load[i], after = j->load[i] = j->r->discs[i].normal_force;
    if (!(before > 0 && after <= 0)) continue;
    double time = isinf(before) ? 0 : now - j->step * after / (after - before);
    if (j->def->on_lift) j->def->on_lift(i, time, j->def->user);
    first = fmin(first, time);
  }
  return first;
}

static void step(void *argument) {
  runner_any *r = (runner_any *)argument;
  mj_step(r->model, r->ride);
}

// One mj_step from number * step on, and whether it can be trusted.
static runner_status advance(const journey *j, long number) {
  runner_any *r = j->r;
  guard_report report;
  double from = (double)number * j->step;
  r->ride->time = from; // not the sum of a million roundings
  double start = runner_seconds();
  guard_call(&report, step, r);
  j->out->wall_time += runner_seconds() - start;
  runner_status status = runner_check_any(r->model, r->ride, &report, j->error);
  if (status == RUNNER_OK) status = runner_check_time(r->ride, from, j->step, j->error);
  if (status != RUNNER_OK) return status;
  tell(j, report.warning);
  r->ride->time = (double)(number + 1) * j->step;
  j->out->steps++;
  return RUNNER_OK;
}

static runner_status ride(journey *j) {
  const runner_any_def *def = j->def;
  long steps, steps_per_sample;
  runner_divides(&steps, def->duration, j->step);
  runner_divides(&steps_per_sample, def->sample, j->step);
  runner_status status = measure(j);
  if (status != RUNNER_OK) return status;
  for (int i = 0; i < j->r->disc_count; i++) j->load[i] = INFINITY;
  if (emit(j, 0) != 0) return RUNNER_INTERRUPTED;
  if (!isnan(find_lifts(j, 0)) && def->stop_at_lift) return RUNNER_OK;
  for (long i = 1; i <= steps; i++) {
    status = advance(j, i - 1);
    if (status == RUNNER_OK) status = measure(j);
    if (status != RUNNER_OK) return status;
    double lift = find_lifts(j, (double)i * j->step);
    bool ends = !isnan(lift) && def->stop_at_lift;
    j->out->end_time = ends ? lift : (double)i * j->step;
    if (ends) return RUNNER_OK;
    if (i % steps_per_sample == 0 && emit(j, (double)(i / steps_per_sample) * def->sample) != 0)
      return RUNNER_INTERRUPTED;
  }
  j->out->complete = true;
  return RUNNER_OK;
}

runner_status runner_any_ride(runner_any_result *out, runner_any *r, const runner_any_def *def,
                              mjcf_error *error) {
  *out = (runner_any_result){0};
  runner_status status = runner_any_check(r, def, error);
  if (status != RUNNER_OK) return status;
  journey j = {.r = r, .def = def, .out = out, .error = error, .step = r->model->opt.timestep};
  j.load = (double *)calloc((size_t)r->disc_count + 1, sizeof *j.load);
  status = j.load ? ride(&j) : RUNNER_MEMORY;
  free(j.load);
  if (status == RUNNER_INTERRUPTED || status == RUNNER_MEMORY)
    mjcf_fail(error, "%s", runner_status_string(status));
  return status;
}
