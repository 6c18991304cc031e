// SPDX-License-Identifier: Apache-2.0
// What the cause of rides that differ says, and what it must not say because no layer measured it.
#include "support/near.h"
#include "validate_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char ride_text[] =
    "title: ride\nbicycle: benchmark\nstart: {speed: 4.6, lean_rate: 0.5}\nduration: 1\n"
    "sample: 0.01\ninstants: {count: 0}\n"
    "reference: {engine: analytic}\ncandidate: {engine: mujoco}\n"
    "gates:\n  - {layer: L2, metric: max, signals: [lean, steer], limit: 1e-9, reason: test}\n";

// What is done to each row of a right ride, and what the cause must and must not say.
typedef void change(bike_sample *s);
static change *applied;

static term_exit ride_changed(trace *out, void *instance, const engine_ride *asked, problem *p) {
  term_exit code = engine_mujoco.ride(out, instance, asked, p);
  for (size_t k = 0; k < out->count; k++) applied(&out->rows[k].sample);
  return code;
}

static term_exit ride_without_pitch(trace *out, void *instance, const engine_ride *asked,
                                    problem *p) {
  term_exit code = ride_changed(out, instance, asked, p);
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    if (strcmp(trace_signals[i].name, "pitch") == 0) out->missing |= (uint64_t)1 << i;
  return code;
}

static const double degree = 57.295779513082321;

static void flip_steer(bike_sample *s) {
  s->steer *= -1;
  s->steer_rate *= -1;
}

static void to_degrees(bike_sample *s) {
  s->lean *= degree;
  s->steer *= degree;
  s->lean_rate *= degree;
}

static void flip_and_shrink(bike_sample *s) {
  s->lean /= -degree;
}

static void to_kmh(bike_sample *s) {
  s->speed *= 3.6;
  s->lean += 1e-6; // something must fail
}

static void swap(bike_sample *s) {
  double lean = s->lean;
  s->lean = s->steer;
  s->steer = lean;
}

static void repeat(bike_sample *s) {
  s->steer = s->lean_rate;
}

static void flip_inexactly(bike_sample *s) {
  s->steer *= -1.01;
}

static void scale(bike_sample *s) {
  s->lean *= 1.02;
}

static void zero(bike_sample *s) {
  s->lean = 0;
}

static void start_elsewhere(bike_sample *s) {
  s->speed += 0.5; // not gated
  s->x += 2;
  s->lean += 0.001;
}

static void test_relations_are_named(void **state) {
  (void)state;
  static const struct {
    change *change;
    const char *says, *also, *never;
  } cases[] = {
      {flip_steer, "steer, steer rate of mujoco have the other sign",
       "once corrected:", "not told apart"},
      {to_degrees, "lean, steer, lean rate of mujoco are in degrees", " rad/s)", "sign"},
      {flip_and_shrink,
       "lean of mujoco is too small by a factor of 57.2957795 and has the other sign", "",
       "not told apart"},
      {to_kmh, "speed of mujoco is in km/h", " m/s)", "speed 16.56"},
      {swap, "lean and steer of mujoco are swapped", "once corrected:", "is the"},
      {repeat, "steer of mujoco is the lean rate of analytic", "within", "swapped"},
      {flip_inexactly, "steer of mujoco has the other sign", "once corrected: 0.00",
       "not told apart"},
      {scale, "beyond the limit from 0.01 s on",
       "not told apart: parameters, equations, integration", "start differently"},
      {zero, "asked and agreeing: the first row", "not told apart", "sign"},
      {start_elsewhere, "they start differently: speed 5.1 against 4.6 m/s",
       "lean 0.001 against 0 rad, x 2 against 0 m", "lean rate"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    engine wrong = engine_mujoco;
    wrong.ride = ride_changed;
    applied = cases[i].change;
    support_run *f = support_open(&wrong, ride_text);
    comparison *c = support_play(f);
    support_expect_failure(c, "L2", cases[i].says);
    support_expect_failure(c, "L2", cases[i].also);
    if (strstr(c->cause, cases[i].never)) fail_msg("'%s' says %s", c->cause, cases[i].never);
    support_close(f);
  }
}

// What an earlier layer or a convergence study has examined is no longer open.
static void test_only_what_was_not_asked_is_open(void **state) {
  (void)state;
  static const char more[] =
      "convergence: {timesteps: [1e-2, 5e-3, 2.5e-3, 1.25e-3], tolerance: 1e-9}\n"
      "gates:\n  - {layer: L0, metric: relative, limit: 1e-9, reason: test}\n";
  char *text = support_replace(ride_text, "gates:\n", more);
  engine wrong = engine_mujoco;
  wrong.ride = ride_changed;
  applied = scale;
  support_run *f = support_open(&wrong, text);
  comparison *c = support_play(f);
  support_expect_failure(c, "L2", "the engines agree on instants, but the rides differ");
  assert_null(strstr(c->cause, "parameters"));
  assert_null(strstr(c->cause, "not told apart"));
  support_expect_failure(c, "L2", "no smaller step brings them closer than 0.00");
  support_close(f);
  free(text);
}

// A gate on what no engine measures accuses nobody.
static void test_unmeasured_is_no_fault(void **state) {
  (void)state;
  char *text = support_replace(ride_text, "{engine: mujoco}", "{engine: linear}");
  char *asked = support_replace(text, "gates:\n",
                                "gates:\n  - {layer: Lp, metric: relative, limit: 1, reason: t}\n");
  support_run *f = support_open(NULL, asked);
  comparison *c = support_play(f);
  support_expect_failure(c, "Lp", "nothing of parameters was measured");
  assert_null(strstr(c->cause, "hold"));
  support_close(f);
  free(asked);
  free(text);
}

static double step; // of the candidate's ride

static void *create_noting_step(const bike_bicycle *bicycle, const engine_choice *choice,
                                term_exit *code, problem *p) {
  step = choice->option[engine_option_index(&engine_mujoco, "timestep")];
  return engine_mujoco.create(bicycle, choice, code, p);
}

static void err_with_step(bike_sample *s) {
  s->lean += 10 * pow(step, 2.5) * s->time;
  s->steer += 10 * pow(step, 2.5) * s->time;
}

// An order that is no integrator's accuses none.
static void test_odd_order_is_no_integrator(void **state) {
  (void)state;
  char *text = support_replace(
      ride_text, "gates:\n",
      "convergence: {timesteps: [1e-2, 5e-3, 2.5e-3, 1.25e-3], tolerance: 1e-3}\ngates:\n");
  engine wrong = engine_mujoco;
  wrong.create = create_noting_step;
  wrong.ride = ride_changed;
  applied = err_with_step;
  support_run *f = support_open(&wrong, text);
  comparison *c = support_play(f);
  support_expect_failure(c, "L2", "they get closer with order 2.5, not 4");
  assert_null(strstr(c->cause, "another integrator"));
  support_close(f);
  free(text);
}

// What one gate cannot measure does not hide what another has measured.
static void test_unmeasured_hides_no_fault(void **state) {
  (void)state;
  static const char more[] =
      "gates:\n  - {layer: L2, metric: rmse, signals: [pitch, lean], limit: 1, reason: test}\n"
      "  - {layer: L2, metric: max, signals: [pitch], limit: 1, reason: test}\n";
  char *text = support_replace(ride_text, "gates:\n", more);
  engine wrong = engine_mujoco;
  wrong.ride = ride_without_pitch;
  applied = flip_steer;
  support_run *f = support_open(&wrong, text);
  comparison *c = support_play(f);
  support_expect_failure(c, "L2", "steer, steer rate of mujoco have the other sign");
  support_expect_failure(c, "L2", "; nothing of pitch was measured");
  support_close(f);
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_relations_are_named),
      cmocka_unit_test(test_only_what_was_not_asked_is_open),
      cmocka_unit_test(test_unmeasured_is_no_fault),
      cmocka_unit_test(test_odd_order_is_no_integrator),
      cmocka_unit_test(test_unmeasured_hides_no_fault),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
