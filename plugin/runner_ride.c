// SPDX-License-Identifier: Apache-2.0
// Riding: steps, their checks, events and samples.
#include "runner_guard.h"
#include "runner_internal.h"

#include <math.h>
#include <time.h>

runner_ride_def runner_default_ride_def(void) {
  return (runner_ride_def){
      .duration = 10, .sample = 0.01, .lean_limit = bike_default_ride_def().lean_limit};
}

// A ride under way.
typedef struct course {
  runner *r;
  const runner_ride_def *def;
  runner_ride_result *out;
  mjcf_error *error;
  double step;       // s
  runner_instant at; // the newest instant
} course;

static runner_status refuse(mjcf_error *error, const char *text) {
  mjcf_fail(error, "%s", text);
  return RUNNER_ARGUMENT;
}

// How often `part` goes into `whole`, and whether it does so without a rest: times are typed in
// decimals, so that 0.03/0.01 is 3 only to rounding.
static bool divides(long *times, double whole, double part) {
  double ratio = whole / part;
  *times = lround(fmin(ratio, 1e15));
  return ratio < 1e15 && *times >= 1 && fabs(ratio - (double)*times) <= 1e-9 * ratio;
}

runner_status runner_check_ride(const runner *r, const runner_ride_def *def, mjcf_error *error) {
  double step = r->model->opt.timestep;
  long times;
  if (!def->on_sample) return refuse(error, "a ride needs on_sample");
  if (!(def->duration > 0 && isfinite(def->duration)))
    return refuse(error, "the duration must be positive");
  if (!(def->sample > 0 && def->sample <= def->duration))
    return refuse(error, "the sample interval must be positive and at most the duration");
  if (!divides(&times, def->sample, step))
    return refuse(error, "the sample interval must be a multiple of the timestep");
  if (!divides(&times, def->duration, step))
    return refuse(error, "the duration must be a multiple of the timestep");
  if (!(def->lean_limit > 0 && def->lean_limit < mjPI / 2))
    return refuse(error, "the lean limit must lie between 0 and 90 deg");
  return RUNNER_OK;
}

static double friction_of(const double force[3]) {
  return hypot(force[0], force[1]) / force[2];
}

// Nonzero if the caller wants to stop.
static int emit(const course *c, double time) {
  const runner_instant *a = &c->at;
  runner_sample s = {.row = {.time = time,
                             .x = a->x,
                             .y = a->y,
                             .yaw = a->yaw,
                             .lean = a->lean,
                             .pitch = a->pitch,
                             .steer = a->steer,
                             .lean_rate = a->lean_rate,
                             .steer_rate = a->steer_rate,
                             .speed = a->speed,
                             .rear_angle = a->wheel_angle[RUNNER_REAR],
                             .front_angle = a->wheel_angle[RUNNER_FRONT],
                             .energy = a->kinetic + a->potential,
                             .rear_normal = a->force[RUNNER_REAR][2],
                             .front_normal = a->force[RUNNER_FRONT][2],
                             .rear_friction = friction_of(a->force[RUNNER_REAR]),
                             .front_friction = friction_of(a->force[RUNNER_FRONT])},
                     .more = {.work = c->r->work}};
  mju_copy3(s.more.rear_force, a->force[RUNNER_REAR]);
  mju_copy3(s.more.front_force, a->force[RUNNER_FRONT]);
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    s.slip[i] = a->slip[i];
    s.height[i] = a->height[i];
    s.height_rate[i] = a->height_rate[i];
  }
  return c->def->on_sample(&s, c->def->user);
}

//---------------------------------- events --------------------------------------------------------

// Time at which a quantity that falls through zero within the last step did so, or NAN.
static double fall_time(const course *c, double end, double before, double after) {
  if (!(before > 0 && after <= 0)) return NAN;
  return end - c->step * after / (after - before);
}

// Time of an event that did not happen: NAN. What comes after the end is not noted.
static void note(const course *c, bike_event_kind kind, double time, double end) {
  if (isnan(time) || time > end) return;
  if (c->out->event_count < BIKE_MAX_EVENTS)
    c->out->events[c->out->event_count] = (bike_event){kind, time};
  c->out->event_count++;
}

// Notes what happened between two instants; the time of what ends the ride, or NAN.
static double find_events(const course *c, double now, const runner_instant *before) {
  const runner_instant *after = &c->at;
  double limit = c->def->lean_limit, lift[RUNNER_WHEELS];
  for (int i = 0; i < RUNNER_WHEELS; i++)
    lift[i] = fall_time(c, now, before->force[i][2], after->force[i][2]);
  double fallen = fall_time(c, now, limit - fabs(before->lean), limit - fabs(after->lean));
  // Standing still is for whoever moved: forwards or backwards.
  double sense = before->speed < 0 ? -1 : 1;
  double stopped = fall_time(c, now, sense * before->speed, sense * after->speed);
  // fmin takes the number where the other one is NAN.
  double end = fmin(fallen, stopped);
  if (c->def->stop_at_lift) end = fmin(end, fmin(lift[RUNNER_REAR], lift[RUNNER_FRONT]));
  note(c, BIKE_EVENT_REAR_LIFT, lift[RUNNER_REAR], end);
  note(c, BIKE_EVENT_FRONT_LIFT, lift[RUNNER_FRONT], end);
  note(c, BIKE_EVENT_LEAN_LIMIT, fallen, end);
  note(c, BIKE_EVENT_STANDSTILL, stopped, end);
  return end;
}

//---------------------------------- steps ---------------------------------------------------------

static void step(void *argument) {
  runner *r = (runner *)argument;
  mj_step(r->model, r->ride);
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// One mj_step from number * step on, and whether it can be trusted.
static runner_status advance(course *c, long number) {
  runner *r = c->r;
  guard_report report;
  double from = (double)number * c->step;
  r->ride->time = from; // not the sum of a million roundings
  r->stages = 0;
  r->refused = RUNNER_OK;
  runner *before = runner_activate(r);
  double start = seconds();
  guard_call(&report, step, r);
  c->out->wall_time += seconds() - start;
  runner_activate(before);
  int stages = r->model->opt.integrator == mjINT_RK4 ? 4 : 1;
  runner_status status = runner_check(r, r->ride, &report, stages, c->error);
  if (status != RUNNER_OK) return status;
  // A reset puts the time back to zero; rounding is a millionth of this.
  if (!(fabs(r->ride->time - from - c->step) <= 1e-6 * c->step)) {
    mjcf_fail(c->error, "%s (from %.6g s)", runner_status_string(RUNNER_INVALID_TIME), from);
    return RUNNER_INVALID_TIME;
  }
  r->ride->time = (double)(number + 1) * c->step;
  c->out->steps++;
  return RUNNER_OK;
}

static runner_status ride(course *c) {
  long steps, steps_per_sample;
  divides(&steps, c->def->duration, c->step);
  divides(&steps_per_sample, c->def->sample, c->step);
  runner_status status = runner_measure(&c->at, c->r, c->error);
  if (status != RUNNER_OK) return status;
  if (emit(c, 0) != 0) return RUNNER_INTERRUPTED;
  for (long i = 1; i <= steps; i++) {
    const runner_instant before = c->at;
    status = advance(c, i - 1);
    if (status == RUNNER_OK) status = runner_measure(&c->at, c->r, c->error);
    if (status != RUNNER_OK) return status;
    double end = find_events(c, (double)i * c->step, &before);
    c->out->end_time = isnan(end) ? (double)i * c->step : end;
    if (!isnan(end)) return RUNNER_OK;
    if (i % steps_per_sample == 0 && emit(c, (double)(i / steps_per_sample) * c->def->sample) != 0)
      return RUNNER_INTERRUPTED;
  }
  c->out->complete = true;
  return RUNNER_OK;
}

runner_status runner_ride(runner_ride_result *out, runner *r, const runner_ride_def *def,
                          mjcf_error *error) {
  *out = (runner_ride_result){0};
  course c = {.r = r, .def = def, .out = out, .error = error, .step = r->model->opt.timestep};
  runner_status status = runner_check_ride(r, def, error);
  if (status != RUNNER_OK) return status;
  r->input = def->input;
  r->user = def->user;
  r->work = 0;
  r->ride->time = 0;
  status = ride(&c);
  r->input = NULL;
  r->user = NULL;
  if (status == RUNNER_INTERRUPTED) mjcf_fail(error, "%s", runner_status_string(status));
  return status;
}
