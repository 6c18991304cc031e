// SPDX-License-Identifier: Apache-2.0
// Rides of models that are no bicycles: against closed forms, and what ends them.
#include "own_folder.h"
#include "runner_any.h"
#include "support/near.h"

#include <stdio.h>
#include <string.h>

static runner_any *load(const char *folder, const char *name) {
  char path[1024];
  runner_status status;
  mjcf_error error = {.text = ""};
  snprintf(path, sizeof path, "%s/%s/%s", BICYCLE_SOURCE_DIR, folder, name);
  runner_any *r = runner_any_load(path, &status, &error);
  if (!r) fail_msg("%s", error.text);
  return r;
}

static const char examples[] = "plugin/examples", models[] = "tests/plugin/rolling_models";

static void start(runner_any *r) {
  mjcf_error error = {.text = ""};
  double moved;
  if (runner_any_start(r, false, &moved, &error) != RUNNER_OK) fail_msg("%s", error.text);
  assert_near(moved, 0, 0);
}

// What a ride has said.
typedef struct record {
  int rows, lifts, notes;
  double time, first_lift, second_lift; // s
  double slip, height, force;           // largest m/s, m; N of the first disc in the last row
  double qpos[16];                      // of the last row
  char note[256];
  int stop_at; // rows, 0: never
} record;

static int take(const runner_moment *moment, void *user) {
  record *it = (record *)user;
  it->rows++;
  it->time = moment->time;
  it->force = moment->discs[0].normal_force;
  it->slip = fmax(it->slip, mju_norm3(moment->discs[0].slip));
  it->height = fmax(it->height, fabs(moment->discs[0].height));
  mju_copy(it->qpos, moment->data->qpos, 4);
  return it->rows == it->stop_at;
}

static void take_lift(int disc, double time, void *user) {
  record *it = (record *)user;
  assert_int_equal(disc, 0);
  if (it->lifts == 0) it->first_lift = time;
  if (it->lifts == 1) it->second_lift = time;
  it->lifts++;
}

static void take_note(const char *text, void *user) {
  record *it = (record *)user;
  it->notes++;
  snprintf(it->note, sizeof it->note, "%s", text);
}

static runner_any_def def_of(double duration, record *out) {
  return (runner_any_def){.duration = duration,
                          .sample = 0.01,
                          .on_sample = take,
                          .on_lift = take_lift,
                          .on_note = take_note,
                          .user = out};
}

static runner_status ride(runner_any_result *result, runner_any *r, const runner_any_def *def) {
  mjcf_error error = {.text = ""};
  runner_status status = runner_any_ride(result, r, def, &error);
  assert_int_equal(status != RUNNER_OK, strlen(error.text) > 0);
  return status;
}

// The ground carries 49.05 - 60 sin 20t N: it would pull from asin(0.8175)/20 on, and again a turn
// later.
static void test_lifts_of_a_closed_form(void **state) {
  (void)state;
  runner_any *r = load(models, "pogo.xml");
  record it = {0};
  runner_any_def def = def_of(0.5, &it);
  runner_any_result result;
  start(r);
  assert_int_equal(ride(&result, r, &def), RUNNER_OK);
  assert_true(result.complete);
  assert_int_equal(it.rows, 51);
  assert_int_equal(result.steps, 500);
  assert_int_equal(it.lifts, 2);
  double lift = asin(49.05 / 60) / 20, turn = 2 * mjPI / 20;
  // The chord over a step of 1 ms: h^2/8 F''/F' = 2e-5 s at 49 degrees.
  assert_near(it.first_lift, lift, 1e-4);
  assert_near(it.second_lift, lift + turn, 1e-4);
  assert_near(it.force, 49.05 - 60 * sin(20 * 0.5), 1e-8);
  // Straight on, and no faster: the load jumps straight up.
  assert_near(it.qpos[0], 1.5, 1e-10);
  assert_near(it.qpos[1], 0, 1e-10);
  assert_near(it.qpos[3], 0.05 * sin(20 * 0.5), 1e-9);
  assert_below(it.height, 1e-10);
  runner_any_free(r);
}

static void test_a_lift_may_end_the_ride(void **state) {
  (void)state;
  runner_any *r = load(models, "pogo.xml");
  record it = {0};
  runner_any_def def = def_of(0.5, &it);
  def.stop_at_lift = true;
  runner_any_result result;
  start(r);
  assert_int_equal(ride(&result, r, &def), RUNNER_OK);
  assert_false(result.complete);
  assert_near(result.end_time, it.first_lift, 0);
  assert_int_equal(it.rows, 5); // 0 to 40 ms
  runner_any_free(r);
}

static void test_examples_ride(void **state) {
  (void)state;
  static const char *const names[] = {"disc.xml",   "slope.xml",   "tricycle.xml",
                                      "sleigh.xml", "bicycle.xml", "bicycle_stops.xml",
                                      "sway.xml"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
    runner_any *r = load(examples, names[i]);
    record it = {0};
    runner_any_def def = def_of(0.5, &it);
    runner_any_result result;
    start(r);
    assert_int_equal(ride(&result, r, &def), RUNNER_OK);
    assert_int_equal(it.rows, 51);
    assert_near(it.time, 0.5, 0);
    assert_below(it.slip, 1e-9);
    assert_below(it.height, 1e-10);
    // Repeated constraints are no accident, but somebody should know.
    bool tricycle = strcmp(names[i], "tricycle.xml") == 0;
    assert_int_equal(it.notes, tricycle);
    if (tricycle) assert_non_null(strstr(it.note, "repeat"));
    runner_any_free(r);
  }
}

static void test_the_caller_may_stop(void **state) {
  (void)state;
  runner_any *r = load(examples, "disc.xml");
  record it = {.stop_at = 3};
  runner_any_def def = def_of(0.5, &it);
  runner_any_result result;
  start(r);
  assert_int_equal(ride(&result, r, &def), RUNNER_INTERRUPTED);
  assert_int_equal(it.rows, 3);
  def.on_sample = NULL;
  assert_int_equal(ride(&result, r, &def), RUNNER_ARGUMENT);
  def = def_of(0.5, &it);
  def.sample = 0.0105;
  assert_int_equal(ride(&result, r, &def), RUNNER_ARGUMENT);
  runner_any_free(r);
}

//---------------------------------- what goes wrong -----------------------------------------------

// Loads a text as a file; NULL with what was said.
static runner_any *load_text(const char *text, runner_status *status, mjcf_error *error) {
  FILE *out = fopen("model.xml", "w");
  fputs(text, out);
  fclose(out);
  runner_any *r = runner_any_load("model.xml", status, error);
  unlink("model.xml");
  return r;
}

// A free disc of 0.3 m with a marker and what else there is, at a place.
static void disc_text(char out[1500], const char *marker, const char *more, const char *at) {
  snprintf(out, 1500,
           "<mujoco><compiler angle=\"radian\"/><option integrator=\"RK4\"/>"
           "<custom><tuple name=\"rolling_discs\">%s</tuple></custom><worldbody>%s"
           "<body name=\"disc\"><freejoint name=\"free\"/><inertial pos=\"0 0 0\" mass=\"2\" "
           "diaginertia=\"0.045 0.045 0.09\"/><geom name=\"rim\" type=\"cylinder\" "
           "size=\"0.3 0.01\" contype=\"0\" conaffinity=\"0\"/></body></worldbody>"
           "<keyframe><key name=\"test\" %s/></keyframe></mujoco>",
           marker, more, at);
}

// z of the disc to the left: (1, 0, 0) by -90 degrees.
#define UPRIGHT "qpos=\"0 0 0.3 0.70710678118654757 -0.70710678118654757 0 0\""
#define RIM "<element objtype=\"geom\" objname=\"rim\"/>"

typedef struct fault {
  const char *marker, *more, *at;
  runner_status status; // of loading or, where that is right, of the start
  const char *says;
} fault;

static void check_fault(const fault *f) {
  char text[1500];
  runner_status status;
  mjcf_error error = {.text = ""};
  disc_text(text, f->marker, f->more, f->at);
  runner_any *r = load_text(text, &status, &error);
  if (r) status = runner_any_start(r, false, NULL, &error);
  if (status != f->status || !strstr(error.text, f->says))
    fail_msg("status %d: %s; must say: %s", (int)status, error.text, f->says);
  runner_any_free(r);
}

// Each ends with a line of its own, and none waits for a key.
static void test_faults(void **state) {
  (void)state;
  static const fault faults[] = {
      {RIM, "", UPRIGHT, RUNNER_OK, ""},
      {RIM, "", UPRIGHT " qvel=\"1 0 0 0 0 -3.3\"", RUNNER_START, "keyframe 'test'"},
      {RIM, "", "qpos=\"0 0 0.4 0.70710678118654757 -0.70710678118654757 0 0\"", RUNNER_START,
       "off the ground"},
      {RIM, "", "qpos=\"0 0 0.3 1 0 0 0\"", RUNNER_INVALID_WARNING,
       "'rim' at 0 s: a rolling disc lies flat"},
      {"", "", UPRIGHT, RUNNER_MODEL, "tuple 'rolling_discs' (id = 0) is empty"},
      {"<element objtype=\"geom\" objname=\"nosuch\"/>", "", UPRIGHT, RUNNER_MODEL,
       "unrecognized object 'nosuch' in tuple"},
      {"<element objtype=\"body\" objname=\"nosuch\"/>", "", UPRIGHT, RUNNER_MODEL, "nosuch"},
      {RIM "<element objtype=\"geom\" objname=\"ball\" prm=\"-1\"/>",
       "<geom name=\"ball\" size=\"1\"/>", UPRIGHT, RUNNER_ARGUMENT,
       "not a positive number (geom 'ball')"},
      {RIM "<element objtype=\"body\" objname=\"disc\" prm=\"0.3\"/>", "", UPRIGHT, RUNNER_ARGUMENT,
       "last joint of a disc's body is not a hinge (body 'disc')"},
      {"<element objtype=\"geom\" objname=\"box\" prm=\"0\"/>",
       "<body><freejoint/><geom name=\"box\" type=\"box\" size=\"1 1 1\"/></body>", "",
       RUNNER_ARGUMENT, "radius"},
      {"<element objtype=\"geom\" objname=\"ball\"/>", "<geom name=\"ball\" size=\"1\"/>", UPRIGHT,
       RUNNER_ARGUMENT, "cannot move"},
      {"<element objtype=\"geom\" objname=\"raft\"/>" RIM,
       "<body mocap=\"true\"><geom name=\"raft\" type=\"plane\" size=\"1 1 1\"/></body>", UPRIGHT,
       RUNNER_ARGUMENT, "plane belongs to a body that can move (geom 'raft')"},
      {RIM "</tuple><tuple name=\"rolling_plane\">" RIM, "", UPRIGHT, RUNNER_MODEL,
       "rolling_discs, rolling_skates, rolling_driven (tuple 'rolling_plane')"},
      {RIM "</tuple><tuple name=\"rolling_driven\"><element objtype=\"joint\" objname=\"free\"/>",
       "", UPRIGHT, RUNNER_ARGUMENT, "no slide or hinge joint (joint 'free')"},
      {RIM "<element objtype=\"geom\" objname=\"rim\" prm=\"0.2\"/>", "", UPRIGHT, RUNNER_START,
       "off the ground"},
  };
  for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) check_fault(&faults[i]);
  mjcf_error error = {.text = ""};
  runner_status status;
  assert_null(load_text("<mujoco><worldbody><body><freejoint/><geom size=\"1\"/></body></worldbody>"
                        "</mujoco>",
                        &status, &error));
  assert_int_equal(status, RUNNER_MODEL);
  assert_non_null(strstr(error.text, "no tuple"));
}

// Of several sensors, the one that is wrong.
static void test_a_wrong_sensor_is_named(void **state) {
  (void)state;
  char text[1500], world[1800];
  runner_status status;
  mjcf_error error = {.text = ""};
  disc_text(text, RIM, "", UPRIGHT);
  char *end = strstr(text, "</mujoco>");
  assert_non_null(end);
  *end = '\0';
  snprintf(
      world, sizeof world,
      "%s<sensor><user name=\"rolling:rim:normal\" objtype=\"body\" objname=\"disc\" dim=\"1\" "
      "datatype=\"real\" needstage=\"acc\"/><user name=\"rolling:rim:nosuch\" objtype=\"body\" "
      "objname=\"disc\" dim=\"1\" datatype=\"real\" needstage=\"acc\"/></sensor></mujoco>",
      text);
  assert_null(load_text(world, &status, &error));
  assert_int_equal(status, RUNNER_ARGUMENT);
  if (!strstr(error.text, "(sensor 'rolling:rim:nosuch')")) fail_msg("%s", error.text);
}

// Two discs on one body that ask for the same: it rolls, and a note says so where none did before.
static void test_two_discs_on_one_body(void **state) {
  (void)state;
  char text[1500];
  runner_status status;
  mjcf_error error = {.text = ""};
  disc_text(text, RIM "<element objtype=\"geom\" objname=\"rim\" prm=\"0.3\"/>", "",
            UPRIGHT " qvel=\"3 0 0 0 0 10\"");
  runner_any *r = load_text(text, &status, &error);
  if (!r) fail_msg("%s", error.text);
  record it = {0};
  runner_any_def def = def_of(0.1, &it);
  runner_any_result result;
  start(r);
  assert_int_equal(ride(&result, r, &def), RUNNER_OK);
  assert_near(it.qpos[0], 0.3, 1e-10);
  assert_near(it.force, 9.81, 1e-9); // the smallest forces: each carries half
  runner_any_free(r);
}

static void test_a_start_is_put_right(void **state) {
  (void)state;
  char text[1500];
  runner_status status;
  mjcf_error error = {.text = ""};
  double moved = 0;
  disc_text(text, RIM, "", "qpos=\"0 0 0.35 0.70710678118654757 -0.70710678118654757 0 0\"");
  runner_any *r = load_text(text, &status, &error);
  assert_non_null(r);
  if (runner_any_start(r, true, &moved, &error) != RUNNER_OK) fail_msg("%s", error.text);
  assert_near(moved, 0.05, 1e-12);
  record it = {0};
  runner_any_def def = def_of(0.1, &it);
  runner_any_result result;
  assert_int_equal(ride(&result, r, &def), RUNNER_OK);
  assert_near(it.qpos[2], 0.3, 1e-12);
  runner_any_free(r);
}

// MuJoCo's own warnings end a ride: controls that are not numbers, masses that are none.
static void test_mujocos_warnings(void **state) {
  (void)state;
  runner_any *r = load(examples, "bicycle.xml");
  mjcf_error error = {.text = ""};
  runner_any_model(r)->key_ctrl[0] = NAN;
  assert_int_equal(runner_any_start(r, false, NULL, &error), RUNNER_INVALID_WARNING);
  assert_non_null(strstr(error.text, "CTRL"));
  runner_any_free(r);

  r = load(examples, "bicycle.xml");
  mjModel *m = runner_any_model(r);
  int wheel = mj_name2id(m, mjOBJ_BODY, "front_wheel");
  m->body_mass[wheel] = 0;
  mju_zero(m->body_inertia + 3 * wheel, 3);
  assert_int_equal(runner_any_start(r, false, NULL, &error), RUNNER_INVALID_WARNING);
  assert_non_null(strstr(error.text, "singular"));
  runner_any_free(r);
}

// Steps far too long: the wheel leaves the ground, and the ride ends before nonsense comes out.
static void test_lost_ground(void **state) {
  (void)state;
  runner_any *r = load(examples, "slope.xml");
  record it = {0};
  runner_any_def def = def_of(20, &it);
  runner_any_result result;
  mjcf_error error = {.text = ""};
  runner_any_model(r)->opt.timestep = 0.2;
  def.sample = 0.2;
  start(r);
  assert_true(runner_any_ride(&result, r, &def, &error) >= RUNNER_INVALID_ERROR);
  print_message("%s\n", error.text);
  assert_true(result.end_time < 20);
  runner_any_free(r);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_lifts_of_a_closed_form),
                                     cmocka_unit_test(test_a_lift_may_end_the_ride),
                                     cmocka_unit_test(test_examples_ride),
                                     cmocka_unit_test(test_the_caller_may_stop),
                                     cmocka_unit_test(test_faults),
                                     cmocka_unit_test(test_a_wrong_sensor_is_named),
                                     cmocka_unit_test(test_two_discs_on_one_body),
                                     cmocka_unit_test(test_a_start_is_put_right),
                                     cmocka_unit_test(test_mujocos_warnings),
                                     cmocka_unit_test(test_lost_ground)};
  own_folder folder = enter_own_folder();
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  leave_own_folder(&folder);
  return failed;
}
