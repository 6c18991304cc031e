// SPDX-License-Identifier: Apache-2.0
// Events: each kind is reached, at a time that a ride of exactly that length confirms.
#include <bicycle/error.h>
#include <math.h>
#include <string.h>

#include "motion/bicycles.h"
#include "motion/trace.h"
#include "support/near.h"

static const bike_state TOPPLING = {.lean = 0.05}; // from rest

// The row at `time` of the same ride, stepped in another way: one step fewer, tighter.
static bike_sample confirm(const bike_model *bike, bike_ride_def def, double time) {
  trace t = {0};
  def.duration = time;
  def.sample = time;
  def.rtol = def.atol = 1e-14;
  def.method = BIKE_METHOD_RK8;
  def.user = &t;
  bike_ride_result result;
  int code = ride_into(&result, bike, &def);
  assert_int_equal(code, 0);
  bike_sample last = t.sample[t.count - 1];
  trace_free(&t);
  // the ride may end by the very event, 1e-12 s before its last row: then look just before
  if (last.time == time) return last;
  assert_true(result.end_time >= time - 1e-9);
  return confirm(bike, def, time - 1e-9);
}

static double event_time(const bike_ride_result *r, bike_event_kind kind) {
  for (int i = 0; i < r->event_count; i++)
    if (r->events[i].kind == kind) return r->events[i].time;
  fail_msg("no event: %s", bike_event_string(kind));
  return NAN;
}

static int count_of(const bike_ride_result *r, bike_event_kind kind) {
  int n = 0;
  for (int i = 0; i < r->event_count; i++) n += r->events[i].kind == kind;
  return n;
}

static void assert_in_order(const bike_ride_result *r, const trace *t) {
  for (int i = 1; i < r->event_count; i++) assert_true(r->events[i].time >= r->events[i - 1].time);
  for (size_t k = 0; k < t->count; k++) assert_true(t->sample[k].time <= r->end_time);
}

// Falling from rest the rear wheel lifts, which is noted; the lean limit ends the ride.
static void fall_lifts_and_reaches_the_limit(void **state) {
  (void)state;
  bike_model bike = roadster();
  trace t = {0};
  bike_ride_def def = ride_def(&t, TOPPLING, 10, 0.01);
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_in_order(&r, &t);
  assert_false(r.complete);
  assert_int_equal(r.event_count, 2);
  double lift = event_time(&r, BIKE_EVENT_REAR_LIFT), end = event_time(&r, BIKE_EVENT_LEAN_LIMIT);
  assert_true(r.end_time == end && lift < end);
  // it falls by some 1e4 N/s there, and by 3 rad/s
  assert_below(confirm(&bike, def, lift).rear_normal, 1e-7);
  assert_near(confirm(&bike, def, end).lean, def.lean_limit, 1e-8);
  // rows reach up to the event: every whole 0.01 s before it
  assert_int_equal(t.count, (size_t)floor(end / 0.01) + 1);
  trace_free(&t);
}

static void lift_ends_the_ride_when_asked(void **state) {
  (void)state;
  bike_model bike = roadster();
  trace t = {0};
  bike_ride_def def = ride_def(&t, TOPPLING, 10, 0.01);
  bike_ride_result on, stop;
  assert_int_equal(ride_into(&on, &bike, &def), 0);
  def.stop_at_lift = true;
  assert_int_equal(ride_into(&stop, &bike, &def), 0);
  assert_int_equal(stop.event_count, 1);
  assert_true(stop.end_time == event_time(&on, BIKE_EVENT_REAR_LIFT));
  assert_in_order(&stop, &t);
  trace_free(&t);
}

// Steps so long that both happen within one: still first lifts, then the end.
static void events_of_one_step_come_in_order(void **state) {
  (void)state;
  bike_model bike = roadster();
  trace t = {0};
  bike_ride_def def = ride_def(&t, TOPPLING, 10, 0.2);
  def.method = BIKE_METHOD_RK4;
  def.step = 0.2;
  def.lean_limit = 1.1;
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_in_order(&r, &t);
  assert_true(r.event_count >= 2);
  const bike_event *last = &r.events[r.event_count - 1];
  assert_int_equal(last->kind, BIKE_EVENT_LEAN_LIMIT);
  assert_true(last[-1].time > 1 && last->time < 1.2); // both in the sixth step
  assert_int_equal(r.steps, 6);
  trace_free(&t);
}

static void front_wheel_lifts(void **state) {
  (void)state;
  bike_model bike = benchmark();
  bike_state start = {.lean = 0.5, .steer = -0.4, .lean_rate = -2, .steer_rate = -1, .speed = 2};
  trace t = {0};
  bike_ride_def def = ride_def(&t, start, 3, 0.05);
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_in_order(&r, &t);
  double lift = event_time(&r, BIKE_EVENT_FRONT_LIFT);
  assert_below(confirm(&bike, def, lift).front_normal, 1e-6);
  trace_free(&t);
}

// A wheel that is off the ground from the start has lifted at time zero; coming down is no event.
static void lift_at_the_start_has_time_zero(void **state) {
  (void)state;
  bike_model bike = roadster();
  bike_state falling = {
      .lean = 1.15, .steer = 0.816, .lean_rate = 3, .steer_rate = 0.73, .speed = -1.3};
  trace t = {0};
  bike_ride_def def = ride_def(&t, falling, 0.09, 0.01);
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_true(t.sample[0].rear_normal < 0);
  assert_true(r.events[0].kind == BIKE_EVENT_REAR_LIFT && r.events[0].time == 0);
  assert_int_equal(count_of(&r, BIKE_EVENT_REAR_LIFT), 1);
  def.stop_at_lift = true;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_true(r.end_time == 0 && t.count == 1 && r.event_count == 1);
  trace_free(&t);
}

static void lean_limit_is_met_on_either_side(void **state) {
  (void)state;
  bike_model bike = roadster();
  for (int side = -1; side <= 1; side += 2) {
    trace t = {0};
    bike_state start = {.lean = side * 0.05};
    bike_ride_def def = ride_def(&t, start, 10, 0.5);
    def.lean_limit = 0.5;
    bike_ride_result r;
    assert_int_equal(ride_into(&r, &bike, &def), 0);
    assert_int_equal(r.event_count, 1);
    double end = event_time(&r, BIKE_EVENT_LEAN_LIMIT);
    def.lean_limit = 1;
    assert_near(confirm(&bike, def, end).lean, side * 0.5, 1e-11);
    def.lean_limit = 0.04; // beyond it already
    assert_int_equal(ride_into(&r, &bike, &def), 0);
    assert_true(r.end_time == 0 && t.count == 1);
    trace_free(&t);
  }
}

// How much is left of the two denominators, as a share of |T_r| + |T_f|.
static double share_left(const bike_model *bike, const bike_sample *s) {
  bike_state at = state_of_sample(s);
  bike_snapshot n;
  assert_int_equal(bike_evaluate(&n, bike, &at, NULL), 0);
  double c = cos(n.phi_tilde), scale = fabs(n.T_r) + fabs(n.T_f);
  return fmin(fabs(n.T_r * c - n.T_f), fabs(n.T_r - n.T_f * c)) / scale;
}

// The ends of the model: steer near 90 degrees, no root of (4) (penny-farthing), a steering axis
// that becomes horizontal. All methods find the same time, RK4 at 1 ms less exactly.
static void validity_ends(void **state) {
  (void)state;
  struct {
    bike_model bike;
    bike_state start;
  } cases[] = {{roadster(), {.lean = 0.05, .speed = 1}},
               {penny_farthing(), {.lean = 0.2, .steer = -0.6, .speed = -1}},
               {roadster(), {0.512, 0.202, 0.982, 1.608, -0.045}}};
  double tolerance[] = {0, 1e-9, 1e-8};
  for (int i = 0; i < 3; i++) {
    double end = 0;
    for (int method = BIKE_METHOD_RK8; method <= BIKE_METHOD_RK4; method++) {
      trace t = {0};
      bike_ride_def def = ride_def(&t, cases[i].start, 10, 0.05);
      def.method = method;
      bike_ride_result r;
      assert_int_equal(ride_into(&r, &cases[i].bike, &def), 0);
      assert_in_order(&r, &t);
      assert_false(r.complete);
      assert_true(r.end_time == event_time(&r, BIKE_EVENT_VALIDITY));
      assert_true(r.steps < 5000);
      if (method == BIKE_METHOD_RK8) end = r.end_time;
      print_message("method %d ends %.1e s from RK8\n", method, r.end_time - end);
      assert_near(r.end_time, end, tolerance[method]);
      bike_sample last = confirm(&cases[i].bike, def, end);
      assert_near(share_left(&cases[i].bike, &last), 1e-3, 1e-6);
      trace_free(&t);
    }
  }
}

// Forwards and, by a different start, backwards: the speed crosses zero and the ride ends.
static void standstill_ends_the_ride(void **state) {
  (void)state;
  bike_model bike = roadster();
  bike_state starts[] = {{.lean = 0.05, .steer = 0.5, .speed = 1},
                         {.lean = -0.6, .steer = 0.7, .lean_rate = 2, .speed = -3}};
  for (int i = 0; i < 2; i++) {
    trace t = {0};
    bike_ride_def def = ride_def(&t, starts[i], 10, 0.05);
    bike_ride_result r;
    assert_int_equal(ride_into(&r, &bike, &def), 0);
    double end = event_time(&r, BIKE_EVENT_STANDSTILL);
    assert_true(r.end_time == end && !r.complete);
    assert_below(confirm(&bike, def, end).speed, 1e-7);
    trace_free(&t);
  }
}

// A bicycle left alone at rest falls; that it rolls to and fro meanwhile ends nothing.
static void start_at_rest_is_a_ride(void **state) {
  (void)state;
  bike_model bike = roadster();
  trace t = {0};
  bike_ride_def def = ride_def(&t, (bike_state){.lean = 0.05, .steer = -0.1}, 10, 0.01);
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_int_equal(count_of(&r, BIKE_EVENT_STANDSTILL), 0);
  assert_true(t.count > 50);
  trace_free(&t);
}

// Found at the ends of steps, located inside them: neither the method nor the sampling matters.
static void time_of_an_event_depends_on_nothing_else(void **state) {
  (void)state;
  bike_model bike = roadster();
  double samples[] = {0.001, 0.01, 0.07, 1};
  double lift = 0, end = 0;
  for (int method = BIKE_METHOD_RK8; method <= BIKE_METHOD_ADAMS; method++)
    for (int i = 0; i < 4; i++) {
      trace t = {0};
      bike_ride_def def = ride_def(&t, TOPPLING, 10, samples[i]);
      def.method = method;
      bike_ride_result r;
      assert_int_equal(ride_into(&r, &bike, &def), 0);
      if (end == 0) {
        lift = event_time(&r, BIKE_EVENT_REAR_LIFT);
        end = r.end_time;
      }
      assert_near(event_time(&r, BIKE_EVENT_REAR_LIFT), lift, 1e-10);
      assert_near(r.end_time, end, 1e-10);
      trace_free(&t);
    }
}

// How long the rows of a ride show a wheel lifted, or without grip.
static void count_rows(double out[2][2], const trace *t, double limit, double interval) {
  for (size_t i = 0; i < t->count; i++)
    for (int w = 0; w < 2; w++) {
      const double *force = w ? t->more[i].front_force : t->more[i].rear_force;
      out[w][0] += interval * !(force[2] > 0);
      out[w][1] += interval * !(hypot(force[0], force[1]) < limit * force[2]);
    }
}

static void assert_ground_is(const bike_ride_result *r, double rows[2][2], double tolerance) {
  for (int w = 0; w < 2; w++) {
    const bike_wheel_ground *g = &r->ground[w];
    assert_near(g->lifted.duration, rows[w][0], tolerance);
    assert_near(g->no_grip.duration, rows[w][1], tolerance);
    if (g->lifted.count > 0) assert_true(isinf(g->friction) && g->friction_time == g->lifted.first);
    if (g->no_grip.count > 0 && g->no_grip.first > 0)
      assert_true(g->friction > 1 && g->friction_time >= g->no_grip.first);
  }
}

// Wheels that lift and come down, that slide and hold again: the intervals are those of rows a
// ten times closer than steps, and do not depend on what rows were asked for.
static void ground_is_watched_between_rows(void **state) {
  (void)state;
  bike_model bike = roadster(), other = benchmark();
  const struct {
    const bike_model *bike;
    bike_state start;
    double duration;
    int returns; // at least one wheel comes down, or holds again
  } cases[] = {
      {&bike, TOPPLING, 1.24, 0},
      {&bike,
       {.lean = 1.15, .steer = 0.816, .lean_rate = 3, .steer_rate = 0.73, .speed = -1.3},
       0.09,
       1},
      {&other,
       {.lean = 0.5, .steer = -0.4, .lean_rate = -2, .steer_rate = -1, .speed = 2},
       0.87,
       1},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    trace t = {0};
    double interval = cases[i].duration / 1000;
    bike_ride_def def = ride_def(&t, cases[i].start, cases[i].duration, interval);
    bike_ride_result fine, coarse;
    assert_int_equal(ride_into(&fine, cases[i].bike, &def), 0);
    double rows[2][2] = {{0}};
    count_rows(rows, &t, 1, interval);
    int spells = 0, returned = 0;
    for (int w = 0; w < 2; w++) {
      spells += fine.ground[w].lifted.count + fine.ground[w].no_grip.count;
      const bike_spells *s = &fine.ground[w].lifted;
      returned += s->count > 0 && s->first + s->duration < fine.end_time - interval;
    }
    assert_true(spells > 0);
    if (cases[i].returns) assert_true(returned > 0);
    // each end of an interval lies within an interval between rows
    assert_ground_is(&fine, rows, 2 * interval * (spells + 1));
    def.sample = def.duration;
    assert_int_equal(ride_into(&coarse, cases[i].bike, &def), 0);
    assert_ground_is(&coarse, rows, 2 * interval * (spells + 1));
    for (int w = 0; w < 2; w++) {
      assert_int_equal(coarse.ground[w].lifted.count, fine.ground[w].lifted.count);
      assert_near(coarse.ground[w].no_grip.first, fine.ground[w].no_grip.first, 1e-9);
    }
    trace_free(&t);
  }
}

static void events_have_names(void **state) {
  (void)state;
  for (int a = 0; a <= BIKE_EVENT_STANDSTILL; a++)
    for (int b = 0; b < a; b++) assert_string_not_equal(bike_event_string(a), bike_event_string(b));
  assert_non_null(bike_event_string((bike_event_kind)99));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fall_lifts_and_reaches_the_limit),
      cmocka_unit_test(lift_ends_the_ride_when_asked),
      cmocka_unit_test(events_of_one_step_come_in_order),
      cmocka_unit_test(front_wheel_lifts),
      cmocka_unit_test(lift_at_the_start_has_time_zero),
      cmocka_unit_test(lean_limit_is_met_on_either_side),
      cmocka_unit_test(validity_ends),
      cmocka_unit_test(standstill_ends_the_ride),
      cmocka_unit_test(start_at_rest_is_a_ride),
      cmocka_unit_test(time_of_an_event_depends_on_nothing_else),
      cmocka_unit_test(ground_is_watched_between_rows),
      cmocka_unit_test(events_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
