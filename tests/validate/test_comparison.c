// SPDX-License-Identifier: Apache-2.0
// Comparisons that agree, end early, grow, and pair other engines.
#include "support/near.h"
#include "validate_support.h"

#include <string.h>

static void test_agreement(void **state) {
  (void)state;
  support_run *f = support_open(NULL, support_scenario_text);
  comparison *c = support_play(f);
  assert_string_equal(c->cause, "");
  assert_int_equal(c->verdict, VERDICT_AGREE);
  assert_null(c->first_failure);
  assert_int_equal(c->side[REFERENCE].trace.count, 51);
  assert_int_equal(c->side[CANDIDATE].trace.count, 51);
  assert_int_equal(verdict_exit(c->verdict), TERM_DONE);
  support_close(f);
}

static const char fall_text[] =
    "title: fall\nbicycle: benchmark\nstart: {speed: 0.5, lean: 0.3}\nduration: 5\n"
    "sample: 0.01\nreference: {engine: analytic}\ncandidate: {engine: mujoco}\n"
    "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 1e-6, reason: test}\n";

// Both fall over, at the same time.
static void test_same_end_agrees(void **state) {
  (void)state;
  support_run *f = support_open(NULL, fall_text);
  comparison *c = support_play(f);
  assert_string_equal(c->cause, "");
  assert_false(c->side[REFERENCE].trace.complete);
  assert_false(c->side[CANDIDATE].trace.complete);
  assert_below(support_find(c, "L2", "end_time", "difference")->value, 1e-3);
  support_close(f);
}

static term_exit ride_and_fall_late(trace *out, void *instance, const engine_ride *asked,
                                    problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  out->end_event.time += 0.005;
  return code;
}

static void test_later_end_is_named(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.ride = ride_and_fall_late;
  support_run *f = support_open(&wrong, fall_text);
  comparison *c = support_play(f);
  support_expect_failure(c, "L2", "end time");
  assert_near(support_find(c, "L2", "end_time", "difference")->value, 0.005, 1e-3);
  support_close(f);
}

// What a damper takes is not missing from the balance, but from the energy.
static void test_work_is_balanced(void **state) {
  (void)state;
  support_run *f =
      support_open(NULL, "title: damper\nbicycle: recumbent_damped\n"
                         "start: {speed: 13, lean_rate: 0.1}\nduration: 1\nsample: 0.01\n"
                         "reference: {engine: analytic}\ncandidate: {engine: mujoco}\n"
                         "gates:\n  - {layer: L3, metric: balance_max, limit: 1e-12,"
                         " reason: test}\n");
  comparison *c = support_play(f);
  assert_string_equal(c->cause, "");
  // The spread is a percentage: without the work, the balance would be off by 1e-8 and more.
  assert_true(support_find(c, "L3", "mujoco.energy", "spread_percent")->value > 1e-6);
  assert_true(support_find(c, "L3", "analytic.energy", "spread_percent")->value > 1e-6);
  support_close(f);
}

// Engines of the same kind are told apart, and a coarse step shows.
static void test_other_engines(void **state) {
  (void)state;
  support_run *f =
      support_open(NULL, "title: steps\nbicycle: benchmark\n"
                         "start: {speed: 4.6, lean_rate: 0.5}\nduration: 1\nsample: 0.01\n"
                         "instants: {count: 0}\n"
                         "reference: {engine: mujoco, timestep: 1e-3}\n"
                         "candidate: {engine: mujoco, timestep: 1e-2}\n"
                         "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 1e-11,"
                         " reason: test}\n");
  comparison *c = support_play(f);
  assert_string_equal(c->side[REFERENCE].label, "reference");
  assert_string_equal(c->side[CANDIDATE].label, "candidate");
  support_expect_failure(c, "L2", "lean");
  assert_below(support_find(c, "L2", "lean", "max")->value, 1e-6);
  support_close(f);
}

// States at which a ride would end are not compared: engines may say anything of a bicycle that
// lies flat, and rounding is a thousandfold at the geometry's edge.
static void test_instants_are_rideable(void **state) {
  (void)state;
  static const char *const wide[] = {
      // leans far
      "title: wide\nbicycle: recumbent\nstart: {speed: 3}\nduration: 0.01\nsample: 0.01\n"
      "instants: {count: 400, lean: 1.5707, steer: 3.1}\n"
      "reference: {engine: analytic}\ncandidate: {engine: mujoco}\n"
      "gates:\n  - {layer: L0, metric: relative, limit: 1e-8, reason: test}\n",
      // comes close to the edge
      "title: wide\nbicycle: penny_farthing\nstart: {speed: 3}\nduration: 0.01\nsample: 0.01\n"
      "instants: {count: 400, seed: 4, lean: 1.56, steer: 3.1}\n"
      "reference: {engine: analytic}\ncandidate: {engine: mujoco}\n"
      "gates:\n  - {layer: L0, metric: relative, limit: 1e-8, reason: test}\n"};
  for (int i = 0; i < 2; i++) {
    support_run *f = support_open(NULL, wide[i]);
    comparison *c = support_play(f);
    assert_string_equal(c->cause, "");
    assert_int_equal(c->verdict, VERDICT_AGREE);
    support_close(f);
  }
}

static void test_growth(void **state) {
  (void)state;
  support_run *f =
      support_open(NULL, "title: grow\nbicycle: benchmark\n"
                         "start: {speed: 4, lean_rate: 0.05}\nduration: 1\nsample: 0.01\n"
                         "growth: unstable-mode\n"
                         "reference: {engine: analytic}\ncandidate: {engine: mujoco}\n"
                         "gates:\n  - {layer: L2, metric: scaled_max, signals: [lean],"
                         " limit: 1e-11, reason: test}\n");
  // Meijaard et al. (2007), table 2: weave at 4 m/s
  assert_near(f->comparison.growth_rate, 0.41325331521125, 1e-12);
  comparison *c = support_play(f);
  assert_int_equal(c->verdict, VERDICT_AGREE);
  assert_true(support_find(c, "L2", "lean", "scaled_max")->value <
              support_find(c, "L2", "lean", "max")->value);
  support_close(f);
}

static void test_impossible_start_is_usage(void **state) {
  (void)state;
  problem p = {""};
  support_run *f =
      support_open(NULL, "title: lying\nbicycle: benchmark\n"
                         "start: {speed: 4, steer: 1.6, lean: 1.39}\nduration: 1\nsample: 0.1\n"
                         "reference: {engine: analytic}\ncandidate: {engine: mujoco}\n"
                         "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 1,"
                         " reason: test}\n");
  assert_int_equal(comparison_run(&f->comparison, &p), TERM_USAGE);
  // The reason stands once, behind its prefixes.
  const char *start = strstr(p.text, "start: ");
  assert_non_null(start);
  assert_non_null(strstr(start, "geometry"));
  assert_null(strstr(start + 1, "start: "));
  support_close(f);
}

static term_exit evaluate_with_more_force(engine_instant *out, void *instance, const bike_state *at,
                                          problem *p) {
  term_exit code = engine_mujoco.evaluate(out, instance, at, p);
  for (int k = 0; k < 3; k++) out->force[0][k] *= 1 + 1e-6;
  return code;
}

// A force of many times the weight errs by its own size, not by that of the weight.
static void test_large_forces_are_relative(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.evaluate = evaluate_with_more_force;
  support_run *f = support_open(&wrong, "title: fast\nbicycle: benchmark\n"
                                        "start: {speed: 100, lean: 0.1, steer: 0.3}\n"
                                        "duration: 0.01\nsample: 0.01\ninstants: {count: 0}\n"
                                        "reference: {engine: analytic}\n"
                                        "candidate: {engine: mujoco}\ngates:\n"
                                        "  - {layer: L0, metric: relative, limit: 1, reason: t}\n");
  comparison *c = support_play(f);
  assert_near(support_find(c, "L0", "rear_force", "relative")->value, 1e-6, 1e-9);
  support_close(f);
}

static void test_problem_of_itself(void **state) {
  (void)state;
  problem p;
  problem_set(&p, TERM_USAGE, "%s", "reason");
  assert_int_equal(problem_set(&p, TERM_USAGE, "start: %s, %s", p.text, p.text), TERM_USAGE);
  assert_string_equal(p.text, "start: reason, reason");
}

static term_exit ride_to_another_end(trace *out, void *instance, const engine_ride *asked,
                                     problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  out->end_event.kind = BIKE_EVENT_LEAN_LIMIT;
  out->end_time = out->end_event.time -= 0.25;
  return code;
}

// Rides that end differently differ by a time, and of earlier layers nothing is said that no gate
// has asked.
static void test_another_end_is_a_number(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.ride = ride_to_another_end;
  support_run *f = support_open(&wrong, fall_text);
  comparison *c = support_play(f);
  support_expect_failure(c, "L2", "end time");
  support_expect_failure(c, "L2", "lean limit");
  assert_near(support_find(c, "L2", "end_time", "difference")->value, 0.25, 1e-3);
  if (strstr(c->cause, "agree")) fail_msg("nobody has asked: %s", c->cause);
  support_close(f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_agreement),
      cmocka_unit_test(test_instants_are_rideable),
      cmocka_unit_test(test_same_end_agrees),
      cmocka_unit_test(test_later_end_is_named),
      cmocka_unit_test(test_another_end_is_a_number),
      cmocka_unit_test(test_large_forces_are_relative),
      cmocka_unit_test(test_problem_of_itself),
      cmocka_unit_test(test_work_is_balanced),
      cmocka_unit_test(test_other_engines),
      cmocka_unit_test(test_growth),
      cmocka_unit_test(test_impossible_start_is_usage),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
