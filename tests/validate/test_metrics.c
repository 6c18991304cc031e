// SPDX-License-Identifier: Apache-2.0
// Metrics on made-up data, gates on made-up measurements, traces.
#include "support/near.h"

#include "files/sha256.h"
#include <gate.h>
#include <layer.h>
#include <metrics.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT = 5 };
static const double times[COUNT] = {0, 0.1, 0.2, 0.3, 0.4};

static void test_peak_and_its_time(void **state) {
  (void)state;
  const double error[COUNT] = {0.5, -1, 3, -4, 2};
  metrics_peak peak = metrics_max(times, error, COUNT);
  assert_near(peak.value, 4, 0);
  assert_near(peak.time, 0.3, 0);
  assert_near(metrics_rms(error, COUNT), sqrt(30.25 / 5), 1e-15);
  assert_near(metrics_spread(error, COUNT), 7, 0);
}

static void test_constant(void **state) {
  (void)state;
  const double error[COUNT] = {2, 2, 2, 2, 2};
  metrics_peak peak = metrics_max(times, error, COUNT);
  assert_near(peak.value, 2, 0);
  assert_near(peak.time, 0, 0); // the first of equals
  assert_near(metrics_rms(error, COUNT), 2, 0);
  assert_near(metrics_spread(error, COUNT), 0, 0);
}

static void test_growth_is_divided_out(void **state) {
  (void)state;
  double error[COUNT];
  for (int k = 0; k < COUNT; k++) error[k] = -1e-12 * exp(3 * times[k]);
  error[1] *= 1.5;
  metrics_peak peak = metrics_scaled_max(times, error, COUNT, 3);
  assert_near(peak.value, 1.5e-12, 1e-26);
  assert_near(peak.time, 0.1, 0);
}

static void test_nan_is_never_lost(void **state) {
  (void)state;
  for (int bad = 0; bad < COUNT; bad++) {
    double error[COUNT] = {1, 2, 3, 2, 1};
    error[bad] = NAN;
    metrics_peak peak = metrics_max(times, error, COUNT);
    assert_true(isnan(peak.value));
    assert_near(peak.time, times[bad], 0);
    assert_true(isnan(metrics_scaled_max(times, error, COUNT, 1).value));
    assert_true(isnan(metrics_rms(error, COUNT)));
    assert_true(isnan(metrics_spread(error, COUNT)));
  }
}

static void test_nothing_is_not_zero(void **state) {
  (void)state;
  assert_true(isnan(metrics_max(times, times, 0).value));
  assert_true(isnan(metrics_rms(times, 0)));
  assert_true(isnan(metrics_spread(times, 0)));
}

// Gates of two rules on the measurements given.
static gate_list judge(double lean, double steer, double limit) {
  measurement_list list = {0};
  measurement m = measurement_of("L2", "lean", "max", "rad");
  m.value = lean;
  measurement_add(&list, &m);
  m = measurement_of("L2", "steer", "max", "rad");
  m.value = steer;
  measurement_add(&list, &m);
  static gate_rule rule[2];
  rule[0] = (gate_rule){.layer = &layer_traces, .metric = "max", .limit = 1};
  rule[1] = (gate_rule){.layer = &layer_traces,
                        .metric = "max",
                        .limit = limit,
                        .signals = {"lean"},
                        .signal_count = 1};
  gate_rules rules = {.items = rule, .count = 2, .room = 2};
  gate_list gates = {0};
  assert_true(gates_judge(&gates, &list, &rules, 4));
  measurement_clear(&list);
  return gates;
}

static void test_last_rule_judges(void **state) {
  (void)state;
  gate_list gates = judge(0.5, 0.5, 0.25);
  assert_int_equal(gates.count, 2);
  assert_false(gates.items[0].pass);
  assert_near(gates.items[0].rule->limit, 0.25, 0);
  assert_true(gates.items[1].pass);
  gates_clear(&gates);
}

static void test_limits_are_inclusive_and_nan_fails(void **state) {
  (void)state;
  static const struct {
    double value, limit;
    bool pass;
  } cases[] = {{1e-11, 1e-11, true}, {1.0000001e-11, 1e-11, false}, {0, 0, true},
               {5e-324, 0, false},   {NAN, 1e300, false},           {INFINITY, 1e300, false}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    gate_list gates = judge(cases[i].value, 0, cases[i].limit);
    assert_int_equal(gates.items[0].pass, cases[i].pass);
    gates_clear(&gates);
  }
}

// A limit on something that nobody measured must not look like a success.
static void test_unmeasured_fails(void **state) {
  (void)state;
  measurement_list nothing = {0};
  gate_rule rule = {.layer = &layer_invariants,
                    .metric = "max",
                    .limit = 1,
                    .signals = {"rear_slip", "front_slip"},
                    .signal_count = 2};
  gate_rules rules = {.items = &rule, .count = 1, .room = 1};
  gate_list gates = {0};
  assert_true(gates_judge(&gates, &nothing, &rules, 5));
  assert_int_equal(gates.count, 2);
  assert_false(gates.items[0].pass || gates.items[1].pass);
  gates_clear(&gates);
  assert_true(gates_judge(&gates, &nothing, &rules, 4)); // L3 was not reached: nothing to say
  assert_int_equal(gates.count, 0);
  gates_clear(&gates);
}

static void test_trace(void **state) {
  (void)state;
  trace t = {0};
  for (int k = 0; k < 3000; k++) {
    trace_row row = {.sample = {.time = k, .lean = 0.5 * k}};
    assert_true(trace_add(&t, &row));
  }
  assert_near(trace_value(&t.rows[2999], trace_find_signal("lean")), 1499.5, 0);
  assert_int_equal(trace_first_not_finite(&t), -1);
  t.rows[5].sample.rear_friction = INFINITY; // a wheel that carries nothing
  assert_int_equal(trace_first_not_finite(&t), -1);
  t.rows[7].more.work = NAN;
  assert_int_equal(trace_first_not_finite(&t), 7);
  trace_clear(&t);
}

// A lift does not end a ride; what comes after it does.
static void test_trace_end(void **state) {
  (void)state;
  trace t = {0};
  const bike_event events[] = {{BIKE_EVENT_LEAN_LIMIT, 2}, {BIKE_EVENT_REAR_LIFT, 2}};
  trace_end(&t, false, 2, events, 2);
  assert_int_equal(t.end_event.kind, BIKE_EVENT_LEAN_LIMIT);
  assert_near(t.end_event.time, 2, 0);
}

// FIPS 180-4's examples, and lengths around the end of a block.
static void test_sha256(void **state) {
  (void)state;
  static const struct {
    const char *text, *hash;
  } cases[] = {
      {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
      {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
      {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
       "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
      {"abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqrlmn"
       "o"
       "pqrsmnopqrstnopqrstu",
       "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char hash[SHA256_HEX_SIZE];
    sha256_hex(hash, cases[i].text, strlen(cases[i].text));
    assert_string_equal(hash, cases[i].hash);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_peak_and_its_time),
      cmocka_unit_test(test_constant),
      cmocka_unit_test(test_growth_is_divided_out),
      cmocka_unit_test(test_nan_is_never_lost),
      cmocka_unit_test(test_nothing_is_not_zero),
      cmocka_unit_test(test_last_rule_judges),
      cmocka_unit_test(test_limits_are_inclusive_and_nan_fails),
      cmocka_unit_test(test_unmeasured_fails),
      cmocka_unit_test(test_trace),
      cmocka_unit_test(test_trace_end),
      cmocka_unit_test(test_sha256),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
