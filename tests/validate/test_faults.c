// SPDX-License-Identifier: Apache-2.0
// Faults put in on purpose: the comparator must fail, in the right layer, and name the quantity.
#include "support/near.h"
#include "validate_support.h"

#include <engine_mujoco.h>
#include <layer.h>
#include <stdio.h>
#include <string.h>

static mjModel *model_of(support_run *f) {
  return runner_model(engine_mujoco_runner(f->comparison.side[CANDIDATE].instance));
}

static void test_wrong_mass_is_named(void **state) {
  (void)state;
  support_run *f = support_open(NULL, support_scenario_text);
  mjModel *m = model_of(f);
  m->body_mass[mj_name2id(m, mjOBJ_BODY, "front_frame")] *= 1 + 1e-9;
  support_expect_failure(support_play(f), "Lp", "front frame mass");
  support_close(f);
}

static void test_wrong_trail_is_named(void **state) {
  (void)state;
  support_run *f = support_open(NULL, support_scenario_text);
  mjModel *m = model_of(f);
  // Forward across the axis: the front contact moves with the hub, so the trail is shorter.
  m->body_pos[3 * mj_name2id(m, mjOBJ_BODY, "front_wheel")] += 1e-3;
  comparison *c = support_play(f);
  assert_string_equal(c->first_failure->name, "Lp");
  assert_near(support_find(c, "Lp", "mujoco.trail", "relative")->value, 1e-3 / 1.02, 5e-4);
  assert_true(strstr(support_find(c, "Lp", "mujoco.trail", "relative")->detail, "against 0.08 m"));
  support_close(f);
}

static void test_wrong_product_of_inertia_is_named(void **state) {
  (void)state;
  support_run *f = support_open(NULL, support_scenario_text);
  mjModel *m = model_of(f);
  int body = mj_name2id(m, mjOBJ_BODY, "front_frame");
  // A tensor mirrored in x changes the sign of Ixz (and Ixy, here zero).
  m->body_iquat[4 * body + 2] *= -1;
  m->body_iquat[4 * body + 3] *= -1;
  m->body_iquat[4 * body + 1] *= 1;
  comparison *c = support_play(f);
  assert_string_equal(c->first_failure->name, "Lp");
  assert_false(support_find(c, "Lp", "mujoco.front_frame_Ixz", "relative")->value <= 1e-12);
  support_close(f);
}

static void test_wrong_damping_is_named(void **state) {
  (void)state;
  support_run *f = support_open(NULL, support_scenario_text);
  mjModel *m = model_of(f);
  m->dof_damping[m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, "steer")]] = 1e-6;
  support_expect_failure(support_play(f), "Lp", "steer damping");
  support_close(f);
}

// An engine whose wheels feel one part in a million too much.
static term_exit evaluate_wrong(engine_instant *out, void *instance, const bike_state *state,
                                problem *p) {
  term_exit code = engine_mujoco.evaluate(out, instance, state, p);
  out->steer_acceleration *= 1 + 1e-6;
  return code;
}

static void test_wrong_acceleration_is_L0(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.evaluate = evaluate_wrong;
  support_expect_fault(&wrong, support_scenario_text, "L0", "steer acceleration");
}

// An engine that moves one part in a hundred million too heavily where lean and speed are coupled.
static term_exit mass_wrong(double M[9], void *instance, const bike_state *state, problem *p) {
  term_exit code = engine_mujoco.mass_matrix(M, instance, state, p);
  M[2] += 1e-8 * sqrt(M[0] * M[8]);
  return code;
}

static term_exit mass_nan(double M[9], void *instance, const bike_state *state, problem *p) {
  term_exit code = engine_mujoco.mass_matrix(M, instance, state, p);
  if (state->speed == 4.6) M[4] = NAN; // at the first state only
  return code;
}

static term_exit mass_never(double M[9], void *instance, const bike_state *state, problem *p) {
  (void)M;
  (void)instance;
  (void)state;
  return problem_set(p, TERM_USAGE, "no such masses");
}

static void test_wrong_mass_matrix_is_L0(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.mass_matrix = mass_wrong;
  support_expect_fault(&wrong, support_scenario_text, "L0", "mass matrix");
  wrong.mass_matrix = mass_nan;
  support_expect_fault(&wrong, support_scenario_text, "L0", "mass matrix");
  wrong.mass_matrix = mass_never;
  support_expect_fault(&wrong, support_scenario_text, "L0", "no such masses");
}

// Of engines that agree it differs by rounding, whatever the root and whatever keeps the wheels on
// the ground.
static void test_mass_matrix_agrees(void **state) {
  (void)state;
  static const char *const options[] = {"", ", root: free", ", rolling: contact"};
  for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
    char text[512];
    snprintf(text, sizeof text,
             "title: t\nbicycle: benchmark\nstart: {speed: 5}\nduration: 0.01\nsample: 0.01\n"
             "reference: {engine: analytic}\ncandidate: {engine: mujoco%s}\ngates:\n"
             "  - {layer: L0, metric: relative, signals: [mass_matrix], limit: 1e-10, reason: r}\n",
             options[i]);
    support_run *f = support_open(NULL, text);
    double error = support_find(support_play(f), "L0", "mass_matrix", "relative")->value;
    assert_true(error <= 1e-10);
    support_close(f);
  }
}

static term_exit evaluate_never(engine_instant *out, void *instance, const bike_state *state,
                                problem *p) {
  (void)out;
  (void)instance;
  (void)state;
  return problem_set(p, TERM_USAGE, "no such place");
}

static void test_refused_state_is_L0(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.evaluate = evaluate_never;
  support_expect_fault(&wrong, support_scenario_text, "L0", "no such place");
}

static term_exit evaluate_nan(engine_instant *out, void *instance, const bike_state *state,
                              problem *p) {
  term_exit code = engine_mujoco.evaluate(out, instance, state, p);
  if (state->speed == 4.6) out->force[1][1] = NAN; // at the first state only
  return code;
}

static void test_nan_at_one_instant_fails(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.evaluate = evaluate_nan;
  support_expect_fault(&wrong, support_scenario_text, "L0", "front force");
}

static term_exit ride_from_elsewhere(trace *out, void *instance, const engine_ride *asked,
                                     problem *p) {
  engine_ride other = *asked;
  other.start.lean_rate += 1e-9;
  return engine_mujoco.ride(out, instance, &other, p);
}

static void test_wrong_start_is_L2(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.ride = ride_from_elsewhere;
  support_run *f = support_open(&wrong, support_scenario_text);
  comparison *c = support_play(f);
  support_expect_failure(c, "L2", "steer");
  assert_near(support_find(c, "L2", "lean_rate", "max")->value, 1e-9, 1e-9);
  assert_int_equal(verdict_exit(c->verdict), TERM_FAILED);
  support_close(f);
}

static term_exit ride_and_gain_energy(trace *out, void *instance, const engine_ride *asked,
                                      problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  if (out->count > 20) out->rows[20].sample.energy *= 1 + 1e-9;
  return code;
}

static void test_lost_energy_is_L3(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.ride = ride_and_gain_energy;
  support_run *f = support_open(&wrong, support_scenario_text);
  comparison *c = support_play(f);
  support_expect_failure(c, "L3", "mujoco.energy");
  assert_near(support_find(c, "L3", "mujoco.energy", "balance_max")->value, 1e-9, 1e-13);
  assert_near(support_find(c, "L3", "mujoco.energy", "balance_max")->time, 0.2, 1e-12);
  assert_near(support_find(c, "L3", "mujoco.energy", "spread_percent")->value, 1e-7, 1e-11);
  support_close(f);
}

static void test_stolen_callback_is_invalid(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.ride = support_robbed_ride;
  support_run *f = support_open(&wrong, support_scenario_text);
  comparison *c = support_play(f);
  assert_int_equal(c->verdict, VERDICT_INVALID);
  assert_int_equal(verdict_exit(c->verdict), TERM_INVALID);
  assert_string_equal(c->first_failure->name, "L2");
  assert_non_null(strstr(c->cause, "mjcb_control"));
  assert_true(c->gates.count > 40); // Lp and L0 are judged all the same
  assert_int_equal(support_failed_gates(&c->gates),
                   0); // and L3, not reached, is not held against anyone
  support_close(f);
}

static term_exit ride_into_nan(trace *out, void *instance, const engine_ride *asked, problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  if (out->count > 30) out->rows[30].sample.steer = NAN;
  return code;
}

static void test_nan_in_a_ride_is_invalid(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.ride = ride_into_nan;
  support_run *f = support_open(&wrong, support_scenario_text);
  comparison *c = support_play(f);
  assert_int_equal(c->verdict, VERDICT_INVALID);
  assert_non_null(strstr(c->cause, "0.3 s"));
  support_close(f);
}

static term_exit ride_and_fall(trace *out, void *instance, const engine_ride *asked, problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  const bike_event fall = {BIKE_EVENT_LEAN_LIMIT, 0.305};
  out->count = 31;
  trace_end(out, false, 0.305, &fall, 1);
  return code;
}

static void test_early_end_is_named(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.ride = ride_and_fall;
  support_run *f = support_open(&wrong, support_scenario_text);
  comparison *c = support_play(f);
  support_expect_failure(c, "L2", "0.305 s");
  assert_non_null(strstr(c->cause, "end time"));
  support_close(f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_wrong_mass_is_named),
      cmocka_unit_test(test_wrong_trail_is_named),
      cmocka_unit_test(test_wrong_product_of_inertia_is_named),
      cmocka_unit_test(test_wrong_damping_is_named),
      cmocka_unit_test(test_wrong_acceleration_is_L0),
      cmocka_unit_test(test_wrong_mass_matrix_is_L0),
      cmocka_unit_test(test_mass_matrix_agrees),
      cmocka_unit_test(test_refused_state_is_L0),
      cmocka_unit_test(test_nan_at_one_instant_fails),
      cmocka_unit_test(test_wrong_start_is_L2),
      cmocka_unit_test(test_lost_energy_is_L3),
      cmocka_unit_test(test_stolen_callback_is_invalid),
      cmocka_unit_test(test_nan_in_a_ride_is_invalid),
      cmocka_unit_test(test_early_end_is_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
