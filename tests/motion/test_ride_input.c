// SPDX-License-Identifier: Apache-2.0
// Inputs as functions of time: their work, their jumps, and what is wrong with them.
#include <bicycle/error.h>
#include <math.h>

#include "motion/bicycles.h"
#include "motion/trace.h"
#include "support/near.h"

static const bike_state RIDING = {.speed = 6};

// w = 2 cm sin 2t
static void sway(double time, bike_input *out, void *user) {
  (void)user;
  out->rider_offset = 0.02 * sin(2 * time);
  out->rider_velocity = 0.04 * cos(2 * time);
  out->rider_acceleration = -0.08 * sin(2 * time);
}

static void swaying_rider_pays_for_the_energy(void **state) {
  (void)state;
  bike_model bike = roadster();
  for (int method = BIKE_METHOD_RK8; method <= BIKE_METHOD_ADAMS; method++) {
    trace t = {0};
    bike_ride_def def = ride_def(&t, RIDING, 10, 0.01);
    def.input = sway;
    def.method = method;
    ride_end(&bike, &def);
    double worst = 0, work = 0;
    for (size_t i = 0; i < t.count; i++) {
      double gap = t.sample[i].energy - t.sample[0].energy - t.more[i].work;
      worst = gap == gap ? fmax(worst, fabs(gap)) : gap;
      work = fmax(work, fabs(t.more[i].work));
    }
    assert_true(work > 0.1); // there is something to balance
    print_message("swaying rider: balance %.1e of the energy\n", worst / t.sample[0].energy);
    assert_below(worst / t.sample[0].energy, 1e-12); // required over 10 s
    trace_free(&t);
  }
}

// The rider does not lean at rest: from a riding start with w'(0) > 0 the speeds are those of the
// frame, and the sway does move the bicycle.
static void sway_moves_the_bicycle(void **state) {
  (void)state;
  bike_model bike = roadster();
  trace t = {0};
  bike_ride_def def = ride_def(&t, RIDING, 2, 0.01);
  def.input = sway;
  bike_sample end = ride_end(&bike, &def);
  assert_true(fabs(end.lean) > 1e-4);
  trace_free(&t);
}

// A push between two samples.
typedef struct push {
  double from, to, torque; // s, s, N m
  double first, last;      // s  earliest and latest time asked for
} push;

static void pushing(double time, bike_input *out, void *user) {
  push *p = ((trace *)user)->input_data;
  p->first = fmin(p->first, time);
  p->last = fmax(p->last, time);
  out->steer_torque = time >= p->from && time < p->to ? p->torque : 0;
}

static void constant_torque(double time, bike_input *out, void *user) {
  (void)time;
  out->steer_torque = ((push *)((trace *)user)->input_data)->torque;
}

// The same ride in three pieces, each with an input that does not jump.
static bike_sample in_pieces(const bike_model *bike, push *p, double duration) {
  trace t = {.input_data = p};
  bike_ride_def def = ride_def(&t, RIDING, p->from, p->from);
  bike_sample end = ride_end(bike, &def);
  def.start = state_of_sample(&end);
  def.duration = def.sample = p->to - p->from;
  def.input = constant_torque;
  end = ride_end(bike, &def);
  def.start = state_of_sample(&end);
  def.duration = def.sample = duration - p->to;
  def.input = NULL;
  end = ride_end(bike, &def);
  trace_free(&t);
  return end;
}

// An integrator that looks across a jump errs by 1e-6 and more here. RK8 leaves rounding, 2e-14;
// Adams at this tolerance makes 6.5e-12 of rounding at worst, over 60 rides of 3 s.
static void jumps_are_met_exactly(void **state) {
  (void)state;
  bike_model bike = roadster();
  push p = {.from = 0.505, .to = 1.2345, .torque = 0.4, .first = INFINITY, .last = -INFINITY};
  bike_sample pieces = in_pieces(&bike, &p, 3);
  double breakpoints[] = {0, p.from, p.to, 3, 5}; // the outer ones mean nothing
  for (int method = BIKE_METHOD_RK8; method <= BIKE_METHOD_ADAMS; method++) {
    trace t = {.input_data = &p};
    bike_ride_def def = ride_def(&t, RIDING, 3, 0.1);
    def.method = method;
    def.input = pushing;
    def.breakpoints = breakpoints;
    def.breakpoint_count = 5;
    bike_sample whole = ride_end(&bike, &def);
    assert_below(state_gap(&whole, &pieces), method == BIKE_METHOD_RK8 ? 1e-13 : 2e-11);
    assert_true(fabs(whole.lean) > 1e-3);
    assert_true(p.first >= 0 && p.last <= 3);
    assert_below(energy_drift(&t), method == BIKE_METHOD_RK8 ? 1e-13 : 1e-12);
    trace_free(&t);
  }
}

// Breakpoints on samples, written in decimals where k * 0.1 differs in its last place, and some a
// rounding apart: rows are neither lost nor doubled, no integrator has to make a step of nothing,
// and at a jump a row shows what holds from there.
static void jumps_may_fall_on_samples(void **state) {
  (void)state;
  bike_model bike = roadster();
  push p = {.from = 0.3, .to = 0.7, .torque = 1, .first = INFINITY, .last = -INFINITY};
  double breakpoints[] = {0.3, nextafter(0.3, 1), 0.7, nextafter(1, 0)};
  for (int method = BIKE_METHOD_RK8; method <= BIKE_METHOD_RK4; method++) {
    trace t = {.input_data = &p};
    bike_ride_def def = ride_def(&t, RIDING, 1, 0.1);
    def.method = method;
    def.input = pushing;
    def.breakpoints = breakpoints;
    def.breakpoint_count = 4;
    ride_end(&bike, &def);
    assert_int_equal(t.count, 11);
    assert_true(t.more[3].rear_force[1] == t.more[3].rear_force[1]);
    assert_true(fabs(t.more[3].front_force[1]) > 0.1); // straight until the push, then a side force
    assert_true(t.more[2].front_force[1] == 0);
    trace_free(&t);
  }
}

static void roll_push(double time, bike_input *out, void *user) {
  (void)user;
  out->roll_torque = time >= 0.25 && time < 0.26 ? 4000 : 0;
}

// A blow on the leaning frame throws both wheels off at its very instant.
static void jump_can_lift_the_wheels(void **state) {
  (void)state;
  bike_model bike = roadster();
  double breakpoints[] = {0.25, 0.26};
  trace t = {0};
  bike_ride_def def = ride_def(&t, (bike_state){.lean = 0.3, .speed = 4}, 0.3, 0.1);
  def.input = roll_push;
  def.breakpoints = breakpoints;
  def.breakpoint_count = 2;
  def.stop_at_lift = true;
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_int_equal(r.event_count, 1);
  assert_true(r.events[0].time == 0.25 && r.end_time == 0.25);
  trace_free(&t);
}

static void turning_bad(double time, bike_input *out, void *user) {
  (void)user;
  out->roll_torque = time > 0.5 ? NAN : 0;
}

static void bad_input_ends_in_an_error(void **state) {
  (void)state;
  bike_model with = roadster(), without = benchmark();
  for (int method = BIKE_METHOD_RK8; method <= BIKE_METHOD_RK4; method++) {
    trace t = {0};
    bike_ride_def def = ride_def(&t, RIDING, 3, 0.1);
    def.method = method;
    def.input = turning_bad;
    bike_ride_result r;
    assert_int_equal(ride_into(&r, &with, &def), BIKE_ERROR_NOT_FINITE);
    assert_false(r.complete);
    // what was reached; a trial step may meet the input's end before the ride does
    assert_true(t.count >= 1 && t.count <= 7);
    assert_true(r.end_time <= 0.5 + 1e-3 && r.event_count == 0);
    def.input = sway;
    assert_int_equal(ride_into(&r, &without, &def), BIKE_ERROR_NO_RIDER);
    trace_free(&t);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(swaying_rider_pays_for_the_energy),
      cmocka_unit_test(sway_moves_the_bicycle),
      cmocka_unit_test(jumps_are_met_exactly),
      cmocka_unit_test(jumps_may_fall_on_samples),
      cmocka_unit_test(jump_can_lift_the_wheels),
      cmocka_unit_test(bad_input_ends_in_an_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
