// SPDX-License-Identifier: Apache-2.0
// Options of single gates: a part of the ride, the least size, information.
#include "support/near.h"
#include "validate_support.h"

#include <gate.h>
#include <stdio.h>
#include <string.h>

// From 0.2 to 0.3 s the candidate's lean is off by this much.
static const double fault = 1e-3, begin = 0.195, end = 0.305;

// Where it is less than the scenario's, the candidate falls there.
static double ends_at = INFINITY; // s

static term_exit ride_with_fault(trace *out, void *instance, const engine_ride *ride, problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, ride, p);
  for (size_t k = 0; k < out->count; k++) {
    bike_sample *s = &out->rows[k].sample;
    if (s->time > begin && s->time < end) s->lean += fault;
  }
  while (out->count > 0 && out->rows[out->count - 1].sample.time > ends_at) out->count--;
  if (ends_at < out->end_time)
    trace_end(out, false, ends_at, &(bike_event){BIKE_EVENT_LEAN_LIMIT, ends_at}, 1);
  return code;
}

// Plays half a second with that fault and one gate more than the supporting scenario has.
static support_run *play(const char *asked) {
  static engine faulty;
  faulty = engine_mujoco;
  faulty.ride = ride_with_fault;
  char text[1024];
  snprintf(text, sizeof text,
           "title: t\nbicycle: benchmark\nstart: {speed: 5, lean_rate: 0.1}\nduration: 0.5\n"
           "sample: 0.1\ninstants: {count: 0}\nreference: {engine: analytic}\n"
           "candidate: {engine: mujoco}\ngates:\n"
           "  - {layer: L0, metric: relative, limit: 1e-9, reason: r}\n"
           "  - {layer: L2, signals: [lean], reason: r, %s}\n",
           asked);
  support_run *f = support_open(&faulty, text);
  support_play(f);
  return f;
}

// The gate's value; `pass` what came of it.
static double judge(bool *pass, const char *asked, const char *metric) {
  support_run *f = play(asked);
  double value = support_find(&f->comparison, "L2", "lean", metric)->value;
  *pass = support_failed_gates(&f->comparison.gates) == 0;
  assert_int_equal(*pass, *f->comparison.cause == '\0');
  support_close(f);
  return value;
}

static void expect(const char *asked, const char *metric, bool passes) {
  bool pass;
  judge(&pass, asked, metric);
  if (pass != passes) fail_msg("%s: %s", asked, pass ? "passed" : "failed");
}

// Rows are at 0, 0.1 ... 0.5 s; those at 0.2 and 0.3 s are wrong.
static void test_window(void **state) {
  (void)state;
  static const char *const metrics[] = {"max", "scaled_max", "rmse", "nrmse", "tube"};
  static const struct {
    const char *window;
    bool passes;
  } cases[] = {{"", false},
               {", to: 0.1", true},
               {", from: 0.4", true},
               {", from: 0.4, to: 0.5", true},
               {", to: 0.2", false}, // both ends belong to it
               {", from: 0.3", false},
               {", from: 0.2, to: 0.3", false},
               {", from: 0.1, to: 0.15", true}};
  for (size_t i = 0; i < sizeof metrics / sizeof *metrics; i++)
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
      char text[128];
      snprintf(text, sizeof text, "metric: %s, limit: 1e-8%s", metrics[i], cases[k].window);
      expect(text, metrics[i], cases[k].passes);
    }
}

static void test_end_of_window(void **state) {
  (void)state;
  expect("metric: end, limit: 1e-8", "end", true);
  expect("metric: end, limit: 1e-8, to: 0.3", "end", false);
  expect("metric: end, limit: 1e-8, to: 0.4", "end", true);
}

// The measured largest error of lean in a part of the ride; the test fails without one.
static const measurement *max_within(const comparison *c, double from, double to) {
  for (size_t i = 0; i < c->measurements.count; i++) {
    const measurement *m = &c->measurements.items[i];
    if (strcmp(m->signal, "lean") == 0 && strcmp(m->metric, "max") == 0 && m->from == from &&
        m->to == to)
      return m;
  }
  fail_msg("nothing measured from %g to %g s", from, to);
  return NULL;
}

static const gate *gate_of(const comparison *c, const measurement *m) {
  for (size_t i = 0; i < c->gates.count; i++)
    if (measurement_is_like(&c->gates.items[i].what, m)) return &c->gates.items[i];
  return NULL;
}

// Each part of a ride is judged by its own rule, the last for that part; the whole by another.
static void test_several_windows(void **state) {
  (void)state;
  support_run *f = play(
      "metric: max, limit: 1e-8, to: 0.1}\n"
      "  - {layer: L2, metric: max, signals: [lean, steer], limit: 1, from: 0.2, to: 0.3, reason: "
      "r}\n"
      "  - {layer: L2, metric: max, signals: [lean], limit: 1e-8, from: 0.4, reason: r}\n"
      "  - {layer: L2, metric: max, signals: [lean], limit: 2, from: 0.2, to: 0.3, reason: last");
  const comparison *c = &f->comparison;
  assert_below(max_within(c, 0, 0.1)->value, 1e-8);
  assert_near(max_within(c, 0.2, 0.3)->value, fault, 1e-9);
  assert_below(max_within(c, 0.4, 0)->value, 1e-8);
  assert_near(max_within(c, 0, 0)->value, fault, 1e-9);
  assert_null(gate_of(c, max_within(c, 0, 0))); // the whole ride is information
  assert_true(gate_of(c, max_within(c, 0, 0.1))->rule->limit == 1e-8);
  assert_string_equal(gate_of(c, max_within(c, 0.2, 0.3))->rule->reason, "last");
  assert_string_equal(c->cause, "");
  support_close(f);
  f = play(
      "metric: max, limit: 1e-8, to: 0.1}\n"
      "  - {layer: L2, metric: max, signals: [lean], limit: 1e-8, from: 0.1, to: 0.25, reason: r");
  support_expect_failure(&f->comparison, "L2", "max (0.1 to 0.25 s)");
  assert_int_equal(support_failed_gates(&f->comparison.gates), 1);
  support_close(f);
}

static void test_window_in_words(void **state) {
  (void)state;
  char out[MEASUREMENT_METRIC];
  assert_string_equal(measurement_metric(out, "max", 0, 0), "max");
  assert_string_equal(measurement_metric(out, "max", 1, 0), "max (from 1 s)");
  assert_string_equal(measurement_metric(out, "max", 0, 3), "max (to 3 s)");
  assert_string_equal(measurement_metric(out, "rmse", 0.25, 3), "rmse (0.25 to 3 s)");
}

// A ride that ends before its time is played and judged; what is asked of the rest fails.
static void test_empty_window_says_so(void **state) {
  (void)state;
  ends_at = 0.25;
  support_run *f = play("metric: max, limit: 1, from: 0.3, to: 0.4");
  ends_at = INFINITY;
  const measurement *m = max_within(&f->comparison, 0.3, 0.4);
  assert_true(isnan(m->value));
  assert_non_null(strstr(m->detail, "no comparable row from 0.3 s on"));
  const gate *missed = gate_of(&f->comparison, m);
  assert_non_null(missed);
  assert_false(missed->pass);
  assert_int_equal(support_failed_gates(&f->comparison.gates),
                   2); // and that it ends before its time
  support_close(f);
}

// Lean moves by less than 1 rad: with a nominal size of 2 rad that is what errors are compared to.
static void test_nominal(void **state) {
  (void)state;
  bool pass;
  double rmse = judge(&pass, "metric: rmse, limit: 1", "rmse");
  double small = judge(&pass, "metric: nrmse, limit: 1, nominal: 2", "nrmse");
  assert_near(small, rmse / 2, 1e-15);
  double half = judge(&pass, "metric: nrmse, limit: 1, nominal: 4", "nrmse");
  assert_near(half, rmse / 4, 1e-15);
  double range = judge(&pass, "metric: nrmse, limit: 1, nominal: 1e-9", "nrmse");
  assert_true(range > 2 * small);
}

static void test_information_is_measured_not_judged(void **state) {
  (void)state;
  bool pass;
  double value = judge(&pass, "metric: max, info: true", "max");
  assert_near(value, fault, 1e-9);
  assert_true(pass);
  expect("metric: max, limit: 1e-8, info: true", "max", true);
  expect("metric: max, limit: 1e-8, info: false", "max", false);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_window),
      cmocka_unit_test(test_end_of_window),
      cmocka_unit_test(test_several_windows),
      cmocka_unit_test(test_window_in_words),
      cmocka_unit_test(test_empty_window_says_so),
      cmocka_unit_test(test_nominal),
      cmocka_unit_test(test_information_is_measured_not_judged),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
