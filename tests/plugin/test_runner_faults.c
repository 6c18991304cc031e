// SPDX-License-Identifier: Apache-2.0
// Everything that makes a ride worthless is found, and named.
#include "equations/bicycles.h"
#include "own_folder.h"
#include "rolling.h"
#include "runner_test_ride.h"

#include <string.h>
#include <unistd.h>

// A ride during which `harm` is done once, after half a second.
typedef struct accident {
  runner *r;
  void (*harm)(runner *r);
  bool done;
} accident;

static int meet_accident(const runner_sample *s, void *user) {
  accident *a = (accident *)user;
  if (a->done || s->row.time < 0.5) return 0;
  a->done = true;
  if (a->harm) a->harm(a->r);
  return a->harm == NULL;
}

static runner_status ride_into(void (*harm)(runner *r), runner_ride_result *result,
                               mjcf_error *error) {
  bike_bicycle b = read_shipped("benchmark");
  mjcf_options options = mjcf_default_options();
  accident a = {.r = make_runner(&b, &options), .harm = harm};
  const bike_state start = {.lean_rate = 0.1, .speed = 5};
  start_runner(a.r, &start);
  runner_ride_def def = runner_default_ride_def();
  def.duration = 1;
  def.on_sample = meet_accident;
  def.user = &a;
  runner_status status = runner_ride(result, a.r, &def, error);
  runner_free(a.r);
  return status;
}

static void spoil_velocity(runner *r) {
  runner_data(r)->qvel[3] = NAN;
}

static void spoil_position(runner *r) {
  runner_data(r)->qpos[2] = INFINITY;
}

static void change_step(runner *r) {
  runner_model(r)->opt.timestep *= 2;
}

static void steal_callback(runner *r) {
  (void)r;
  mjcb_control = NULL;
}

// Exact rolling is in place, but nobody applies the input any more.
static void steal_input(runner *r) {
  (void)r;
  roll_uninstall();
  mjcb_control = NULL;
  roll_install();
}

static void shrink_stack(runner *r) {
  runner_data(r)->nstack = 8;
}

static void lie_flat(runner *r) {
  runner_data(r)->qpos[4] = acos(-1.0) / 2;
}

static void check_accident(void (*harm)(runner *r), runner_status status, const char *word) {
  runner_ride_result result;
  mjcf_error error = {.text = ""};
  assert_int_equal(ride_into(harm, &result, &error), status);
  if (!strstr(error.text, word)) fail_msg("'%s' does not say '%s'", error.text, word);
  assert_int_equal(runner_exit_code(status), 3);
  assert_false(result.complete);
  assert_near(result.end_time, 0.5, 2e-3);
}

static void test_accidents(void **state) {
  (void)state;
  check_accident(spoil_velocity, RUNNER_INVALID_WARNING, "QVEL");
  check_accident(spoil_position, RUNNER_INVALID_WARNING, "QPOS");
  check_accident(change_step, RUNNER_INVALID_TIME, "time");
  check_accident(steal_callback, RUNNER_INVALID_CALLBACK, "mjcb_control");
  check_accident(steal_input, RUNNER_INVALID_CALLBACK, "mjcb_control");
  roll_uninstall(); // what was stolen so is given back by whom took it
  check_accident(lie_flat, RUNNER_INVALID_WARNING, "singular"); // yaw and pitch are one axis
  assert_int_not_equal(access("MUJOCO_LOG.TXT", F_OK), 0);
}

// An error of MuJoCo itself neither waits for a key nor ends the program.
static void test_mujoco_error(void **state) {
  (void)state;
  runner_ride_result result;
  mjcf_error error = {.text = ""};
  runner_status status = ride_into(shrink_stack, &result, &error);
  assert_int_equal(status, RUNNER_INVALID_ERROR);
  if (!strstr(error.text, "tack")) fail_msg("%s", error.text);
  assert_null(strchr(error.text, '\n'));
}

// After an accident the next ride is as good as ever.
static void test_recovery(void **state) {
  (void)state;
  runner_ride_result result;
  mjcf_error error = {.text = ""};
  assert_int_equal(ride_into(steal_callback, &result, &error), RUNNER_INVALID_CALLBACK);
  assert_int_equal(ride_into(NULL, &result, &error), RUNNER_INTERRUPTED);
  assert_near(result.end_time, 0.5, 1e-12);
  assert_int_equal(runner_exit_code(RUNNER_INTERRUPTED), 2);
}

static int ignore_sample(const runner_sample *s, void *user) {
  (void)s, (void)user;
  return 0;
}

static void test_bad_definitions(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("benchmark");
  mjcf_options options = mjcf_default_options();
  runner *r = make_runner(&b, &options);
  const bike_state start = {.speed = 5};
  start_runner(r, &start);
  runner_ride_def good = runner_default_ride_def();
  good.on_sample = ignore_sample;
  good.duration = 0.1;
  runner_ride_def bad[10];
  for (int i = 0; i < 10; i++) bad[i] = good;
  bad[0].on_sample = NULL;
  bad[1].duration = NAN;
  bad[2].duration = -1;
  bad[3].sample = 0.0015; // not a multiple of 1 ms
  bad[4].sample = 1;      // longer than the ride
  bad[5].sample = 0;
  bad[6].lean_limit = 2;
  bad[7].duration = INFINITY;
  bad[8].friction_limit = -1;
  bad[9].friction_limit = NAN;
  runner_ride_result result;
  mjcf_error error;
  assert_int_equal(runner_ride(&result, r, &good, &error), RUNNER_OK);
  for (int i = 0; i < 10; i++) {
    error.text[0] = '\0';
    assert_int_equal(runner_ride(&result, r, &bad[i], &error), RUNNER_ARGUMENT);
    assert_true(strlen(error.text) > 0);
  }
  runner_free(r);
}

//---------------------------------- models of others ----------------------------------------------

// The benchmark's text with one replacement, written and loaded.
static runner *load_edited(const char *from, const char *to, runner_status *status,
                           mjcf_error *error) {
  bike_bicycle b = read_shipped("benchmark");
  mjcf_options options = mjcf_default_options();
  options.visible = false;
  char *text = mjcf_text(&b, &options, NULL, error);
  assert_non_null(text);
  char *found = strstr(text, from);
  assert_non_null(found);
  FILE *out = fopen("edited.xml", "w");
  fprintf(out, "%.*s%s%s", (int)(found - text), text, to, found + strlen(from));
  fclose(out);
  free(text);
  runner *r = runner_load("edited.xml", status, error);
  unlink("edited.xml");
  return r;
}

static void test_foreign_models(void **state) {
  (void)state;
  static const struct {
    const char *from, *to, *word;
  } edits[] = {{"body name=\"front_frame\"", "body name=\"fork\"", "front_frame"},
               {"joint name=\"steer\"", "joint name=\"bar\"", "steer"},
               {"axis=\"0 1 0\"/>\n      </body>", "axis=\"0 -1 0\"/>\n      </body>", "rear_spin"},
               {"joint name=\"yaw\" type=\"hinge\"", "joint name=\"yaw\" type=\"slide\"", "yaw"},
               {"tuple name=\"rolling_discs\"", "tuple name=\"wheels\"", "rolling_discs"},
               {"objname=\"front_wheel\"", "objname=\"front_frame\"", "front_wheel"},
               {"objname=\"front_wheel\"", "objname=\"world\"", "cannot move (body 'world')"},
               {"<tuple", "<text name=\"rolling_discs\" data=\"x\"/><tuple",
                "rolling_driven (text 'rolling_discs')"}};
  mjcf_error error = {.text = ""};
  runner_status status;
  runner_free(load_edited("<mujoco", "<mujoco", &status, &error));
  assert_int_equal(status, RUNNER_OK);
  for (size_t i = 0; i < sizeof edits / sizeof edits[0]; i++) {
    assert_null(load_edited(edits[i].from, edits[i].to, &status, &error));
    assert_int_equal(status, RUNNER_MODEL);
    if (!strstr(error.text, edits[i].word)) fail_msg("%s", error.text);
  }
}

// Point masses alone leave MuJoCo's mass matrix singular, with either root: its rides were noise.
static void test_singular_bicycle(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("roadster_riderless");
  int kept = 0;
  for (int i = 0; i < b.part_count; i++)
    if (b.parts[i].assembly != BIKE_FRONT_FRAME) b.parts[kept++] = b.parts[i];
  b.part_count = kept;
  mjcf_options options = mjcf_default_options();
  for (int root = 0; root < 2; root++) {
    runner_status status;
    mjcf_error error = {.text = ""};
    options.root = root ? MJCF_ROOT_FREE : MJCF_ROOT_HINGE;
    assert_null(runner_create(&b, &options, &status, &error));
    assert_int_equal(status, RUNNER_MODEL);
    assert_non_null(strstr(error.text, "singular"));
  }
}

static runner_instant evaluate(runner *r) {
  const bike_state state = {.lean = 0.1, .steer = 0.05, .speed = 5};
  runner_instant out;
  mjcf_error error = {.text = ""};
  if (runner_evaluate(&out, r, &state, NULL, &error) != RUNNER_OK) fail_msg("%s", error.text);
  return out;
}

// Whatever stands in the marker, and how often, the ground's force on a wheel is all of it.
static void test_a_wheel_marked_often(void **state) {
  (void)state;
#define REAR "<element objtype=\"body\" objname=\"rear_wheel\" prm=\"0.3\"/>"
  static const char begin[] = "<tuple name=\"rolling_discs\">";
  mjcf_error error = {.text = ""};
  runner_status status;
  runner *once = load_edited(begin, begin, &status, &error);
  runner *often = load_edited(
      begin, "<tuple name=\"rolling_discs\">" REAR REAR REAR REAR REAR REAR REAR REAR REAR, &status,
      &error);
#undef REAR
  if (!once || !often) fail_msg("%s", error.text);
  runner_instant a = evaluate(once), b = evaluate(often);
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 3; k++) assert_near(b.force[i][k], a.force[i][k], 1e-9);
  assert_true(a.force[0][2] > 100 && a.force[1][2] > 100);
  runner_free(once);
  runner_free(often);
}

// A disc that is spoilt after the model was checked.
static void test_a_disc_left_free_is_named(void **state) {
  (void)state;
  mjcf_error error = {.text = ""};
  runner_status status;
  runner_instant at;
  runner *r = load_edited("<mujoco", "<mujoco", &status, &error);
  assert_non_null(r);
  runner_model(r)->tuple_objprm[1] = -1;
  assert_int_equal(runner_evaluate(&at, r, &(bike_state){.speed = 5}, NULL, &error),
                   RUNNER_INVALID_WARNING);
  if (!strstr(error.text, "'front_wheel' at 0 s: rolling discs: a radius"))
    fail_msg("%s", error.text);
  runner_free(r);
}

static void test_keyframe(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("benchmark");
  mjcf_options options = mjcf_default_options();
  runner *r = make_runner(&b, &options);
  mjcf_error error = {.text = ""};
  assert_int_equal(runner_start_at_keyframe(r, &error), RUNNER_MODEL);
  const bike_state start = {.lean_rate = 0.1, .speed = 5};
  start_runner(r, &start);
  mjcf_key key;
  memcpy(key.qpos, runner_data(r)->qpos, sizeof(double[9]));
  memcpy(key.qvel, runner_data(r)->qvel, sizeof(double[9]));
  runner_free(r);
  for (int i = 0; i < 2; i++) {
    if (i == 1) key.qvel[8] += 1e-9; // the front wheel slips by less than a nanometre a second
    char *text = mjcf_text(&b, &options, &key, &error);
    FILE *out = fopen("key.xml", "w");
    fputs(text, out);
    fclose(out);
    free(text);
    runner_status status;
    r = runner_load("key.xml", &status, &error);
    assert_non_null(r);
    assert_int_equal(runner_start_at_keyframe(r, &error), i == 0 ? RUNNER_OK : RUNNER_START);
    runner_instant at;
    if (i == 0) {
      assert_int_equal(runner_measure(&at, r, &error), RUNNER_OK);
      assert_near(at.speed, 5, 1e-14);
      assert_near(at.lean_rate, 0.1, 0);
    }
    runner_free(r);
  }
  unlink("key.xml");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_accidents),
                                     cmocka_unit_test(test_mujoco_error),
                                     cmocka_unit_test(test_recovery),
                                     cmocka_unit_test(test_bad_definitions),
                                     cmocka_unit_test(test_foreign_models),
                                     cmocka_unit_test(test_singular_bicycle),
                                     cmocka_unit_test(test_a_wheel_marked_often),
                                     cmocka_unit_test(test_a_disc_left_free_is_named),
                                     cmocka_unit_test(test_keyframe)};
  own_folder folder = enter_own_folder();
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  leave_own_folder(&folder);
  return failed;
}
