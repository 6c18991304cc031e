// SPDX-License-Identifier: Apache-2.0
#include <bicycle/ensemble.h>

#include <bicycle/error.h>
#include <float.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>

#include "batch/lanes.h"
#include "batch/member.h"
#include "batch/parallel.h"

const char *bike_outcome_string(bike_outcome outcome) {
  static const char *const names[BIKE_OUTCOMES] = {"complete", "settled",    "lean limit",
                                                   "validity", "standstill", "error"};
  return outcome < BIKE_OUTCOMES ? names[outcome] : "unknown";
}

bike_ensemble_def bike_default_ensemble_def(void) {
  return (bike_ensemble_def){
      .duration = 60,
      // outcomes change only at the edges between them, by less than a picture shows
      .rtol = 1e-10,
      .atol = 1e-12,
      .lean_limit = bike_default_ride_def().lean_limit,
      .settled = 0.005,
      .watch_lift = true,
      .threads = 1};
}

// Shared by the threads: each takes the next member until none is left.
typedef struct work {
  bike_member_result *out;
  const bike_member *members;
  size_t count;
  const bike_ensemble_def *def;
  pthread_t caller;
  atomic_size_t next, done;
} work;

typedef struct worker {
  work *work;
  bool tells;
} worker;

static void count_done(worker *w) {
  size_t done = atomic_fetch_add(&w->work->done, 1) + 1;
  const bike_ensemble_def *def = w->work->def;
  bool last = done == w->work->count; // which any thread may do; told when all have ended
  if (w->tells && def->progress && !last)
    def->progress((double)done / (double)w->work->count, def->user);
}

// Where the bicycle stands at its start; an error, or an end, at once.
static int placed(lanes_rider *r, const bike_member *member, const bike_ensemble_def *def) {
  bike_snapshot now;
  int code = bike_evaluate(&now, member->model, &member->start, &member->input);
  if (code) return code;
  r->model = member->model;
  r->state = member->start;
  r->rear_angle[0] = sin(now.beta_r);
  r->rear_angle[1] = cos(now.beta_r);
  r->side = copysign(1, now.T_r * cos(now.phi_tilde) - now.T_f);
  r->w = member->input.rider_offset;
  r->steer_torque = member->input.steer_torque;
  r->roll_torque = member->input.roll_torque;
  // an upside-down wheel, or one at the limit already, is for the ride that can tell
  bool upright = now.T_r - now.T_f * cos(now.phi_tilde) > 0;
  return upright && fabs(member->start.lean) < def->lean_limit ? BIKE_OK : BIKE_ERROR_GEOMETRY;
}

static bool next_member(lanes_rider *out, void *user) {
  worker *w = user;
  work *all = w->work;
  for (;;) {
    size_t i = atomic_fetch_add(&all->next, 1);
    if (i >= all->count) return false;
    out->member = i;
    all->out[i] = (bike_member_result){0};
    const bike_member *member = &all->members[i];
    if (!all->def->plain && !placed(out, member, all->def)) return true;
    member_ride_on(&all->out[i], member, 0, &member->start, all->def);
    count_done(w);
  }
}

static void member_done(const lanes_ended *end, void *user) {
  static const bike_outcome outcomes[] = {[LANES_COMPLETE] = BIKE_OUTCOME_COMPLETE,
                                          [LANES_SETTLED] = BIKE_OUTCOME_SETTLED,
                                          [LANES_LEAN_LIMIT] = BIKE_OUTCOME_LEAN_LIMIT,
                                          [LANES_VALIDITY] = BIKE_OUTCOME_VALIDITY,
                                          [LANES_STANDSTILL] = BIKE_OUTCOME_STANDSTILL};
  worker *w = user;
  work *all = w->work;
  bike_member_result *out = &all->out[end->member];
  *out = (bike_member_result){.time = end->time,
                              .end = end->state,
                              .lifted = end->lifted,
                              .steps = end->steps,
                              .evaluations = end->evaluations};
  if (end->end == LANES_UNDECIDED)
    member_ride_on(out, &all->members[end->member], end->time, &end->state, all->def);
  else
    out->outcome = outcomes[end->end];
  count_done(w);
}

static bool is_quiet(size_t member, const bike_state *state, void *user) {
  const work *all = ((const worker *)user)->work;
  return member_is_quiet(&all->members[member], state, all->def->settled);
}

static bool has_settled(size_t member, const bike_state *state, void *user) {
  const work *all = ((const worker *)user)->work;
  return member_has_settled(&all->members[member], state, all->def);
}

static void ride_share(size_t share, void *user) {
  (void)share; // any thread may take any
  work *all = user;
  worker w = {.work = all, .tells = pthread_equal(pthread_self(), all->caller)};
  const bike_ensemble_def *def = w.work->def;
  lanes_ride_def ride = {.duration = def->duration,
                         .rtol = def->rtol,
                         .atol = def->atol,
                         .lean_limit = def->lean_limit,
                         .look = def->settled > 0 ? MEMBER_LOOK : 0,
                         .looks_settled = MEMBER_LOOKS_SETTLED,
                         .quiet = is_quiet,
                         .settled = has_settled,
                         .watch_lift = def->watch_lift,
                         .next = next_member,
                         .done = member_done,
                         .user = &w};
  lanes_in_use()->ride(&ride);
}

static bool positive(double x) {
  return isfinite(x) && x > 0;
}

static int check(const bike_member *members, size_t count, const bike_ensemble_def *def) {
  bool right = positive(def->duration) && def->duration / MEMBER_LOOK <= 1e9 &&
               def->rtol >= 4 * DBL_EPSILON && isfinite(def->rtol) && positive(def->atol) &&
               def->lean_limit > 0 && def->lean_limit <= 1.5707963267948966 && def->settled >= 0 &&
               isfinite(def->settled) && def->threads >= 1 && def->threads <= PARALLEL_MOST_THREADS;
  for (size_t i = 0; i < count && right; i++) {
    const bike_member *m = &members[i];
    right = m->model && m->input.rider_velocity == 0 && m->input.rider_acceleration == 0;
  }
  return right ? BIKE_OK : BIKE_ERROR_ARGUMENT;
}

int bike_ensemble_ride(bike_member_result *out, const bike_member *members, size_t count,
                       const bike_ensemble_def *def) {
  if (!out || !members || !def) return BIKE_ERROR_ARGUMENT;
  int code = check(members, count, def);
  if (code) return code;
  work all = {.out = out, .members = members, .count = count, .def = def, .caller = pthread_self()};
  // one share a thread, each of which takes members until none is left
  parallel_run((size_t)def->threads, def->threads, ride_share, &all, NULL, NULL);
  if (def->progress) def->progress(1, def->user);
  return BIKE_OK;
}
