// SPDX-License-Identifier: Apache-2.0
#include "batch/member.h"

#include <bicycle/error.h>
#include <math.h>

typedef struct watch {
  const bike_member *member;
  const bike_ensemble_def *def;
  int quiet; // looks in a row
} watch;

bool member_is_quiet(const bike_member *member, const bike_state *s, double settled) {
  bool steady = fabs(s->lean_rate) < settled && fabs(s->steer_rate) < settled;
  return steady && (member->circles || (fabs(s->lean) < settled && fabs(s->steer) < settled));
}

bool member_has_settled(const bike_member *member, const bike_state *state,
                        const bike_ensemble_def *def) {
  return !def->judge || def->judge(member, state, def->judge_user);
}

static int look(const bike_sample *s, const bike_sample_more *more, void *user) {
  (void)more;
  watch *w = user;
  bike_state now = {s->lean, s->steer, s->lean_rate, s->steer_rate, s->speed};
  w->quiet = member_is_quiet(w->member, &now, w->def->settled) ? w->quiet + 1 : 0;
  if (w->quiet < MEMBER_LOOKS_SETTLED) return 0;
  if (member_has_settled(w->member, &now, w->def)) return 1;
  w->quiet = 0;
  return 0;
}

static void constant_input(double time, bike_input *out, void *user) {
  (void)time;
  const watch *w = user;
  *out = w->member->input;
}

static bool is_lifted(const bike_ride_result *ride) {
  for (int i = 0; i < ride->event_count && i < BIKE_MAX_EVENTS; i++) {
    bike_event_kind kind = ride->events[i].kind;
    if (kind == BIKE_EVENT_REAR_LIFT || kind == BIKE_EVENT_FRONT_LIFT) return true;
  }
  return false;
}

// What ended a ride that is not complete: its last event.
static bike_outcome ending_of(const bike_ride_result *ride) {
  int last = (ride->event_count < BIKE_MAX_EVENTS ? ride->event_count : BIKE_MAX_EVENTS) - 1;
  for (; last >= 0; last--) {
    switch (ride->events[last].kind) {
    case BIKE_EVENT_LEAN_LIMIT:
      return BIKE_OUTCOME_LEAN_LIMIT;
    case BIKE_EVENT_VALIDITY:
      return BIKE_OUTCOME_VALIDITY;
    case BIKE_EVENT_STANDSTILL:
      return BIKE_OUTCOME_STANDSTILL;
    case BIKE_EVENT_REAR_LIFT:
    case BIKE_EVENT_FRONT_LIFT:
      break;
    }
  }
  return BIKE_OUTCOME_VALIDITY; // so many lifts that the end was not kept
}

static bool has_input(const bike_input *in) {
  return in->steer_torque != 0 || in->roll_torque != 0 || in->rider_offset != 0;
}

void member_ride_on(bike_member_result *out, const bike_member *member, double time,
                    const bike_state *state, const bike_ensemble_def *def) {
  watch w = {.member = member, .def = def};
  bike_ride_def ride = bike_default_ride_def();
  ride.start = *state;
  ride.duration = def->duration - time;
  ride.sample = fmin(MEMBER_LOOK, ride.duration);
  ride.rtol = def->rtol;
  ride.atol = def->atol;
  ride.lean_limit = def->lean_limit;
  ride.on_sample = look;
  ride.input = has_input(&member->input) ? constant_input : NULL;
  ride.user = &w;
  bike_ride_result result;
  int code = bike_ride(&result, member->model, &ride);
  bool settled = code == BIKE_ERROR_INTERRUPTED;
  out->error = settled ? BIKE_OK : code;
  out->outcome = settled           ? BIKE_OUTCOME_SETTLED
                 : code            ? BIKE_OUTCOME_ERROR
                 : result.complete ? BIKE_OUTCOME_COMPLETE
                                   : ending_of(&result);
  out->time = time + result.end_time;
  const bike_sample *end = &result.end;
  out->end = (bike_state){end->lean, end->steer, end->lean_rate, end->steer_rate, end->speed};
  out->lifted |= def->watch_lift && is_lifted(&result);
  out->steps += result.steps;
  out->evaluations += result.evaluations;
}
