// SPDX-License-Identifier: Apache-2.0
// Bicycles read out of MuJoCo models: our own return every number, other people's are understood
// and ridden without an edit, and what is no bicycle is refused by name.
#include "support/near.h"

#include <bicycle/error.h>
#include <bicycle/file.h>
#include <bicycle/model.h>
#include <bicycle_import.h>
#include <runner.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FORK_FIRST BICYCLE_SOURCE_DIR "/tests/plugin/import_models/fork_first.xml"
#define SOMEBODYS BICYCLE_SOURCE_DIR "/validate/scenarios/models/somebodys_bicycle.xml"

static void load_shipped(bike_bicycle *out, const char *name) {
  char path[400];
  bike_file file;
  snprintf(path, sizeof path, BICYCLE_SOURCE_DIR "/model/%s/%s.yml", name, name);
  assert_int_equal(bike_file_read(&file, path, NULL), BIKE_OK);
  *out = file.bicycle;
}

static void assert_bodies_near(const bike_body *a, const bike_body *b) {
  assert_near(a->mass, b->mass, 1e-12);
  assert_near(a->spin_inertia, b->spin_inertia, 1e-12);
  for (int k = 0; k < 3; k++) assert_near(a->centre[k], b->centre[k], 1e-12);
  for (int k = 0; k < 6; k++)
    assert_near(a->inertia[k], b->inertia[k], 1e-12 * fmax(1, fabs(b->inertia[k])));
}

// Everything that follows from a bicycle's numbers.
static void assert_same(const bike_bicycle *is, const bike_bicycle *should) {
  bike_model a, b;
  bike_upright p, q;
  assert_int_equal(bike_model_init(&a, is), BIKE_OK);
  assert_int_equal(bike_model_init(&b, should), BIKE_OK);
  assert_int_equal(bike_upright_position(&p, &is->geometry), BIKE_OK);
  assert_int_equal(bike_upright_position(&q, &should->geometry), BIKE_OK);
  assert_near(p.wheelbase, q.wheelbase, 1e-12);
  assert_near(p.trail, q.trail, 1e-12);
  assert_near(p.tilt, q.tilt, 1e-12);
  assert_near(a.geometry.R_r, b.geometry.R_r, 0);
  assert_near(a.geometry.R_f, b.geometry.R_f, 0);
  assert_near(a.geometry.L_s, b.geometry.L_s, 1e-12);
  assert_near(a.gravity, b.gravity, 0);
  assert_near(a.steer_damping, b.steer_damping, 0);
  assert_near(a.total_mass, b.total_mass, 1e-12);
  assert_bodies_near(&a.rear, &b.rear);
  assert_bodies_near(&a.front, &b.front);
}

static void test_own_models_return_every_number(void **state) {
  (void)state;
  static const char *const names[] = {"benchmark",      "roadster",  "roadster_riderless",
                                      "penny_farthing", "recumbent", "recumbent_damped"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    for (int root = 0; root < 2; root++)
      for (int rolling = 0; rolling < 2; rolling++) {
        bike_bicycle before, after;
        mjcf_error error = {.text = ""};
        mjcf_options options = mjcf_default_options();
        options.root = (mjcf_root)root;
        options.rolling = (mjcf_rolling)rolling;
        load_shipped(&before, names[i]);
        mjModel *m = mjcf_model(&before, &options, NULL, &error);
        assert_non_null(m);
        if (!import_bicycle(&after, NULL, m, &error)) fail_msg("%s: %s", names[i], error.text);
        assert_same(&after, &before);
        mj_deleteModel(m);
      }
}

// Masses beside the plane of symmetry.
static void test_asymmetric_bicycle_returns(void **state) {
  (void)state;
  bike_bicycle before, after;
  mjcf_error error = {.text = ""};
  mjcf_options options = mjcf_default_options();
  load_shipped(&before, "benchmark");
  bike_part *bag = &before.parts[before.part_count++];
  *bag = (bike_part){.name = "bag", .assembly = BIKE_FRONT_FRAME, .mass = 3};
  bag->position[0] = 0.9, bag->position[1] = 0.2, bag->position[2] = 0.8;
  const double tensor[6] = {0.03, 0.04, 0.05, 0.01, -0.02, 0.003};
  memcpy(bag->inertia, tensor, sizeof tensor);
  mjModel *m = mjcf_model(&before, &options, NULL, &error);
  assert_non_null(m);
  assert_true(import_bicycle(&after, NULL, m, &error));
  assert_same(&after, &before);
  mj_deleteModel(m);
}

static void test_somebodys_bicycle(void **state) {
  (void)state;
  bike_bicycle b;
  bike_upright upright;
  import_map map;
  mjcf_error error = {.text = ""};
  mjModel *m = mjcf_load(SOMEBODYS, &error);
  assert_non_null(m);
  if (!import_bicycle(&b, &map, m, &error)) fail_msg("%s", error.text);
  assert_string_equal(m->names + m->name_jntadr[map.steer], "column");
  assert_string_equal(m->names + m->name_jntadr[map.spin[IMPORT_FRONT]], "fore axle");
  assert_int_equal(map.steer_sign, -1);
  assert_near(b.geometry.R_r, 0.34, 0);
  assert_near(b.geometry.R_f, 0.33, 0);
  assert_near(b.steer_damping, 0.4, 0);
  assert_int_equal(b.part_count, 4);
  assert_near(b.parts[0].mass, 86, 1e-12); // chassis, person and bag
  // Rear axle at the chassis; bag 0.15 m to the left: 4 * 0.15/86
  assert_near(b.parts[0].position[1], 4 * 0.15 / 86, 1e-12);
  assert_int_equal(bike_upright_position(&upright, &b.geometry), BIKE_OK);
  // Two circles on one line: w^2 = |hubs|^2 - (R_r - R_f)^2
  mjData *d = mj_makeData(m);
  mj_kinematics(m, d);
  double rear[3], front[3], apart = 0;
  mju_rotVecMat(rear, map.hub[0], d->xmat + 9 * map.wheel[0]);
  mju_rotVecMat(front, map.hub[1], d->xmat + 9 * map.wheel[1]);
  for (int k = 0; k < 3; k++)
    apart +=
        pow(front[k] + d->xpos[3 * map.wheel[1] + k] - rear[k] - d->xpos[3 * map.wheel[0] + k], 2);
  assert_near(upright.wheelbase, sqrt(apart - 0.01 * 0.01), 1e-12);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// The fork carries the frame: front and rear are told apart, and the steer's sign turns round.
static void test_fork_first(void **state) {
  (void)state;
  bike_bicycle b;
  import_map map;
  mjcf_error error = {.text = ""};
  mjModel *m = mjcf_load(FORK_FIRST, &error);
  assert_non_null(m);
  if (!import_bicycle(&b, &map, m, &error)) fail_msg("%s", error.text);
  assert_string_equal(m->names + m->name_bodyadr[map.half[IMPORT_REAR]], "frame");
  assert_string_equal(m->names + m->name_jntadr[map.spin[IMPORT_REAR]], "rear axle");
  assert_int_equal(map.steer_sign, -1);
  assert_int_equal(map.spin_sign[IMPORT_FRONT], -1);
  assert_near(b.geometry.R_r, 0.35, 0);
  assert_near(b.geometry.R_f, 0.33, 0);
  mj_deleteModel(m);
}

// At a state far from upright the user's own model says what the analytic one says of the bicycle
// that was read out of it: nothing of the import may be wrong.
static void check_instant(const char *path, const bike_state *at) {
  bike_bicycle b;
  bike_model model;
  bike_snapshot s;
  runner_instant i;
  runner_status status;
  mjcf_error error = {.text = ""};
  runner *r = runner_import(path, &status, &error);
  if (!r) fail_msg("%s: %s", path, error.text);
  assert_true(import_bicycle(&b, NULL, runner_model(r), &error));
  assert_int_equal(bike_model_init(&model, &b), BIKE_OK);
  assert_int_equal(bike_evaluate(&s, &model, at, NULL), BIKE_OK);
  status = runner_evaluate(&i, r, at, NULL, &error);
  if (status != RUNNER_OK) fail_msg("%s: %s", path, error.text);
  assert_near(i.lean, at->lean, 1e-13);
  assert_near(i.steer, at->steer, 1e-13);
  assert_near(i.speed, at->speed, 1e-12);
  assert_near(i.lean_acceleration, s.acceleration.lean, 1e-10);
  assert_near(i.steer_acceleration, s.acceleration.steer, 1e-10);
  assert_near(i.speed_rate, s.acceleration.speed, 1e-10);
  assert_near(i.yaw_rate, s.yaw_rate, 1e-12);
  assert_near(i.pitch, s.pitch, 1e-12);
  assert_near(i.wheel_rate[1], s.front_wheel_rate, 1e-11);
  for (int k = 0; k < 3; k++) {
    assert_near(i.force[0][k], s.rear_force[k], 1e-8);
    assert_near(i.force[1][k], s.front_force[k], 1e-8);
  }
  assert_near(i.kinetic, s.kinetic, 1e-9);
  runner_free(r);
}

static void test_ridden_without_an_edit(void **state) {
  (void)state;
  static const char *const paths[] = {SOMEBODYS, FORK_FIRST};
  static const bike_state at[] = {
      {0, 0, 0, 0, 3}, {0.3, -0.2, 0.5, -0.7, 4}, {-0.5, 0.6, 1, 2, 7}, {0.1, 0.05, 0, 0, -2}};
  for (size_t i = 0; i < 2; i++)
    for (size_t k = 0; k < sizeof at / sizeof *at; k++) check_instant(paths[i], &at[k]);
}

static int keep_last(const runner_sample *sample, void *user) {
  runner_sample *last = user;
  *last = *sample;
  return 0;
}

// Somebody's bicycle on the contacts that its author gave it.
static runner *somebodys_as_it_is(void) {
  runner_status status;
  mjcf_error error = {.text = ""};
  runner *r = runner_import_as_is(SOMEBODYS, &status, &error);
  if (!r) fail_msg("%s", error.text);
  runner_model(r)->opt.timestep = 1e-3;
  return r;
}

// A ride at 5 m/s from a lean rate; `last` is its last row.
static runner_ride_result ride_for(double duration, runner *r, double lean_rate,
                                   runner_sample *last) {
  mjcf_error error = {.text = ""};
  runner_ride_result result;
  const bike_state start = {.speed = 5, .lean_rate = lean_rate};
  assert_int_equal(runner_start(r, &start, &error), RUNNER_OK);
  runner_ride_def def = runner_default_ride_def();
  def.duration = duration;
  def.on_sample = keep_last;
  def.user = last;
  if (runner_ride(&result, r, &def, &error) != RUNNER_OK) fail_msg("%s", error.text);
  return result;
}

// Its wheels are cylinders 2 cm wide, which slip a little, whose middle is a little off the ground,
// and which carry the whole weight.
static void test_ridden_on_its_own_contacts(void **state) {
  (void)state;
  runner_sample last;
  runner *r = somebodys_as_it_is();
  assert_true(ride_for(1, r, 0.1, &last).complete);
  assert_near(last.row.x, 5, 0.1);
  double slip = fmax(last.slip[0], last.slip[1]),
         off = fmax(fabs(last.height[0]), fabs(last.height[1]));
  assert_true(slip > 1e-9 && slip < 0.1);
  assert_true(off > 1e-9 && off < 0.02);
  double weight = 0, carried = last.row.rear_normal + last.row.front_normal;
  for (int i = 0; i < runner_model(r)->nbody; i++) weight += 9.81 * runner_model(r)->body_mass[i];
  assert_near(carried, weight, 0.05 * weight);
  runner_free(r);
}

// Its wheels bounce more often than there is room for events; what ended the ride is told all the
// same.
static void test_fall_after_many_lifts_is_told(void **state) {
  (void)state;
  runner_sample last;
  runner *r = somebodys_as_it_is();
  runner_model(r)->opt.integrator = mjINT_RK4;
  const runner_ride_result result = ride_for(runner_default_ride_def().duration, r, 0.2, &last);
  assert_false(result.complete);
  assert_true(result.event_count > BIKE_MAX_EVENTS);
  assert_int_equal(result.events[BIKE_MAX_EVENTS - 1].kind, BIKE_EVENT_LEAN_LIMIT);
  assert_near(result.events[BIKE_MAX_EVENTS - 1].time, result.end_time, 0);
  runner_free(r);
}

// What its marker makes to roll is not asked to do otherwise.
static void test_marked_model_is_not_ridden_on_contacts(void **state) {
  (void)state;
  runner_status status;
  mjcf_error error = {.text = ""};
  assert_null(
      runner_import_as_is(BICYCLE_SOURCE_DIR "/model/roadster/roadster.xml", &status, &error));
  assert_int_equal(runner_exit_code(status), 2);
  assert_non_null(strstr(error.text, "rolling_discs"));
}

static void test_missing_file(void **state) {
  (void)state;
  runner_status status;
  mjcf_error error = {.text = ""};
  assert_null(runner_import("/nowhere/x.xml", &status, &error));
  assert_int_equal(runner_exit_code(status), 2);
  assert_non_null(strstr(error.text, "No such file"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_own_models_return_every_number),
      cmocka_unit_test(test_asymmetric_bicycle_returns),
      cmocka_unit_test(test_somebodys_bicycle),
      cmocka_unit_test(test_fork_first),
      cmocka_unit_test(test_ridden_without_an_edit),
      cmocka_unit_test(test_ridden_on_its_own_contacts),
      cmocka_unit_test(test_fall_after_many_lifts_is_told),
      cmocka_unit_test(test_marked_model_is_not_ridden_on_contacts),
      cmocka_unit_test(test_missing_file),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
