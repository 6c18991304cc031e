// SPDX-License-Identifier: Apache-2.0
// Model and scene apart are the bicycle of the single file: the same bodies to the last digit that
// counts, the same start, the same ride; and their sensors say what the runner measures.
#include "bicycle_mjcf.h"
#include "equations/bicycles.h"
#include "own_folder.h"
#include "runner.h"
#include "support/near.h"

#include <string.h>
#include <unistd.h>

static const char model_file[] = "bike.xml";

static mjcf_key key_of(const bike_bicycle *b, const mjcf_options *options) {
  runner_status status;
  mjcf_error error = {.text = ""};
  mjcf_key key = {{0}, {0}};
  runner *r = runner_create(b, options, &status, &error);
  if (!r) fail_msg("%s", error.text);
  const bike_state start = {.lean = 0.1, .steer = -0.05, .lean_rate = 0.2, .speed = 5};
  if (runner_start(r, &start, &error) != RUNNER_OK) fail_msg("%s", error.text);
  mju_copy(key.qpos, runner_data(r)->qpos, runner_model(r)->nq);
  mju_copy(key.qvel, runner_data(r)->qvel, runner_model(r)->nv);
  runner_free(r);
  return key;
}

static mjModel *compile_apart(const bike_bicycle *b, const mjcf_options *options,
                              const mjcf_key *key) {
  mjcf_error error = {.text = ""};
  char *model = mjcf_model_text(b, options, key, &error);
  char *scene = mjcf_scene_text(b, model_file, &error);
  mjModel *m = model && scene ? mjcf_compile_scene(scene, model_file, model, &error) : NULL;
  if (!m) fail_msg("%s", error.text);
  free(model);
  free(scene);
  return m;
}

// Relative to the larger of 1 and the number: as in test_bicycle_mjcf, since both come from one
// text.
static void same_numbers(const double *is, const double *should, int count) {
  for (int i = 0; i < count; i++) assert_near(is[i], should[i], 1e-12 * fmax(1, fabs(should[i])));
}

static void check_equal(const mjModel *is, const mjModel *should) {
  assert_int_equal(is->nq, should->nq);
  assert_int_equal(is->nv, should->nv);
  assert_int_equal(is->na, should->na);
  assert_int_equal(is->nbody, should->nbody);
  assert_int_equal(is->opt.integrator, should->opt.integrator);
  assert_int_equal(is->opt.disableflags, should->opt.disableflags);
  same_numbers(&is->opt.timestep, &should->opt.timestep, 1);
  same_numbers(is->opt.gravity, should->opt.gravity, 3);
  same_numbers(is->body_mass, should->body_mass, is->nbody);
  same_numbers(is->body_inertia, should->body_inertia, 3 * is->nbody);
  same_numbers(is->body_iquat, should->body_iquat, 4 * is->nbody);
  same_numbers(is->body_ipos, should->body_ipos, 3 * is->nbody);
  same_numbers(is->body_pos, should->body_pos, 3 * is->nbody);
  same_numbers(is->jnt_axis, should->jnt_axis, 3 * is->njnt);
  same_numbers(is->dof_damping, should->dof_damping, is->nv);
  same_numbers(is->dof_M0, should->dof_M0, is->nv);
  same_numbers(is->qpos0, should->qpos0, is->nq);
  assert_int_equal(is->nkey, 1);
  same_numbers(is->key_qpos, should->key_qpos, is->nq);
  same_numbers(is->key_qvel, should->key_qvel, is->nv);
}

// 100 steps from the key, side by side.
static void check_same_ride(const mjModel *is, const mjModel *should) {
  mjData *a = mj_makeData(is), *b = mj_makeData(should);
  mj_resetDataKeyframe(is, a, 0);
  mj_resetDataKeyframe(should, b, 0);
  for (int i = 0; i < 100; i++) {
    mj_step(is, a);
    mj_step(should, b);
  }
  same_numbers(a->qpos, b->qpos, is->nq);
  same_numbers(a->qvel, b->qvel, is->nv);
  int wheel = is->jnt_qposadr[mj_name2id(is, mjOBJ_JOINT, "front_spin")];
  assert_true(fabs(a->qpos[wheel]) > 0.1); // it went somewhere
  mj_deleteData(a);
  mj_deleteData(b);
}

static void check_bicycle(const bike_bicycle *b, const mjcf_options *options) {
  mjcf_error error = {.text = ""};
  const mjcf_key key = key_of(b, options);
  mjModel *apart = compile_apart(b, options, &key);
  mjModel *whole = mjcf_model(b, options, &key, &error);
  if (!whole) fail_msg("%s", error.text);
  check_equal(apart, whole);
  check_same_ride(apart, whole);
  mj_deleteModel(apart);
  mj_deleteModel(whole);
}

static void test_shipped_bicycles(void **state) {
  (void)state;
  for (int i = 0; i < SHIPPED_COUNT; i++) {
    bike_bicycle b = read_shipped(shipped_bicycles[i].name);
    const mjcf_options options = mjcf_default_options();
    check_bicycle(&b, &options);
  }
}

static void test_random_bicycles(void **state) {
  (void)state;
  random_source source = random_begin("random_bicycles", 43);
  for (int i = 0; i < 20; i++) {
    bike_bicycle b = random_bicycle(&source, i % 2);
    const mjcf_options options = mjcf_default_options();
    check_bicycle(&b, &options);
  }
}

static void test_variants(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("roadster");
  for (int i = 0; i < 12; i++) {
    mjcf_options options = mjcf_default_options();
    options.root = i % 2 ? MJCF_ROOT_FREE : MJCF_ROOT_HINGE;
    options.rolling = i / 2 % 2 ? MJCF_ROLLING_CONTACT : MJCF_ROLLING_EXACT;
    options.integrator = (mjcf_integrator)(i / 4);
    options.rider_offset = 0.01;
    check_bicycle(&b, &options);
    options.moving_rider = true;
    if (options.rolling == MJCF_ROLLING_EXACT) check_bicycle(&b, &options);
  }
}

//---------------------------------- placeholders --------------------------------------------------

static void write_text(const char *path, char *text) {
  FILE *out = fopen(path, "w");
  assert_non_null(out);
  fputs(text, out);
  fclose(out);
  free(text);
}

// The files as any program sees them: a legal placeholder, which ours replace.
static void test_placeholders(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("roadster");
  const mjcf_options options = mjcf_default_options();
  mjcf_error error = {.text = ""};
  write_text(model_file, mjcf_model_text(&b, &options, NULL, &error));
  write_text("scene.xml", mjcf_scene_text(&b, model_file, &error));
  char message[300] = "";
  mjModel *plain = mj_loadXML("scene.xml", NULL, message, sizeof message);
  if (!plain) fail_msg("%s", message);
  int wheel = mj_name2id(plain, mjOBJ_BODY, "front_wheel");
  const double *moments = plain->body_inertia + 3 * wheel;
  assert_near(moments[0] + moments[2] - moments[1], 0, 1e-15);
  mj_deleteModel(plain);
  mjModel *ours = mjcf_load("scene.xml", &error);
  if (!ours) fail_msg("%s", error.text);
  assert_near(ours->body_inertia[3 * wheel], 0, 0);
  assert_near(ours->body_inertia[3 * wheel + 1], 0.2, 0);
  mj_deleteModel(ours);
  unlink(model_file);
  unlink("scene.xml");
}

//---------------------------------- sensors -------------------------------------------------------

static double sensed(const runner *r, const mjModel *m, const char *name, int number) {
  int id = mj_name2id(m, mjOBJ_SENSOR, name);
  if (id < 0) fail_msg("no sensor '%s'", name);
  return runner_measured(r)->sensordata[m->sensor_adr[id] + number];
}

static void check_sensors(mjcf_root root) {
  bike_bicycle b = read_shipped("recumbent");
  mjcf_options options = mjcf_default_options();
  options.root = root;
  mjcf_error error = {.text = ""};
  write_text(model_file, mjcf_model_text(&b, &options, NULL, &error));
  write_text("scene.xml", mjcf_scene_text(&b, model_file, &error));
  runner_status status;
  runner *r = runner_load("scene.xml", &status, &error);
  if (!r) fail_msg("%s", error.text);
  const bike_state at = {
      .lean = 0.2, .steer = -0.1, .lean_rate = 0.3, .steer_rate = -0.4, .speed = 7};
  runner_instant is;
  if (runner_evaluate(&is, r, &at, NULL, &error) != RUNNER_OK) fail_msg("%s", error.text);
  const mjModel *m = runner_model(r);
  assert_near(sensed(r, m, "steer", 0), -0.1, 1e-14);
  assert_near(sensed(r, m, "steer_rate", 0), -0.4, 1e-14);
  assert_near(sensed(r, m, "rolling:model:energy", 0), is.kinetic + is.potential, 1e-9); // of 4 kJ
  assert_true(is.kinetic > 100 && is.potential > 100);
  if (root == MJCF_ROOT_HINGE) {
    assert_near(sensed(r, m, "lean", 0), 0.2, 1e-14);
    assert_near(sensed(r, m, "lean_rate", 0), 0.3, 1e-14);
    assert_near(sensed(r, m, "speed", 0), 7, 1e-13);
  } else {
    assert_near(asin(sensed(r, m, "left_axis", 2)), 0.2, 1e-14);
    // Upright and straight it would be 7: the hub is inside of the turn of its contact point.
    assert_near(sensed(r, m, "hub_velocity", 0), 7, 0.5);
  }
  runner_free(r);
  unlink(model_file);
  unlink("scene.xml");
}

static void test_sensors(void **state) {
  (void)state;
  check_sensors(MJCF_ROOT_HINGE);
  check_sensors(MJCF_ROOT_FREE);
}

// A name that means something to XML.
static void test_any_name(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("benchmark");
  snprintf(b.name, sizeof b.name, "a<b>&\"c\" --> \x01");
  const mjcf_options options = mjcf_default_options();
  const mjcf_key key = key_of(&b, &options);
  mjModel *m = compile_apart(&b, &options, &key);
  assert_string_equal(m->names, "a<b>&\"c\" --> ? scene");
  mj_deleteModel(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_shipped_bicycles), cmocka_unit_test(test_random_bicycles),
      cmocka_unit_test(test_variants),         cmocka_unit_test(test_placeholders),
      cmocka_unit_test(test_sensors),          cmocka_unit_test(test_any_name)};
  own_folder folder = enter_own_folder();
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  leave_own_folder(&folder);
  return failed;
}
