// SPDX-License-Identifier: Apache-2.0
// A ride, from one place where it is looked at to the next. Such places are: every step's end,
// every sample, every breakpoint of the input, and an event that ends the ride.
#include <bicycle/error.h>
#include <bicycle/ride.h>
#include <float.h>
#include <math.h>

#include "motion/ride_check.h"
#include "motion/ride_creep.h"
#include "motion/ride_event.h"
#include "motion/ride_ground.h"
#include "motion/ride_method.h"

typedef struct ride {
  const bike_ride_def *def;
  bike_ride_result *out;
  const ride_method *method;
  void *integrator;
  ride_flow flow;

  ride_point begin, end;   // of the integrator's last step
  bike_snapshot end_view;  //
  const ride_table *table; // with which a part of that step is made; NULL: method->inside

  ride_point now;           // where the ride is looked at; never beyond `end`
  ride_indicators happened; // there
  ride_side side;           //
  bool over;                // an event has ended the ride

  long row, rows;     // next sample, and their number
  double finish;      // s
  double stretch_end; // s  next breakpoint; infinite when there is none
  size_t breakpoint;  // index of the first that is still ahead
  long own_steps;     // see `stalled`
  double checkpoint;  // s  likewise
} ride;

// Times that differ by less are one time: k DT and a breakpoint written in decimals may differ by
// some units in the last place, and no integrator can make a step of that.
static bool same_time(double a, double b) {
  return fabs(a - b) <= 1e-14 * fmax(fabs(a), fabs(b));
}

static double row_time(const ride *r) {
  return r->row < r->rows ? (double)r->row * r->def->sample : INFINITY;
}

// An adaptive method that needs RIDE_STALL_STEPS steps of its own choice, not cut by rows and
// breakpoints, for RIDE_STALL_TIME, ten thousand times more than a bicycle's motion asks for, is
// caught at a singularity: a fifth of a second of work, then an error.
static bool stalled(ride *r, double limit) {
  if (!r->method->adaptive || r->end.t >= limit || ++r->own_steps % RIDE_STALL_STEPS) return false;
  bool stall = r->end.t - r->checkpoint < RIDE_STALL_TIME;
  r->checkpoint = r->end.t;
  return stall;
}

static int end_here(ride *r, bike_event_kind kind) {
  ride_record(r->out, kind, r->now.t);
  r->over = true;
  return BIKE_OK;
}

// The integrator has failed because the equations did: goes on by hand until they end.
static int creep(ride *r, double limit) {
  switch (ride_creep(&r->end, &r->end_view, limit, &r->flow)) {
  case RIDE_CREEP_STEPPED:
    r->out->steps++;
    r->table = &RIDE_TABLE_8;
    return r->method->restart(r->integrator, &r->end) ? BIKE_ERROR_SOLVER : BIKE_OK;
  case RIDE_CREEP_EDGE:
    return end_here(r, BIKE_EVENT_VALIDITY);
  case RIDE_CREEP_FATAL:
    return r->flow.error;
  case RIDE_CREEP_STUCK:
    break;
  }
  return BIKE_ERROR_SOLVER;
}

// One step of the integrator, not beyond `limit`; `stop` is the next time that must be met.
static int take_step(ride *r, double limit, double stop) {
  r->begin = r->end;
  if (same_time(r->end.t, limit)) {
    r->end.t = limit;
    return BIKE_OK;
  }
  r->flow.error = BIKE_OK;
  r->table = r->method->table;
  int failed = r->method->step(r->integrator, &r->end, limit);
  if (!failed) failed = ride_look(&r->end_view, &r->end, &r->flow);
  if (r->flow.fatal) return r->flow.error;
  if (failed == BIKE_ERROR_MEMORY) return BIKE_ERROR_MEMORY;
  if (!failed) {
    r->out->steps++;
    return stalled(r, limit) ? BIKE_ERROR_SOLVER : BIKE_OK;
  }
  if (!r->flow.error) return BIKE_ERROR_SOLVER;
  r->end = r->begin;
  return creep(r, stop);
}

// The state at a time inside the last step.
static int state_at(ride_point *out, ride *r, double t) {
  if (t == r->end.t) {
    *out = r->end;
    return BIKE_OK;
  }
  int failed = r->table ? ride_table_step(out, NULL, r->table, &r->begin, t, &r->flow)
                        // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): see ride_method.h
                        : r->method->inside(out, r->integrator, t);
  if (!failed) return BIKE_OK;
  return r->flow.fatal ? r->flow.error : BIKE_ERROR_SOLVER;
}

static int look_at(bike_snapshot *view, ride_point *at, ride *r, double t) {
  int code = state_at(at, r, t);
  if (code) return code;
  if (t == r->end.t) {
    *view = r->end_view;
    return BIKE_OK;
  }
  return ride_look(view, at, &r->flow) ? r->flow.error : BIKE_OK;
}

static int indicators_at(ride_indicators *out, double t, void *user) {
  ride *r = user;
  ride_point at;
  bike_snapshot view;
  int code = look_at(&view, &at, r, t);
  if (!code) *out = ride_indicate(r->def, &r->side, &at, &view);
  return code;
}

// Earliest event in (now.t, t] that is later than those recorded; `kind` < 0 when there is none.
static int next_event(int *kind, double *time, ride *r, double t, const ride_indicators *then,
                      bool taken[RIDE_EVENT_KINDS]) {
  *kind = -1;
  *time = INFINITY;
  for (int k = 0; k < RIDE_EVENT_KINDS; k++) {
    if (taken[k] || !ride_happened(&r->happened, then, k)) continue;
    double root;
    int code = ride_event_time(&root, k, r->now.t, &r->happened, t, then, indicators_at, r);
    if (code) return code;
    if (root >= *time) continue;
    *kind = k;
    *time = root;
  }
  return BIKE_OK;
}

// Records what happens on the way from `now` to `then`, in its order, up to what ends the ride.
static int pass_events(ride *r, double t, const ride_indicators *then) {
  bool taken[RIDE_EVENT_KINDS] = {false};
  for (;;) {
    int kind;
    double time;
    int code = next_event(&kind, &time, r, t, then, taken);
    if (code || kind < 0) return code;
    taken[kind] = true;
    if (!ride_event_ends(r->def, kind)) {
      ride_record(r->out, kind, time);
      continue;
    }
    code = state_at(&r->now, r, time);
    return code ? code : end_here(r, kind);
  }
}

static int emit(ride *r, const bike_snapshot *view) {
  if (r->now.t < row_time(r)) return BIKE_OK;
  bike_sample_more more;
  ride_describe(&r->out->end, &more, &r->now, view);
  r->row++;
  return r->def->on_sample(&r->out->end, &more, r->def->user) ? BIKE_ERROR_INTERRUPTED : BIKE_OK;
}

// What happens at one instant: at the start, or because the input jumps.
static void pass_jump(ride *r, const ride_indicators *after) {
  for (int k = 0; k < RIDE_EVENT_KINDS && !r->over; k++) {
    if (!ride_happened(&r->happened, after, k)) continue;
    ride_record(r->out, k, r->now.t);
    r->over = ride_event_ends(r->def, k);
  }
  r->happened = *after;
}

static void next_stretch(ride *r) {
  const bike_ride_def *def = r->def;
  size_t *i = &r->breakpoint;
  double t = r->now.t;
  while (*i < def->breakpoint_count &&
         (def->breakpoints[*i] <= t || same_time(def->breakpoints[*i], t)))
    ++*i;
  bool more = *i < def->breakpoint_count && def->breakpoints[*i] < r->finish &&
              !same_time(def->breakpoints[*i], r->finish);
  r->stretch_end = more ? def->breakpoints[*i] : INFINITY;
  r->flow.from = t;
  r->flow.to = more ? nextafter(r->stretch_end, 0) : r->finish;
}

// Stands at the start or at a breakpoint: goes on with the input that holds from here.
static int enter_stretch(ride *r) {
  next_stretch(r);
  int failed = r->method->restart(r->integrator, &r->now);
  if (failed) return failed == BIKE_ERROR_MEMORY ? BIKE_ERROR_MEMORY : BIKE_ERROR_SOLVER;
  r->begin = r->end = r->now;
  bike_snapshot view;
  if (ride_look(&view, &r->now, &r->flow)) return r->flow.error;
  r->end_view = view;
  if (r->row == 0) r->side = ride_side_of(&view);
  int code = emit(r, &view);
  if (code) return code;
  ride_indicators after = ride_indicate(r->def, &r->side, &r->now, &view);
  ride_ground_look(r->out->ground, r->now.t, &view);
  ride_ground_jump(r->out->ground, r->now.t, &after);
  pass_jump(r, &after);
  return BIKE_OK;
}

// What the ground had to do from `a` to where the ride is now. Where an event has ended it the
// equations may have no answer: then up to the last look.
static int pass_ground(ride *r, double a, const ride_indicators *at_a, const ride_indicators *then,
                       const bike_snapshot *view) {
  bike_snapshot last = *view;
  ride_indicators end = *then;
  if (r->over) {
    if (ride_look(&last, &r->now, &r->flow)) return r->flow.fatal ? r->flow.error : BIKE_OK;
    end = ride_indicate(r->def, &r->side, &r->now, &last);
  }
  ride_ground_look(r->out->ground, r->now.t, &last);
  return ride_ground_pass(r->out->ground, a, at_a, r->now.t, &end, indicators_at, r);
}

// To the next place where the ride is looked at.
static int advance(ride *r) {
  if (r->now.t >= r->end.t) {
    double limit = fmin(r->stretch_end, r->finish);
    double stop = fmin(limit, row_time(r));
    int code = take_step(r, r->method->inside ? limit : stop, stop);
    if (code || r->over) return code;
  }
  double t = fmin(r->end.t, row_time(r));
  ride_point there;
  bike_snapshot view;
  int code = look_at(&view, &there, r, t);
  if (code) return code;
  ride_indicators then = ride_indicate(r->def, &r->side, &there, &view);
  const ride_indicators before = r->happened;
  double from = r->now.t;
  code = pass_events(r, t, &then);
  if (code) return code;
  if (!r->over) r->now = there;
  code = pass_ground(r, from, &before, &then, &view);
  if (code || r->over) return code;
  r->happened = then;
  if (r->now.t >= r->stretch_end) return enter_stretch(r);
  return emit(r, &view);
}

// The end may lie between rows. A look at it that fails leaves the last row.
static void describe_end(ride *r) {
  bike_snapshot view;
  bike_sample_more more;
  if (!ride_look(&view, &r->now, &r->flow)) ride_describe(&r->out->end, &more, &r->now, &view);
}

static int run(ride *r) {
  int code = enter_stretch(r);
  while (!code && !r->over && r->now.t < r->finish) code = advance(r);
  r->out->complete = !code && !r->over;
  return code;
}

static const ride_method *method_of(bike_method method) {
  switch (method) {
  case BIKE_METHOD_ADAMS:
    return &RIDE_METHOD_ADAMS;
  case BIKE_METHOD_RK4:
    return &RIDE_METHOD_RK4;
  case BIKE_METHOD_RK8:
    break;
  }
  return &RIDE_METHOD_RK8; // ride_check lets no other method pass
}

static ride ride_of(bike_ride_result *out, const bike_model *model, const bike_ride_def *def) {
  long intervals = ride_intervals(def);
  double last_row = (double)intervals * def->sample;
  bool whole = last_row >= def->duration || same_time(last_row, def->duration);
  return (ride){.def = def,
                .out = out,
                .method = method_of(def->method),
                .flow = {.model = model, .input = def->input, .user = def->user},
                .now = ride_start(&def->start),
                .happened = ride_nothing_happened(),
                .rows = intervals + 1,
                .finish = whole ? last_row : def->duration};
}

int bike_ride(bike_ride_result *out, const bike_model *model, const bike_ride_def *def) {
  if (!out || !model || !def) return BIKE_ERROR_ARGUMENT;
  *out = (bike_ride_result){0};
  int code = ride_check(def);
  if (code) return code;
  ride r = ride_of(out, model, def);
  code = r.method->create(&r.integrator, def, &r.now, &r.flow);
  if (code) return code;
  code = run(&r);
  r.method->free(r.integrator);
  if (!code) describe_end(&r);
  out->end_time = out->complete ? def->duration : r.now.t;
  for (int i = 0; i < 2; i++) bike_ground_end(&out->ground[i], out->end_time);
  out->evaluations = r.flow.evaluations;
  return code;
}
