// SPDX-License-Identifier: Apache-2.0
// What a definition may not be; and that a library never prints.
#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "motion/bicycles.h"
#include "motion/trace.h"
#include "support/near.h"

static trace rows;

static bike_ride_def good(void) {
  return ride_def(&rows, (bike_state){.speed = 6}, 1, 0.1);
}

typedef void change(bike_ride_def *def);
static const double FALLING[] = {0.5, 0.4}, TWICE[] = {0.5, 0.5}, ENDLESS[] = {0.5, INFINITY};

static void no_sink(bike_ride_def *d) {
  d->on_sample = NULL;
}
static void no_duration(bike_ride_def *d) {
  d->duration = 0;
}
static void backwards(bike_ride_def *d) {
  d->duration = -1;
}
static void nan_duration(bike_ride_def *d) {
  d->duration = NAN;
}
static void endless(bike_ride_def *d) {
  d->duration = INFINITY;
}
static void no_sample(bike_ride_def *d) {
  d->sample = 0;
}
static void nan_sample(bike_ride_def *d) {
  d->sample = NAN;
}
static void long_sample(bike_ride_def *d) {
  d->sample = 2;
}
static void tiny_sample(bike_ride_def *d) {
  d->sample = 1e-10;
}
static void no_method(bike_ride_def *d) {
  d->method = (bike_method)17;
}
static void no_rtol(bike_ride_def *d) {
  d->rtol = 0;
}
static void below_rounding(bike_ride_def *d) {
  d->rtol = 1e-17;
}
static void nan_rtol(bike_ride_def *d) {
  d->rtol = NAN;
}
static void no_atol(bike_ride_def *d) {
  d->atol = 0;
}
static void nan_atol(bike_ride_def *d) {
  d->atol = NAN;
}
static void adams_no_atol(bike_ride_def *d) {
  d->method = BIKE_METHOD_ADAMS, d->atol = -1;
}
static void no_step(bike_ride_def *d) {
  d->method = BIKE_METHOD_RK4, d->step = 0;
}
static void nan_step(bike_ride_def *d) {
  d->method = BIKE_METHOD_RK4, d->step = NAN;
}
static void odd_step(bike_ride_def *d) {
  d->method = BIKE_METHOD_RK4, d->step = 0.03;
}
static void long_step(bike_ride_def *d) {
  d->method = BIKE_METHOD_RK4, d->step = 0.2;
}
static void no_limit(bike_ride_def *d) {
  d->lean_limit = 0;
}
static void far_limit(bike_ride_def *d) {
  d->lean_limit = 1.6;
}
static void nan_limit(bike_ride_def *d) {
  d->lean_limit = NAN;
}
static void no_friction(bike_ride_def *d) {
  d->friction_limit = 0;
}
static void nan_friction(bike_ride_def *d) {
  d->friction_limit = NAN;
}
static void no_points(bike_ride_def *d) {
  d->breakpoint_count = 1;
}
static void falling(bike_ride_def *d) {
  d->breakpoint_count = 2, d->breakpoints = FALLING;
}
static void twice(bike_ride_def *d) {
  d->breakpoint_count = 2, d->breakpoints = TWICE;
}
static void far_point(bike_ride_def *d) {
  d->breakpoint_count = 2, d->breakpoints = ENDLESS;
}
static void nan_lean(bike_ride_def *d) {
  d->start.lean = NAN;
}
static void infinite_speed(bike_ride_def *d) {
  d->start.speed = INFINITY;
}
static void nan_rate(bike_ride_def *d) {
  d->start.steer_rate = NAN;
}

static const struct {
  change *change;
  int code;
} WRONG[] = {
    {no_sink, BIKE_ERROR_ARGUMENT},          {no_duration, BIKE_ERROR_ARGUMENT},
    {backwards, BIKE_ERROR_ARGUMENT},        {nan_duration, BIKE_ERROR_ARGUMENT},
    {endless, BIKE_ERROR_ARGUMENT},          {no_sample, BIKE_ERROR_ARGUMENT},
    {nan_sample, BIKE_ERROR_ARGUMENT},       {long_sample, BIKE_ERROR_ARGUMENT},
    {tiny_sample, BIKE_ERROR_ARGUMENT},      {no_method, BIKE_ERROR_ARGUMENT},
    {no_rtol, BIKE_ERROR_ARGUMENT},          {below_rounding, BIKE_ERROR_ARGUMENT},
    {nan_rtol, BIKE_ERROR_ARGUMENT},         {no_atol, BIKE_ERROR_ARGUMENT},
    {nan_atol, BIKE_ERROR_ARGUMENT},         {adams_no_atol, BIKE_ERROR_ARGUMENT},
    {no_step, BIKE_ERROR_ARGUMENT},          {nan_step, BIKE_ERROR_ARGUMENT},
    {odd_step, BIKE_ERROR_ARGUMENT},         {long_step, BIKE_ERROR_ARGUMENT},
    {no_limit, BIKE_ERROR_ARGUMENT},         {far_limit, BIKE_ERROR_ARGUMENT},
    {nan_limit, BIKE_ERROR_ARGUMENT},        {no_points, BIKE_ERROR_ARGUMENT},
    {falling, BIKE_ERROR_ARGUMENT},          {twice, BIKE_ERROR_ARGUMENT},
    {far_point, BIKE_ERROR_ARGUMENT},        {nan_lean, BIKE_ERROR_NOT_FINITE},
    {infinite_speed, BIKE_ERROR_NOT_FINITE}, {nan_rate, BIKE_ERROR_NOT_FINITE},
    {no_friction, BIKE_ERROR_ARGUMENT},      {nan_friction, BIKE_ERROR_ARGUMENT},
};

static void the_broken_rule_is_named(void **state) {
  (void)state;
  static const struct {
    change *change;
    const char *says;
  } rules[] = {{no_duration, "duration"},
               {no_sample, "sample must be positive"},
               {long_sample, "longer than"},
               {tiny_sample, "billionth"},
               {no_method, "method"},
               {no_rtol, "rtol"},
               {no_atol, "atol"},
               {no_step, "step must be positive"},
               {odd_step, "must divide"},
               {far_limit, "lean_limit"},
               {no_friction, "friction_limit"},
               {twice, "breakpoints"},
               {no_sink, "on_sample"}};
  for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
    bike_ride_def def = good();
    assert_null(bike_ride_broken_rule(&def));
    rules[i].change(&def);
    const char *rule = bike_ride_broken_rule(&def);
    if (!rule || !strstr(rule, rules[i].says))
      fail_msg("'%s' does not say '%s'", rule ? rule : "nothing", rules[i].says);
  }
}

static void wrong_definitions_are_refused(void **state) {
  (void)state;
  bike_model bike = roadster();
  for (size_t i = 0; i < sizeof WRONG / sizeof *WRONG; i++) {
    bike_ride_def def = good();
    WRONG[i].change(&def);
    bike_ride_result r = {.steps = 5};
    rows.count = 0;
    int code = bike_ride(&r, &bike, &def);
    if (code != WRONG[i].code) print_error("case %zu: %s\n", i, bike_error_string(code));
    assert_int_equal(code, WRONG[i].code);
    assert_true(r.steps == 0 && r.event_count == 0 && !r.complete && rows.count == 0);
  }
}

static void pointers_are_checked(void **state) {
  (void)state;
  bike_model bike = roadster();
  bike_ride_def def = good();
  bike_ride_result r;
  assert_int_equal(bike_ride(NULL, &bike, &def), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_ride(&r, NULL, &def), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_ride(&r, &bike, NULL), BIKE_ERROR_ARGUMENT);
}

static void impossible_start_is_its_own_error(void **state) {
  (void)state;
  bike_model bike = penny_farthing();
  bike_ride_def def = good();
  def.start = (bike_state){.lean = 1.2, .steer = 1.0, .speed = 3};
  bike_snapshot now;
  int expected = bike_evaluate(&now, &bike, &def.start, NULL);
  assert_int_not_equal(expected, 0);
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), expected);
  assert_int_equal(rows.count, 0);
}

static void default_is_good(void **state) {
  (void)state;
  bike_model bike = roadster();
  bike_ride_def def = good();
  assert_int_equal(def.method, BIKE_METHOD_RK8);
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  def.rtol = def.atol = NAN; // RK4 has no tolerance
  def.method = BIKE_METHOD_RK4;
  def.step = 0.1 / 3;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_int_equal(r.steps, 30);
}

// Not even its own rounding would let a step be this accurate: an error, at once.
static void unreachable_accuracy_is_an_error(void **state) {
  (void)state;
  bike_model bike = roadster();
  bike_ride_def def = good();
  def.start.lean_rate = 0.2;
  def.atol = 1e-300;
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), BIKE_ERROR_SOLVER);
  assert_true(!r.complete && r.event_count == 0 && r.end_time == 0 && rows.count == 1);
}

// A damper so stiff that explicit steps get nowhere: given up, not ridden for hours.
static void rides_that_get_nowhere_end(void **state) {
  (void)state;
  bike_model bike = roadster();
  bike.steer_damping = 1e7;
  bike_ride_def def = good();
  def.start.lean_rate = 0.2;
  def.duration = 60;
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), BIKE_ERROR_SOLVER);
  assert_true(r.steps < 100000 && r.end_time < 1);
}

// Steps that only rows cut short are none of the integrator's choice.
static void many_rows_are_no_stall(void **state) {
  (void)state;
  bike_model bike = roadster();
  bike_ride_def def = good();
  def.duration = 1e-3;
  def.sample = 1e-8;
  bike_ride_result r;
  assert_int_equal(ride_into(&r, &bike, &def), 0);
  assert_true(r.complete);
}

static void bad(double time, bike_input *out, void *user) {
  (void)user;
  out->roll_torque = time > 0.2 ? NAN : 0;
}

// Rides that fail in each way, with both output streams sent to a file that must stay empty.
static void failing_rides(const bike_model *bike) {
  for (int method = BIKE_METHOD_RK8; method <= BIKE_METHOD_RK4; method++) {
    bike_ride_result r;
    bike_ride_def def = good();
    def.method = method;
    def.input = bad;
    ride_into(&r, bike, &def);
    def.input = NULL;
    def.duration = 10;
    def.start = (bike_state){.lean = 0.05, .speed = 1};
    ride_into(&r, bike, &def);
    def.start = (bike_state){.speed = 1e200};
    ride_into(&r, bike, &def);
    def.start = (bike_state){.lean = 0.1, .speed = 6};
    def.atol = 1e-300;
    ride_into(&r, bike, &def);
  }
}

static void library_is_silent(void **state) {
  (void)state;
  bike_model bike = roadster();
  FILE *sink = tmpfile();
  assert_non_null(sink);
  fflush(stdout);
  fflush(stderr);
  int out = dup(1), err = dup(2);
  dup2(fileno(sink), 1);
  dup2(fileno(sink), 2);
  failing_rides(&bike);
  fflush(stdout);
  fflush(stderr);
  dup2(out, 1);
  dup2(err, 2);
  close(out);
  close(err);
  fseek(sink, 0, SEEK_END);
  long printed = ftell(sink);
  fclose(sink);
  assert_int_equal(printed, 0);
}

static int forget(void **state) {
  (void)state;
  trace_free(&rows);
  return 0;
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_broken_rule_is_named),
      cmocka_unit_test(wrong_definitions_are_refused),
      cmocka_unit_test(pointers_are_checked),
      cmocka_unit_test(impossible_start_is_its_own_error),
      cmocka_unit_test(default_is_good),
      cmocka_unit_test(unreachable_accuracy_is_an_error),
      cmocka_unit_test(rides_that_get_nowhere_end),
      cmocka_unit_test(many_rows_are_no_stall),
      cmocka_unit_test(library_is_silent),
  };
  return cmocka_run_group_tests(tests, NULL, forget);
}
