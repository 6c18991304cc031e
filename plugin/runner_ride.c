// SPDX-License-Identifier: Apache-2.0
// Riding: steps, their checks, events and samples.
#include "runner_guard.h"
#include "runner_internal.h"

#include <math.h>
#include <string.h>

runner_ride_def runner_default_ride_def(void) {
  bike_ride_def usual = bike_default_ride_def();
  return (runner_ride_def){.duration = 10,
                           .sample = 0.01,
                           .lean_limit = usual.lean_limit,
                           .friction_limit = usual.friction_limit};
}

// A ride under way.
typedef struct course {
  runner *r;
  const runner_ride_def *def;
  runner_ride_result *out;
  mjcf_error *error;
  double step;         // s
  runner_cvode *cvode; // NULL: mj_step
  double start_speed;  // m/s
  runner_instant at;   // the newest instant
} course;

static runner_status refuse(mjcf_error *error, const char *text) {
  mjcf_fail(error, "%s", text);
  return RUNNER_ARGUMENT;
}

runner_status runner_check_ride(const runner *r, const runner_ride_def *def, mjcf_error *error) {
  if (!def->on_sample) return refuse(error, "a ride needs on_sample");
  if (!runner_check_times(def->duration, def->sample, r->model->opt.timestep, error))
    return RUNNER_ARGUMENT;
  if (!(def->lean_limit > 0 && def->lean_limit < mjPI / 2))
    return refuse(error, "the lean limit must be above 0 and below 90 deg: lying flat, the axes of "
                         "yaw and pitch are one");
  if (!(def->friction_limit >= 0 && isfinite(def->friction_limit)))
    return refuse(error, "the friction limit must not be negative");
  // Below a few roundings no step is accurate enough.
  if (!(def->tolerance == 0 || (def->tolerance >= 1e-15 && def->tolerance < 1)))
    return refuse(error, "the tolerance must be 0, or lie between 1e-15 and 1");
  return RUNNER_OK;
}

static bike_sample row_of(const runner_instant *a, double time) {
  return (bike_sample){.time = time,
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
                       .rear_friction = bike_friction(a->force[RUNNER_REAR]),
                       .front_friction = bike_friction(a->force[RUNNER_FRONT])};
}

// Nonzero if the caller wants to stop.
static int emit(const course *c, double time) {
  const runner_instant *a = &c->at;
  runner_sample s = {.row = row_of(a, time), .more = {.work = runner_work(c->r)}};
  mju_copy3(s.more.rear_force, a->force[RUNNER_REAR]);
  mju_copy3(s.more.front_force, a->force[RUNNER_FRONT]);
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    s.slip[i] = a->slip[i];
    s.height[i] = a->height[i];
    s.height_rate[i] = a->height_rate[i];
  }
  return c->def->on_sample(&s, c->def->user);
}

//---------------------------------- the ground ----------------------------------------------------

// Holds while an indicator is not positive: g0 at `time` - step, g1 at `time`, linear between.
static void follow(bike_spells *spells, double g0, double g1, double time, double step) {
  bool on = g1 <= 0;
  bool crosses = (g0 <= 0) != on;
  bike_spells_set(spells, on, crosses ? time - step * (g1 / (g1 - g0)) : time);
}

// What the ground has to do at an instant, and had to since that of `before`, a step ago.
static void look_at_ground(const course *c, double time, const runner_instant *now, double step,
                           const runner_instant *before) {
  double limit = c->def->friction_limit;
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    bike_wheel_ground *wheel = &c->out->ground[i];
    const double *old = before->force[i], *force = now->force[i];
    bike_ground_look(wheel, time, force);
    follow(&wheel->lifted, old[2], force[2], time, step);
    follow(&wheel->no_grip, bike_grip(old, limit), bike_grip(force, limit), time, step);
  }
}

//---------------------------------- events --------------------------------------------------------

// The events are those of bicycle/ride.h but for BIKE_EVENT_VALIDITY: MuJoCo's coordinates do not
// end where those of the equations do.
enum { EVENT_KINDS = BIKE_EVENT_STANDSTILL + 1 };

// One number for each kind of event, positive until it happens.
typedef struct indicators {
  double g[EVENT_KINDS];
} indicators;

static indicators indicate(const course *c, const runner_instant *at) {
  indicators i;
  i.g[BIKE_EVENT_REAR_LIFT] = at->force[RUNNER_REAR][2];
  i.g[BIKE_EVENT_FRONT_LIFT] = at->force[RUNNER_FRONT][2];
  i.g[BIKE_EVENT_LEAN_LIMIT] = c->def->lean_limit - fabs(at->lean);
  i.g[BIKE_EVENT_VALIDITY] = 1;
  // Who starts at rest rolls to and fro while he falls: standing still is for whoever moved.
  i.g[BIKE_EVENT_STANDSTILL] = c->start_speed == 0 ? 1 : copysign(1, c->start_speed) * at->speed;
  return i;
}

static bool ends_ride(const course *c, int kind) {
  bool lift = kind == BIKE_EVENT_REAR_LIFT || kind == BIKE_EVENT_FRONT_LIFT;
  return !lift || c->def->stop_at_lift;
}

// Notes events in the order of their times, up to what ends the ride; the time of that, or NAN.
// The time of an event that did not happen is NAN.
static double note_in_order(const course *c, double time[EVENT_KINDS]) {
  for (;;) {
    int first = -1;
    for (int k = 0; k < EVENT_KINDS; k++)
      if (!isnan(time[k]) && (first < 0 || time[k] < time[first])) first = k;
    if (first < 0) return NAN;
    // What ends the ride is kept in any case: wheels that bounce can lift a hundred times before.
    bool last = ends_ride(c, first);
    int place = c->out->event_count++;
    if (last && place >= BIKE_MAX_EVENTS) place = BIKE_MAX_EVENTS - 1;
    if (place < BIKE_MAX_EVENTS)
      c->out->events[place] = (bike_event){(bike_event_kind)first, time[first]};
    if (last) return time[first];
    time[first] = NAN;
  }
}

// What already holds at the start happens at time 0.
static double find_events_at_start(const course *c) {
  const indicators now = indicate(c, &c->at);
  double time[EVENT_KINDS];
  for (int k = 0; k < EVENT_KINDS; k++) time[k] = now.g[k] > 0 ? NAN : 0;
  return note_in_order(c, time);
}

// What happened within the step that ended at `now`: where the chord meets zero.
static double find_events(const course *c, double now, const runner_instant *before) {
  const indicators a = indicate(c, before), b = indicate(c, &c->at);
  double time[EVENT_KINDS];
  for (int k = 0; k < EVENT_KINDS; k++) {
    bool happened = a.g[k] > 0 && b.g[k] <= 0;
    time[k] = happened ? now - c->step * b.g[k] / (b.g[k] - a.g[k]) : NAN;
  }
  return note_in_order(c, time);
}

// Where the chord between two instants is at a share of the step: as exact as the event's time.
static runner_instant between(const runner_instant *before, const runner_instant *after,
                              double share) {
  enum { NUMBERS = sizeof(runner_instant) / sizeof(double) };
  double a[NUMBERS], b[NUMBERS];
  runner_instant mixed;
  memcpy(a, before, sizeof a);
  memcpy(b, after, sizeof b);
  for (int i = 0; i < NUMBERS; i++) a[i] += share * (b[i] - a[i]);
  memcpy(&mixed, a, sizeof mixed);
  return mixed;
}

// The end of a ride at `time`, within the step that ended at `now`.
static void end_within(const course *c, double time, double now, const runner_instant *before) {
  runner_instant end = between(before, &c->at, 1 - (now - time) / c->step);
  look_at_ground(c, time, &end, time - (now - c->step), before);
  c->out->end_time = time;
  c->out->end = row_of(&end, time);
}

//---------------------------------- steps ---------------------------------------------------------

static void step(void *argument) {
  runner *r = (runner *)argument;
  mj_step(r->model, r->ride);
}

// The same stretch by CVODE.
static runner_status advance_cvode(course *c, long number) {
  double start = runner_seconds();
  runner_status status = runner_cvode_advance(c->cvode, (double)(number + 1) * c->step, c->error);
  c->out->wall_time += runner_seconds() - start;
  c->out->steps = runner_cvode_steps(c->cvode);
  c->out->evaluations = runner_cvode_evaluations(c->cvode);
  return status;
}

// One mj_step from number * step on, and whether it can be trusted.
static runner_status advance(course *c, long number) {
  if (c->cvode) return advance_cvode(c, number);
  runner *r = c->r;
  guard_report report;
  double from = (double)number * c->step;
  r->ride->time = from; // not the sum of a million roundings
  r->stages = 0;
  r->refused = RUNNER_OK;
  runner *before = runner_activate(r);
  double start = runner_seconds();
  guard_call(&report, step, r);
  c->out->wall_time += runner_seconds() - start;
  runner_activate(before);
  int stages = r->model->opt.integrator == mjINT_RK4 ? 4 : 1;
  runner_status status = runner_check(r, r->ride, &report, stages, c->error);
  if (status != RUNNER_OK) return status;
  status = runner_check_time(r->ride, from, c->step, c->error);
  if (status != RUNNER_OK) return status;
  r->ride->time = (double)(number + 1) * c->step;
  c->out->steps++;
  c->out->evaluations += stages;
  return RUNNER_OK;
}

static runner_status ride(course *c) {
  long steps, steps_per_sample;
  runner_divides(&steps, c->def->duration, c->step);
  runner_divides(&steps_per_sample, c->def->sample, c->step);
  runner_status status = runner_measure(&c->at, c->r, c->error);
  if (status != RUNNER_OK) return status;
  runner_settle_start(&c->at, c->r);
  c->start_speed = c->at.speed;
  look_at_ground(c, 0, &c->at, 0, &c->at);
  if (emit(c, 0) != 0) return RUNNER_INTERRUPTED;
  c->out->end = row_of(&c->at, 0);
  if (!isnan(find_events_at_start(c))) return RUNNER_OK;
  for (long i = 1; i <= steps; i++) {
    const runner_instant before = c->at;
    status = advance(c, i - 1);
    if (status == RUNNER_OK) status = runner_measure(&c->at, c->r, c->error);
    if (status != RUNNER_OK) return status;
    double end = find_events(c, (double)i * c->step, &before);
    c->out->end_time = (double)i * c->step;
    if (!isnan(end)) {
      end_within(c, end, c->out->end_time, &before);
      return RUNNER_OK;
    }
    look_at_ground(c, c->out->end_time, &c->at, c->step, &before);
    if (i % steps_per_sample == 0 && emit(c, (double)(i / steps_per_sample) * c->def->sample) != 0)
      return RUNNER_INTERRUPTED;
  }
  c->out->end = row_of(&c->at, c->out->end_time);
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
  mju_zero(r->ride->act, r->model->na);
  runner_place_rider(r, r->ride);
  if (def->tolerance > 0) {
    c.cvode = runner_cvode_create(r, def->tolerance);
    if (!c.cvode) {
      mjcf_fail(error, "%s", runner_status_string(RUNNER_MEMORY));
      return RUNNER_MEMORY;
    }
  }
  status = ride(&c);
  for (int i = 0; i < RUNNER_WHEELS; i++) bike_ground_end(&out->ground[i], out->end_time);
  runner_cvode_free(c.cvode);
  r->input = NULL;
  r->user = NULL;
  if (status == RUNNER_INTERRUPTED) mjcf_fail(error, "%s", runner_status_string(status));
  return status;
}
