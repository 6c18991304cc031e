// SPDX-License-Identifier: Apache-2.0
#include "batch/plain_ride.h"

#include "batch/lanes_support.h"
#include "support/near.h"
#include <bicycle/error.h>

static const double NUDGE = 1e-7;
// Lanes find an end to this, s; the plain path to 1e-12.
static const double RESOLUTION = 1e-9;

static double distance(const bike_state *a, const bike_state *b) {
  double gap = fmax(fabs(a->lean - b->lean), fabs(a->steer - b->steer));
  gap = fmax(gap, fmax(fabs(a->lean_rate - b->lean_rate), fabs(a->steer_rate - b->steer_rate)));
  return fmax(gap, fabs(a->speed - b->speed));
}

static double size_of(const bike_state *s) {
  return distance(s, &(bike_state){0});
}

// How fast the state changes at the end; rates near the model's edge, and so their tolerance, are
// large.
static double pace(const bike_member *member, const bike_state *at) {
  bike_acceleration a;
  double rates = fmax(fabs(at->lean_rate), fabs(at->steer_rate));
  if (bike_accelerate(&a, member->model, at, &member->input)) return INFINITY;
  return fmax(rates, fmax(fabs(a.lean), fmax(fabs(a.steer), fabs(a.speed))));
}

// Whether a denominator is at its edge. A ride may also end before, where the straight line from
// upright to the state, along which the scalar path looks for the rear angle, leaves the range of
// the geometry (a penny-farthing steered by 150 deg): lanes follow the root of the step before.
static bool is_at_edge(const bike_member *member, const bike_state *end) {
  bike_snapshot now;
  if (bike_evaluate(&now, member->model, end, &member->input)) return true;
  double scale = fabs(now.T_r) + fabs(now.T_f), c = cos(now.phi_tilde);
  double yaw = fabs(now.T_r * c - now.T_f), pitch = fabs(now.T_r - now.T_f * c);
  return fmin(yaw, pitch) < 1.01 * BIKE_EDGE * scale;
}

plain_ride ride_plain(const bike_member *member, const bike_ensemble_def *def) {
  plain_ride plain = {0};
  bike_member nudged = *member;
  bike_ensemble_def alone = *def;
  bike_member_result other;
  alone.plain = true;
  alone.threads = 1;
  nudged.start.lean += NUDGE;
  nudged.start.steer -= NUDGE;
  nudged.start.lean_rate += NUDGE;
  nudged.start.steer_rate += NUDGE;
  if (nudged.start.speed != 0)
    nudged.start.speed += NUDGE; // a start at rest is one of its own kind
  ride_members(&plain.result, member, 1, &alone);
  ride_members(&other, &nudged, 1, &alone);
  const bike_member_result *r = &plain.result;
  plain.sharp = r->outcome == other.outcome &&
                (r->outcome != BIKE_OUTCOME_VALIDITY || is_at_edge(member, &r->end));
  double growth = fmax(1, distance(&r->end, &other.end) / NUDGE);
  double growth_in_time = fabs(r->time - other.time) / NUDGE;
  double size = fmax(size_of(&member->start), size_of(&r->end));
  double made = (double)r->steps * (def->rtol * size + def->atol); // on either path
  double resolution =
      r->outcome == BIKE_OUTCOME_COMPLETE || r->outcome == BIKE_OUTCOME_SETTLED ? 0 : RESOLUTION;
  // the 1e-14: looks are at multiples of their distance but for rounding
  plain.time_tolerance = 2 * (resolution + made * growth_in_time) + 1e-14 * r->time;
  plain.tolerance = 2 * made * growth;
  if (resolution > 0) plain.tolerance += plain.time_tolerance * pace(member, &r->end);
  return plain;
}

void assert_like_plain(const bike_member_result *got, const plain_ride *plain) {
  const bike_member_result *want = &plain->result;
  assert_string_equal(bike_outcome_string(got->outcome), bike_outcome_string(want->outcome));
  assert_int_equal(got->error, want->error);
  assert_near(got->time, want->time, plain->time_tolerance);
  if (want->error && want->time == 0) return; // nothing was ridden
  assert_near(got->end.lean, want->end.lean, plain->tolerance);
  assert_near(got->end.steer, want->end.steer, plain->tolerance);
  assert_near(got->end.lean_rate, want->end.lean_rate, plain->tolerance);
  assert_near(got->end.steer_rate, want->end.steer_rate, plain->tolerance);
  assert_near(got->end.speed, want->end.speed, plain->tolerance);
}
