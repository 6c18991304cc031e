// SPDX-License-Identifier: Apache-2.0
// Convergence, linear modes, horizon, tube and cost.
#include "support/near.h"
#include "validate_support.h"

#include <bicycle/error.h>
#include <bicycle/variant.h>
#include <metrics.h>
#include <modes.h>
#include <report.h>
#include <report_json_layers.h>
#include <richardson.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

//---------------------------------- Richardson ----------------------------------------------------

// Terms h^p, h^(p+1), h^(p+2) vanish, the limit stays; one more term does not.
static void test_weights_remove_terms(void **state) {
  (void)state;
  static const double step[4] = {0.01, 0.005, 0.0025, 0.002};
  for (int p = 1; p <= 4; p++) {
    double w[4];
    assert_true(richardson_weights(w, step, 4, p));
    for (int term = -1; term < 4; term++) {
      double sum = 0;
      for (int i = 0; i < 4; i++) sum += w[i] * (term < 0 ? 1 : pow(step[i] / step[0], p + term));
      assert_near(sum, term < 0 ? 1 : 0, term < 3 ? 1e-12 : 1);
      if (term == 3) assert_true(fabs(sum) > 1e-6);
    }
  }
  double w[4];
  static const double twice[4] = {0.01, 0.01, 0.005, 0.0025};
  assert_false(richardson_weights(w, twice, 4, 1));
  assert_false(richardson_weights(w, step, 4, NAN));
  assert_false(richardson_weights(w, step, 9, 1));
}

static void test_order(void **state) {
  (void)state;
  double step[5], error[5], order, scatter;
  for (int i = 0; i < 5; i++) {
    step[i] = 0.01 / (1 << i);
    error[i] = 3 * pow(step[i], 2.5);
  }
  richardson_order(&order, &scatter, step, error, 5);
  assert_near(order, 2.5, 1e-12);
  assert_near(scatter, 0, 1e-12);
  error[2] = 0;
  richardson_order(&order, &scatter, step, error, 5);
  assert_true(isnan(order));
}

//---------------------------------- L4 ------------------------------------------------------------

static const char conv_text[] =
    "title: convergence\nbicycle: benchmark\nstart: {speed: 5, lean_rate: 0.5}\nduration: 2\n"
    "sample: 0.02\ninstants: {count: 0}\nreference: {engine: analytic}\n"
    "candidate: {engine: mujoco, %s}\n"
    "convergence: {timesteps: [%s], tolerance: %s}\n"
    "gates:\n  - {layer: L4, metric: order_error, limit: 0.2, reason: test}\n";

static support_run *play_convergence(const char *options, const char *steps,
                                     const char *tolerance) {
  char text[900];
  snprintf(text, sizeof text, conv_text, options, steps, tolerance);
  support_run *f = support_open(NULL, text);
  support_play(f);
  return f;
}

static void check_order(const char *options, const char *steps, double low, double high,
                        double plateau) {
  support_run *f = play_convergence(options, steps, "1e-11");
  const study_convergence *c = &f->comparison.study.convergence;
  for (int s = 0; s < STUDY_SIGNALS; s++) {
    assert_true(c->signal[s].order >= low && c->signal[s].order <= high);
    assert_below(c->signal[s].plateau, plateau);
  }
  assert_int_equal(c->verdict, STUDY_SAME);
  assert_string_equal(f->comparison.cause, "");
  support_close(f);
}

static void test_orders(void **state) {
  (void)state;
  check_order("root: hinge", "1e-2, 5e-3, 2.5e-3, 1.25e-3", 3.8, 4.2, 1e-11);
  check_order("root: free", "1e-2, 5e-3, 2.5e-3, 2e-3, 1.25e-3", 1.8, 2.2, 1e-11);
  check_order("integrator: euler", "1e-2, 5e-3, 4e-3, 2.5e-3, 2e-3, 1.25e-3", 0.8, 1.2, 1e-9);
}

static void test_contact_is_another_model(void **state) {
  (void)state;
  double plateau[2];
  static const char *const options[2] = {"rolling: contact, integrator: implicit, solref: 0.02",
                                         "rolling: contact, integrator: implicit, solref: 0.01"};
  for (int i = 0; i < 2; i++) {
    support_run *f = play_convergence(options[i], "1e-3, 5e-4, 2.5e-4, 2e-4", "1e-6");
    const study_convergence *c = &f->comparison.study.convergence;
    assert_int_equal(c->verdict, STUDY_DIFFERENT);
    for (int s = 0; s < STUDY_SIGNALS; s++) {
      assert_true(c->signal[s].plateau > 1e-6);
      assert_true(c->signal[s].plateau > 3 * c->signal[s].uncertainty);
      assert_below(fabs(c->signal[s].order), 0.2);
    }
    support_expect_failure(&f->comparison, "L4", "different model");
    plateau[i] = c->signal[0].plateau;
    support_close(f);
  }
  assert_near(plateau[1] / plateau[0], 0.5, 0.1); // it falls with solref
}

// Refused on reading.
static void expect_refusal(const char *text, const char *says) {
  problem p = {""};
  scenario s;
  char *folder = support_folder(), *path = support_write(folder, "test.yml", text);
  assert_int_equal(scenario_read(&s, path, &p), TERM_USAGE);
  if (!strstr(p.text, says)) fail_msg("'%s' does not say '%s'", p.text, says);
  free(path);
  support_remove(folder);
}

static void test_convergence_refusals(void **state) {
  (void)state;
  char text[900];
  snprintf(text, sizeof text, conv_text, "integrator: cvode", "4e-3, 2e-3, 1e-3, 5e-4", "1e-11");
  expect_refusal(text, "convergence: the engine 'mujoco' chooses its steps itself");
  char *recorded = support_replace(text, "engine: mujoco, integrator: cvode", "engine: linear");
  expect_refusal(recorded, "convergence: the engine 'linear' chooses its steps itself");
  free(recorded);
  snprintf(text, sizeof text, conv_text, "root: hinge", "3e-2, 2e-3, 1e-3, 5e-4", "1e-11");
  problem p = {""};
  support_run *f = support_open(NULL, text);
  assert_int_equal(comparison_run(&f->comparison, &p), TERM_USAGE);
  if (!strstr(p.text, "timestep 0.03 s")) fail_msg("%s", p.text);
  support_close(f);
}

//---------------------------------- L1, L5 --------------------------------------------------------

static void test_modes(void **state) {
  (void)state;
  support_run *f = support_open(
      NULL, "title: modes\nbicycle: benchmark\nstart: {speed: 5}\nduration: 0.1\nsample: 0.1\n"
            "instants: {count: 0}\nreference: {engine: linear}\ncandidate: {engine: mujoco}\n"
            "linear: {speeds: [0, 10], count: 11}\n"
            "gates:\n  - {layer: L1, metric: relative, limit: 1e-8, reason: test}\n");
  comparison *c = support_play(f);
  assert_string_equal(c->cause, "");
  const study_linear *l = &c->study.linear;
  // Meijaard et al. (2007): weave and capsize speed of the benchmark
  for (int side = 0; side < 2; side++) {
    assert_int_equal(l->speed[side].weave_count, 1);
    assert_int_equal(l->speed[side].capsize_count, 1);
    assert_near(l->speed[side].weave[0], 4.29238253634111, 1e-9);
    assert_near(l->speed[side].capsize[0], 6.02426201538837, 1e-9);
  }
  support_close(f);
}

// A trail as long as the wheelbase brings a singular steer so near that it limits the differences.
static void test_modes_of_a_long_trail(void **state) {
  (void)state;
  support_run *f = calloc(1, sizeof *f);
  assert_non_null(f);
  f->folder = support_folder();
  support_read_scenario(
      &f->scenario, f->folder,
      "title: modes\nbicycle: roadster\nstart: {speed: 5}\nduration: 0.1\nsample: 0.1\n"
      "instants: {count: 0}\nreference: {engine: analytic}\ncandidate: {engine: mujoco}\n"
      "linear: {speeds: [1, 8], count: 8}\n"
      "gates:\n  - {layer: L1, metric: relative, limit: 1e-8, reason: test}\n");
  bike_bicycle shipped = f->scenario.bicycle;
  problem p = {""};
  assert_int_equal(
      bike_vary(&f->scenario.bicycle, &shipped, BIKE_VARY_TRAIL, 1.11, BIKE_FRONT_IN_SPACE),
      BIKE_OK);
  assert_int_equal(comparison_open(&f->comparison, &f->scenario, &p), TERM_DONE);
  assert_string_equal(support_play(f)->cause, "");
  support_close(f);
}

static void test_modes_are_matched(void **state) {
  (void)state;
  const bike_eigenvalues a = {{1, 0.5, 0.5, -3}, {0, 2, -2, 0}};
  bike_eigenvalues b = {{0.5, 1, -3, 0.5}, {-2, 0, 0, 2}};
  assert_near(modes_difference(&a, &b), 0, 0);
  b.re[1] += 1e-9;
  assert_near(modes_difference(&a, &b), 1e-9, 1e-15);
  b.im[2] = NAN;
  assert_true(isnan(modes_difference(&a, &b)));
}

static void test_horizon(void **state) {
  (void)state;
  support_run *f = support_open(
      NULL, "title: horizon\nbicycle: benchmark\nstart: {speed: 2, lean_rate: 1e-6}\nduration: 6\n"
            "sample: 0.01\ninstants: {count: 0}\nreference: {engine: analytic}\n"
            "candidate: {engine: mujoco}\nhorizon: {share: 0.1}\n"
            "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 1e-11, reason: test}\n");
  comparison *c = support_play(f);
  const study_horizon *h = &c->study.horizon;
  assert_string_equal(c->cause, "");
  // 2.2e-16 exp(2.68 t) = 1e-12 at 3.1 s, the other modes aside
  assert_near(h->time, 3.3, 0.6);
  assert_near(h->exponent, h->eigenvalue, 0.15);
  assert_string_equal(h->signal, "lean");
  // What is not judged is told, and is much larger than the limit.
  assert_true(support_find(c, "L2", "lean", "beyond_horizon")->value > 1e-11);
  assert_below(support_find(c, "L2", "lean", "max")->value, 1e-11);
  support_close(f);
}

static void test_horizon_needs_a_limit(void **state) {
  (void)state;
  static const char *const gates[] = {
      "{layer: L2, metric: rmse, limit: 1, reason: test}",
      "{layer: L2, metric: max, signals: [rear_force], limit: 1, reason: not of a signal}",
      "{layer: L2, metric: max, limit: 1, reason: r}\n"
      "  - {layer: L2, metric: max, info: true, reason: takes its place}\n"
      "  - {layer: L2, metric: rmse, limit: 1, reason: test}"};
  for (size_t i = 0; i < sizeof gates / sizeof *gates; i++) {
    char text[900];
    snprintf(text, sizeof text,
             "title: x\nbicycle: benchmark\nstart: {speed: 5}\nduration: 0.1\nsample: 0.1\n"
             "instants: {count: 0}\nreference: {engine: analytic}\ncandidate: {engine: linear}\n"
             "horizon: {share: 0.1}\ngates:\n  - %s\n",
             gates[i]);
    expect_refusal(text, ":9: horizon: no gate limits 'max' of a signal of layer L2");
  }
}

//---------------------------------- tube, cost ----------------------------------------------------

// A ride that is late leaves the difference, but not the tube that is as wide in time.
static void test_tube(void **state) {
  (void)state;
  enum { COUNT = 400 };
  double time[COUNT], is[COUNT], has[COUNT], off[COUNT];
  for (int k = 0; k < COUNT; k++) {
    time[k] = 0.01 * k;
    is[k] = sin(3 * time[k]);
    has[k] = sin(3 * (time[k] - 0.015));
    off[k] = has[k] - is[k];
  }
  assert_near(metrics_tube(time, is, has, COUNT, 0).value, metrics_max(time, off, COUNT).value, 0);
  // Before the first row there is no reference to be late of.
  has[0] = is[0], has[1] = is[1];
  // A peak may fall between two rows: 3^2 0.005^2/2 of it are not seen.
  assert_below(metrics_tube(time, is, has, COUNT, 0.02).value, 1.2e-4);
  has[200] += 0.5;
  metrics_peak peak = metrics_tube(time, is, has, COUNT, 0.02);
  assert_near(peak.value, 0.45, 0.1); // less what the slope allows: 3 * 0.02 and the delay
  assert_near(peak.time, 2, 1e-12);
  has[100] = NAN;
  assert_true(isnan(metrics_tube(time, is, has, COUNT, 0.02).value));
}

// It is a metric of L2 where a rule asks for it, with the rule's own width in time.
static void test_tube_gate(void **state) {
  (void)state;
  support_run *f = support_open(
      NULL, "title: tube\nbicycle: benchmark\nstart: {speed: 5, lean_rate: 0.1}\nduration: 1\n"
            "sample: 0.01\ninstants: {count: 0}\nreference: {engine: analytic}\n"
            "candidate: {engine: mujoco, integrator: euler}\ngates:\n"
            "  - {layer: L2, metric: tube, signals: [lean], limit: 1e-3, time_tolerance: 0.02,"
            " reason: test}\n");
  comparison *c = support_play(f);
  assert_string_equal(c->cause, "");
  assert_true(support_find(c, "L2", "lean", "tube")->value <
              support_find(c, "L2", "lean", "max")->value);
  support_close(f);
}

static void test_cost(void **state) {
  (void)state;
  support_run *f = support_open(
      NULL, "title: cost\nbicycle: benchmark\nstart: {speed: 5, lean_rate: 0.1}\nduration: 0.5\n"
            "sample: 0.25\ninstants: {count: 0}\nreference: {engine: analytic}\n"
            "candidate: {engine: mujoco}\ncost: {repeats: 3}\n"
            "gates:\n  - {layer: L2, metric: max, signals: [lean], limit: 1, reason: test}\n");
  comparison *c = support_play(f);
  const study_cost *cost = &c->study.cost;
  assert_int_equal(cost->count, 6); // both as asked, and four tolerances of the analytic engine
  for (int i = 0; i < cost->count; i++) {
    assert_true(cost->run[i].low <= cost->run[i].median);
    assert_true(cost->run[i].median <= cost->run[i].high);
    assert_true(cost->run[i].evaluations > 0);
  }
  assert_int_equal(cost->run[1].steps, 500);
  assert_int_equal(cost->run[1].evaluations, 2000);
  // rtol 1e-6 against 1e-12, with samples so far apart that they do not keep the steps short
  assert_true(cost->run[2].error > 10 * cost->run[5].error);
  assert_true(cost->run[2].evaluations < cost->run[5].evaluations);
  json_t *object = json_object(), *timings = json_object();
  report_add_layers(object, c);
  report_add_timings(timings, c);
  assert_int_equal(json_array_size(json_object_get(object, "cost")), 2);
  assert_int_equal(json_array_size(json_object_get(timings, "cost")), 6);
  json_decref(object);
  json_decref(timings);
  support_close(f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_weights_remove_terms),
      cmocka_unit_test(test_order),
      cmocka_unit_test(test_orders),
      cmocka_unit_test(test_contact_is_another_model),
      cmocka_unit_test(test_convergence_refusals),
      cmocka_unit_test(test_modes),
      cmocka_unit_test(test_modes_of_a_long_trail),
      cmocka_unit_test(test_modes_are_matched),
      cmocka_unit_test(test_horizon),
      cmocka_unit_test(test_horizon_needs_a_limit),
      cmocka_unit_test(test_tube),
      cmocka_unit_test(test_tube_gate),
      cmocka_unit_test(test_cost),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
