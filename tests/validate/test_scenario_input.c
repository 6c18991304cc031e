// SPDX-License-Identifier: Apache-2.0
// What acts on the bicycle in a scenario: both engines get it, reports tell of it, and wrong files
// are refused before anything is ridden.
#include "support/near.h"
#include "validate_support.h"

#include <baseline.h>
#include <math.h>
#include <report.h>
#include <stdlib.h>
#include <string.h>

static const char ridden[] =
    "title: input\nbicycle: roadster\nstart: {speed: 6}\nduration: 1\nsample: 0.01\n"
    "reference: {engine: analytic}\ncandidate: {engine: mujoco}\ninstants: {count: 5}\n"
    "gates:\n  - {layer: Lp, metric: relative, limit: 1e-12, reason: test}\n"
    "  - {layer: L0, metric: relative, limit: 1e-9, reason: test}\n"
    "  - {layer: L2, metric: max, signals: [lean, steer], limit: 1e-11, reason: test}\n"
    "  - {layer: L3, metric: balance_max, signals: [energy], limit: 1e-12, reason: test}\n";

// Plays with keys added before the gates, and a file "in.csv" beside; `candidate` as support_open.
static support_run *play(const engine *candidate, const char *keys, const char *csv) {
  char with[512];
  snprintf(with, sizeof with, "%s\ngates:", keys);
  char *text = support_replace(ridden, "gates:", with);
  support_run *run = calloc(1, sizeof *run);
  problem p = {""};
  assert_non_null(run);
  run->folder = support_folder();
  if (csv) free(support_write(run->folder, "in.csv", csv));
  support_read_scenario(&run->scenario, run->folder, text);
  if (candidate) run->scenario.candidate.engine = candidate;
  assert_int_equal(comparison_open(&run->comparison, &run->scenario, &p), TERM_DONE);
  support_play(run);
  free(text);
  return run;
}

static const char sway[] = "time,rider_offset,steer_torque\n0,0,0\n0.25,0.01,0.1\n0.5,0.015,0.3\n"
                           "0.75,0.01,0\n1,0,0\n";

// The largest |lean| of a side: zero where nothing acted.
static double most_lean(const comparison *c, int side) {
  double most = 0;
  for (size_t k = 0; k < c->side[side].trace.count; k++)
    most = fmax(most, fabs(c->side[side].trace.rows[k].sample.lean));
  return most;
}

static void test_inputs_act_on_both(void **state) {
  (void)state;
  static const struct {
    const char *keys, *csv;
  } cases[] = {{"steer_torque: 0.3", NULL},
               {"roll_torque: -2", NULL},
               {"steer_torque: 0.2\nroll_torque: 1", NULL},
               {"input: in.csv", sway},
               {"rider_offset: 0.01\ninput: in.csv", sway}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    support_run *run = play(NULL, cases[i].keys, cases[i].csv);
    const comparison *c = &run->comparison;
    assert_string_equal(c->cause, "");
    assert_true(most_lean(c, REFERENCE) > 1e-3 && most_lean(c, CANDIDATE) > 1e-3);
    const trace *t = &c->side[CANDIDATE].trace;
    assert_true(fabs(t->rows[t->count - 1].more.work) > 1e-6);
    support_close(run);
  }
}

static term_exit ride_hands_off(trace *out, void *instance, const engine_ride *asked, problem *p) {
  engine_ride still = *asked;
  still.input = NULL;
  return engine_mujoco.ride(out, instance, &still, p);
}

static void test_forgotten_input_is_L2(void **state) {
  (void)state;
  engine wrong = engine_mujoco;
  wrong.ride = ride_hands_off;
  support_run *run = play(&wrong, "steer_torque: 0.3", NULL);
  support_expect_failure(&run->comparison, "L2", "");
  support_close(run);
}

static json_t *report_of(const char *keys, const char *csv) {
  support_run *run = play(NULL, keys, csv);
  report r = {.comparisons = &run->comparison, .count = 1};
  assert_true(provenance_begin(&r.provenance, NULL, 0));
  json_t *document = report_document(&r);
  provenance_clear(&r.provenance);
  support_close(run);
  return document;
}

// Another input is another ride.
static void test_baselines_notice(void **state) {
  (void)state;
  static const struct {
    const char *keys, *csv;
  } rides[] = {{"", NULL},
               {"steer_torque: 0.3", NULL},
               {"input: in.csv", sway},
               {"input: in.csv", "time,steer_torque\n0,0\n1,0.2\n"}};
  enum { RIDES = sizeof rides / sizeof *rides };
  json_t *documents[RIDES];
  for (int i = 0; i < RIDES; i++) documents[i] = report_of(rides[i].keys, rides[i].csv);
  for (int i = 0; i < RIDES; i++)
    for (int k = 0; k < RIDES; k++) {
      problem p = {""};
      term_exit code = baseline_match(documents[i], documents[k], &p);
      assert_int_equal(code, i == k ? TERM_DONE : TERM_BASELINE);
      if (i != k) assert_non_null(strstr(p.text, "input differs"));
    }
  for (int i = 0; i < RIDES; i++) json_decref(documents[i]);
}

static void test_wrong_inputs(void **state) {
  (void)state;
  static const struct {
    const char *from, *to, *csv, *says;
  } cases[] = {
      {"gates:", "input: none.csv\ngates:", NULL, "none.csv: No such file"},
      {"gates:", "input: in.csv\ngates:", "time,steer\n0,0\n2,0\n", "steer: unknown column"},
      {"gates:", "input: in.csv\ngates:", "time,steer_torque\n0,0\n0.5,0\n",
       "before the ride does"},
      {"gates:", "input: in.csv\ngates:", "time,steer_torque\n0,0\n0,0\n",
       "in.csv:3: time: must rise"},
      {"gates:", "input: in.csv\ngates:", "time,steer_torque\n0,0\n1,nan\n",
       "in.csv:3: steer_torque"},
      {"gates:", "input: in.csv\nsteer_torque: 1\ngates:", sway, "not from both"},
      {"gates:", "steer_torque: much\ngates:", NULL, "steer_torque"},
      {"roadster", "benchmark\ninput: in.csv", sway, "rider"},
      {"engine: mujoco}", "engine: linear}\nsteer_torque: 1", NULL,
       "linear: this engine rides hands off"},
      {"engine: mujoco}", "engine: mujoco, rolling: contact}\ninput: in.csv", sway,
       "moving rider needs exact rolling"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char *text = support_replace(ridden, cases[i].from, cases[i].to);
    free(support_write(support_home, "s.yml", text));
    if (cases[i].csv) free(support_write(support_home, "in.csv", cases[i].csv));
    assert_int_equal(support_validate("s.yml"), 2);
    support_expect_text("err", cases[i].says);
    free(text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_inputs_act_on_both),
      cmocka_unit_test(test_forgotten_input_is_L2),
      cmocka_unit_test(test_baselines_notice),
      cmocka_unit_test_setup_teardown(test_wrong_inputs, support_enter, support_leave),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
