// SPDX-License-Identifier: Apache-2.0
// A wheel that rolls alone: the two engines of a disc against closed forms and against the example
// of plugin/, and what is made of wheels that are no discs.
#include "support/near.h"
#include "validate_support.h"

#include <engine_disc.h>
#include <math.h>
#include <mujoco/mujoco.h>
#include <stdlib.h>
#include <string.h>

static const char disc_scenario[] =
    "title: disc\nbicycle: benchmark\nstart: {speed: 1.2, lean: 0.3, steer_rate: -2}\n"
    "duration: 2\nsample: 0.02\ninstants: {count: 50, lean: 1.2, steer: 3, slow: -2, fast: 2}\n"
    "reference: {engine: disc}\ncandidate: {engine: mujoco_disc}\n"
    "gates:\n  - {layer: L0, metric: relative, limit: 1e-12, reason: test}\n"
    "  - {layer: L2, metric: max, limit: 1e-10, reason: test}\n"
    "  - {layer: L3, metric: max, signals: [rear_slip], limit: 1e-10, reason: test}\n";

static void test_discs_agree(void **state) {
  (void)state;
  support_run *f = support_open(NULL, disc_scenario);
  comparison *c = support_play(f);
  assert_string_equal(c->cause, "");
  assert_below(support_find(c, "L2", "rear_force", "max")->value, 1e-10);
  assert_below(support_find(c, "L3", "disc.energy", "balance_max")->value, 1e-13);
  for (size_t i = 0; i < c->measurements.count; i++) // of a front wheel nobody knows
    if (strcmp(c->measurements.items[i].layer, "L2") == 0)
      assert_null(strstr(c->measurements.items[i].signal, "front"));
  support_close(f);
}

// A candidate that lies by one part in a million about the wheel.
static void *create_wrong(const bike_bicycle *bicycle, const engine_choice *choice, term_exit *code,
                          problem *p) {
  bike_bicycle wrong = *bicycle;
  for (int i = 0; i < wrong.part_count; i++)
    if (wrong.parts[i].assembly == BIKE_REAR_WHEEL) wrong.parts[i].inertia[1] *= 1 + 1e-6;
  return engine_mujoco_disc.create(&wrong, choice, code, p);
}

static void test_wrong_disc_is_L0(void **state) {
  (void)state;
  engine wrong = engine_mujoco_disc;
  wrong.create = create_wrong;
  support_expect_fault(&wrong, disc_scenario, "L0", "");
}

//---------------------------------- closed forms --------------------------------------------------

static bike_bicycle thin_disc(void) {
  bike_bicycle b = bike_default_bicycle();
  b.geometry.R_r = 0.3;
  b.part_count = 1;
  b.parts[0] = (bike_part){.assembly = BIKE_REAR_WHEEL,
                           .mass = 2,
                           .position = {0, 0, 0.3},
                           .inertia = {0.045, 0.09, 0.045}}; // of plugin/examples/disc.xml
  return b;
}

static void ride(trace *out, const engine *e, const bike_bicycle *b, bike_state start,
                 double duration) {
  problem p = {""};
  term_exit code;
  engine_choice choice = engine_default_choice(e);
  void *instance = e->create(b, &choice, &code, &p);
  assert_non_null(instance);
  const engine_ride asked = {
      .start = start, .duration = duration, .sample = 0.01, .lean_limit = 1.4};
  assert_int_equal(e->ride(out, instance, &asked, &p), TERM_DONE);
  assert_string_equal(p.text, "");
  e->free(instance);
}

// Lean' = 0 asks of the speed what follows from the first of the equations in disc.h: the contact
// point goes round a circle for ever.
static void test_steady_circle(void **state) {
  (void)state;
  const bike_bicycle b = thin_disc();
  double lean = 0.35, turning = -3, R = 0.3, m = 2, I = 0.045, C = 0.09, g = b.gravity;
  double w3 = turning * cos(lean);
  double w2 = (I * w3 * w3 * tan(lean) - m * g * R * sin(lean)) / ((C + m * R * R) * w3);
  double speed = R * (w2 - w3 * tan(lean));
  const engine *engines[] = {&engine_disc, &engine_mujoco_disc};
  for (int i = 0; i < 2; i++) {
    trace t = {0};
    ride(&t, engines[i], &b, (bike_state){.lean = lean, .steer_rate = turning, .speed = speed}, 5);
    const bike_sample *end = &t.rows[t.count - 1].sample;
    double yaw = turning * end->time, circle = speed / turning;
    assert_near(end->time, 5, 1e-12);
    assert_near(end->lean, lean, 1e-9);
    assert_near(end->steer, yaw, 1e-9);
    assert_near(end->x, circle * sin(yaw), 1e-9);
    assert_near(end->y, circle * (1 - cos(yaw)), 1e-9);
    assert_near(end->rear_normal, m * g, 1e-7);
    trace_clear(&t);
  }
}

// What mujoco_disc rides is plugin/examples/disc.xml, to the last digit.
static void test_model_is_the_example(void **state) {
  (void)state;
  const bike_bicycle b = thin_disc();
  const bike_state start = {.speed = 1.5, .lean_rate = 0.2};
  char error[500];
  trace t = {0};
  ride(&t, &engine_mujoco_disc, &b, start, 1);
  mjModel *m =
      mj_loadXML(BICYCLE_SOURCE_DIR "/plugin/examples/disc.xml", NULL, error, sizeof error);
  assert_non_null(m);
  mjData *d = mj_makeData(m);
  d->qvel[0] = start.speed, d->qvel[1] = -0.3 * start.lean_rate;
  d->qvel[4] = start.lean_rate, d->qvel[5] = start.speed / 0.3;
  for (int i = 0; i < 1000; i++) {
    d->time = i * m->opt.timestep;
    mj_step(m, d);
  }
  const bike_sample *end = &t.rows[t.count - 1].sample;
  assert_true(fabs(d->qpos[4]) > 1e-3);
  assert_near(end->yaw, d->qpos[3], 1e-15);
  assert_near(end->lean, d->qpos[4], 1e-15);
  assert_near(end->rear_angle, d->qpos[5], 1e-15);
  mj_deleteData(d);
  mj_deleteModel(m);
  trace_clear(&t);
}

static void test_fall(void **state) {
  (void)state;
  const bike_bicycle b = thin_disc();
  trace one = {0}, other = {0};
  const bike_state start = {.speed = 0.2, .lean = 0.1};
  ride(&one, &engine_disc, &b, start, 5);
  ride(&other, &engine_mujoco_disc, &b, start, 5);
  assert_false(one.complete);
  assert_int_equal(one.end_event.kind, BIKE_EVENT_LEAN_LIMIT);
  assert_int_equal(other.end_event.kind, BIKE_EVENT_LEAN_LIMIT);
  // Both chords are of a step of 1 ms at most, in which the lean rate changes by some 0.1 rad/s.
  assert_near(other.end_time, one.end_time, 1e-5);
  trace_clear(&one);
  trace_clear(&other);
}

//---------------------------------- no disc -------------------------------------------------------

static void expect_refusal(const engine *e, const bike_bicycle *b, const char *says) {
  problem p = {""};
  term_exit code = TERM_DONE;
  engine_choice choice = engine_default_choice(e);
  assert_null(e->create(b, &choice, &code, &p));
  assert_int_equal(code, TERM_USAGE);
  if (!strstr(p.text, says)) fail_msg("'%s' does not say '%s'", p.text, says);
}

static void test_refusals(void **state) {
  (void)state;
  bike_bicycle b = thin_disc();
  b.parts[0].inertia[1] = 0;
  expect_refusal(&engine_disc, &b, "no inertia");
  expect_refusal(&engine_mujoco_disc, &b, "no inertia");
  b.part_count = 0;
  expect_refusal(&engine_disc, &b, "no mass");
  problem p = {""};
  char *text = support_replace(disc_scenario, "sample: 0.02", "sample: 0.0025");
  support_run *f = support_open(NULL, text);
  assert_int_equal(comparison_run(&f->comparison, &p), TERM_USAGE);
  assert_non_null(strstr(p.text, "multiple of the timestep"));
  support_close(f);
  free(text);
}

// Reading refuses what MuJoCo would call singular.
static void test_flat_start(void **state) {
  (void)state;
  problem p = {""};
  scenario s;
  char *text = support_replace(disc_scenario, "lean: 0.3", "lean: 1.5707963");
  char *folder = support_folder(), *path = support_write(folder, "flat.yml", text);
  assert_int_equal(scenario_read(&s, path, &p), TERM_USAGE);
  assert_non_null(strstr(
      p.text, "flat.yml:3: lean: 1.5708 rad is too much: rides end at a lean of 1.39626 rad"));
  free(text);
  free(path);
  support_remove(folder);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_discs_agree),   cmocka_unit_test(test_wrong_disc_is_L0),
      cmocka_unit_test(test_steady_circle), cmocka_unit_test(test_model_is_the_example),
      cmocka_unit_test(test_fall),          cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_flat_start),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
