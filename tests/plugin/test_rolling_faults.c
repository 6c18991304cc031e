// SPDX-License-Identifier: Apache-2.0
// What the library does with faulty markers, states, stacks and controls, and what it says.
#include "rolling_support.h"

#include <string.h>

static int warnings;
static char last_warning[1000];

static void note_warning(const char *text) {
  warnings++;
  snprintf(last_warning, sizeof last_warning, "%s", text);
}

static int install(void **state) {
  mju_user_warning = note_warning;
  return install_rolling(state);
}

// What roll_check says of a model and of what in it.
static void check_says(const mjModel *m, roll_error expected, int type, int id) {
  roll_object where = {-7, -7};
  assert_int_equal(roll_check(&where, m), expected);
  assert_int_equal(where.type, type);
  if (type != mjOBJ_UNKNOWN) assert_int_equal(where.id, id);
  assert_int_equal(roll_check(NULL, m), expected);
}

static void check_is_right(const mjModel *m) {
  check_says(m, ROLL_OK, mjOBJ_UNKNOWN, -1);
}

static void test_faulty_markers(void **unused) {
  (void)unused;
  mjModel *good = load("bicycle.xml");
  int joint = mj_name2id(good, mjOBJ_JOINT, "steer"), frame = 1;
  const struct {
    int type, id;
    mjtNum radius;
    roll_error error;
  } faults[] = {
      {mjOBJ_JOINT, joint, 0.3, ROLL_BAD_OBJECT}, {mjOBJ_BODY, 0, 0.3, ROLL_FIXED_BODY},
      {mjOBJ_BODY, frame, 0, ROLL_BAD_RADIUS},    {mjOBJ_BODY, frame, -1, ROLL_BAD_RADIUS},
      {mjOBJ_BODY, frame, NAN, ROLL_BAD_RADIUS},  {mjOBJ_BODY, frame, INFINITY, ROLL_BAD_RADIUS},
  };
  check_is_right(good);
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
    mjModel *m = mj_copyModel(NULL, good);
    m->tuple_objtype[1] = faults[i].type;
    m->tuple_objid[1] = faults[i].id;
    m->tuple_objprm[1] = faults[i].radius;
    check_says(m, faults[i].error, faults[i].type, faults[i].id);
    // the other disc rolls on
    mjData *d = mj_makeData(m);
    roll_disc disc[2];
    mj_forward(m, d);
    assert_int_equal(roll_discs(disc, 2, m, d), faults[i].error);
    assert_int_equal(disc[0].error, ROLL_OK);
    assert_true(disc[0].normal_force > 100);
    assert_int_equal(disc[1].error, faults[i].error);
    assert_true(disc[1].normal_force == 0);
    assert_int_equal(roll_project(m, d), faults[i].error);
    mj_deleteData(d);
    mj_deleteModel(m);
  }
  mj_deleteModel(good);
}

static void test_no_axle(void **unused) {
  (void)unused;
  mjModel *m = load("disc_free.xml");
  m->tuple_objtype[0] = mjOBJ_BODY;
  m->tuple_objid[0] = 1;
  check_says(m, ROLL_NO_AXLE, mjOBJ_BODY, 1);
  mj_deleteModel(m);
}

enum { GROUND, SKATE, DRIVEN }; // addresses in the cart's tuples

// One element of them spoilt: the error, and that only this one is left free.
static void expect_fault(roll_error expected, int address, int type, int id, mjtNum prm) {
  mjModel *m = load("cart.xml");
  m->tuple_objtype[address] = type;
  m->tuple_objid[address] = id;
  m->tuple_objprm[address] = prm;
  check_says(m, expected, type, id);
  mjData *d = mj_makeData(m);
  roll_drive drive;
  mj_forward(m, d);
  for (int i = 0; i < m->nv; i++) assert_true(isfinite(d->qacc[i]));
  assert_int_equal(roll_drives(&drive, 1, m, d), expected);
  assert_int_equal(drive.error, address == DRIVEN ? expected : ROLL_OK);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void test_faulty_skates_and_drives(void **unused) {
  (void)unused;
  mjModel *m = load("cart.xml");
  int blade = mj_name2id(m, mjOBJ_GEOM, "blade"), load_joint = mj_name2id(m, mjOBJ_JOINT, "load");
  int body = mj_name2id(m, mjOBJ_BODY, "sleigh");
  check_is_right(m);
  expect_fault(ROLL_BAD_SKATE, SKATE, mjOBJ_BODY, body, 0);
  expect_fault(ROLL_BAD_RADIUS, SKATE, mjOBJ_GEOM, blade, -0.1);
  expect_fault(ROLL_BAD_RADIUS, SKATE, mjOBJ_GEOM, blade, NAN);
  expect_fault(ROLL_BAD_JOINT, DRIVEN, mjOBJ_GEOM, blade, 0);
  expect_fault(ROLL_BAD_DRIVE, DRIVEN, mjOBJ_JOINT, load_joint, 4);
  expect_fault(ROLL_BAD_DRIVE, DRIVEN, mjOBJ_JOINT, load_joint, -1);
  expect_fault(ROLL_BAD_DRIVE, DRIVEN, mjOBJ_JOINT, load_joint, 0.5);
  expect_fault(ROLL_BAD_DRIVE, DRIVEN, mjOBJ_JOINT, load_joint, NAN);
  mj_deleteModel(m);

  m = load("sway.xml");
  m->numeric_size[0] = 3;
  check_says(m, ROLL_BAD_DRIVE, mjOBJ_JOINT, mj_name2id(m, mjOBJ_JOINT, "rider"));
  mj_deleteModel(m);
}

static void test_ground_that_moves(void **unused) {
  (void)unused;
  mjModel *m = load("slope.xml");
  int plane = mj_name2id(m, mjOBJ_GEOM, "hillside");
  m->geom_bodyid[plane] = mj_name2id(m, mjOBJ_BODY, "disc");
  check_says(m, ROLL_BAD_GROUND, mjOBJ_GEOM, plane);
  m->geom_bodyid[plane] = mj_name2id(m, mjOBJ_BODY, "slope");
  check_is_right(m);
  m->body_mocapid[m->geom_bodyid[plane]] = 0;
  check_says(m, ROLL_BAD_GROUND, mjOBJ_GEOM, plane);
  mj_deleteModel(m);
}

static void test_bad_sensors(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  int id = mj_name2id(m, mjOBJ_SENSOR, "rolling:front_wheel:height");
  char *name = m->names + m->name_sensoradr[id];
  check_is_right(m);
  name[strlen(name) - 1] = 's'; // no quantity
  check_says(m, ROLL_BAD_SENSOR, mjOBJ_SENSOR, id);
  name[strlen(name) - 1] = 't';
  name[strlen("rolling:")] = 'F'; // no wheel
  check_says(m, ROLL_BAD_SENSOR, mjOBJ_SENSOR, id);
  name[strlen("rolling:")] = 'f';
  m->sensor_dim[id] = 3;
  check_says(m, ROLL_BAD_SENSOR, mjOBJ_SENSOR, id);
  m->sensor_dim[id] = 1;
  m->sensor_needstage[id] = mjSTAGE_POS;
  check_says(m, ROLL_BAD_SENSOR, mjOBJ_SENSOR, id);
  m->sensor_needstage[id] = mjSTAGE_ACC;
  memcpy(name, "rolling:model:energy", sizeof "rolling:model:energy");
  check_is_right(m);
  name[strlen(name) - 1] = 'z'; // the model has no such quantity
  check_says(m, ROLL_BAD_SENSOR, mjOBJ_SENSOR, id);
  memcpy(name, "rolling:energy", sizeof "rolling:energy"); // of what?
  check_says(m, ROLL_BAD_SENSOR, mjOBJ_SENSOR, id);
  memcpy(name, "scrolling:energy", sizeof "scrolling:energy"); // somebody else's
  check_is_right(m);
  mj_deleteModel(m);
}

//---------------------------------- names that would be passed over -------------------------------

// A wheel and the custom elements of its model.
static mjModel *load_custom(const char *custom) {
  char text[1500];
  snprintf(text, sizeof text,
           "<mujoco><size nuserdata=\"3\"/><custom>%s</custom><worldbody><body name=\"wheel\">"
           "<joint name=\"lift\" type=\"slide\"/><joint name=\"spin\" axis=\"0 1 0\"/>"
           "<geom name=\"rim\" size=\"0.3\"/></body></worldbody></mujoco>",
           custom);
  return load_text(text);
}

#define TUPLE(name) "<tuple name=\"" name "\"><element objtype=\"geom\" objname=\"rim\"/></tuple>"
#define NUMERIC(name) "<numeric name=\"" name "\" data=\"0\"/>"
#define DRIVE                                                                                      \
  "<tuple name=\"rolling_driven\"><element objtype=\"joint\" objname=\"lift\" prm=\"0\"/></tuple>"

static void test_names(void **unused) {
  (void)unused;
  static const struct {
    const char *custom;
    roll_error error;
    int type, id;
    const char *says;
  } cases[] = {
      {TUPLE("rolling_discs"), ROLL_OK, mjOBJ_UNKNOWN, -1, "no error"},
      {TUPLE("contact_discs"), ROLL_NO_MARKER, mjOBJ_UNKNOWN, -1, "no tuple 'rolling_discs'"},
      {TUPLE("rolling_disks"), ROLL_BAD_NAME, mjOBJ_TUPLE, 0,
       "rolling_discs, rolling_skates, rolling_driven (tuple 'rolling_disks')"},
      {TUPLE("rolling_discs") TUPLE("rolling_plane"), ROLL_BAD_NAME, mjOBJ_TUPLE, 1,
       "(tuple 'rolling_plane')"},
      {TUPLE("rolling_discs2"), ROLL_BAD_NAME, mjOBJ_TUPLE, 0, "(tuple 'rolling_discs2')"},
      {TUPLE("rolling_"), ROLL_BAD_NAME, mjOBJ_TUPLE, 0, "(tuple 'rolling_')"},
      {TUPLE("rolling_discs") NUMERIC("rolling_radius"), ROLL_BAD_NAME, mjOBJ_NUMERIC, 0,
       "(numeric 'rolling_radius')"},
      {NUMERIC("own") NUMERIC("rolling_driven"), ROLL_BAD_NAME, mjOBJ_NUMERIC, 1,
       "(numeric 'rolling_driven')"},
      {TUPLE("rolling_discs") "<text name=\"rolling_ground\" data=\"rim\"/>", ROLL_BAD_NAME,
       mjOBJ_TEXT, 0, "(text 'rolling_ground')"},
      {NUMERIC("unrolling_discs") TUPLE("trolling_discs"), ROLL_NO_MARKER, mjOBJ_UNKNOWN, -1, ""},
      {DRIVE NUMERIC("driven:lift"), ROLL_OK, mjOBJ_UNKNOWN, -1, ""},
      {DRIVE NUMERIC("driven:lfit"), ROLL_NOT_DRIVEN, mjOBJ_NUMERIC, 0, "(numeric 'driven:lfit')"},
      {DRIVE NUMERIC("driven:spin"), ROLL_NOT_DRIVEN, mjOBJ_NUMERIC, 0, "no joint of the tuple"},
      {NUMERIC("driven:lift"), ROLL_NO_MARKER, mjOBJ_UNKNOWN, -1, ""}, // somebody else's
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    mjModel *m = load_custom(cases[i].custom);
    char text[300];
    roll_object where;
    check_says(m, cases[i].error, cases[i].type, cases[i].id);
    roll_fault_string(text, sizeof text, roll_check(&where, m), where, m);
    if (!strstr(text, cases[i].says)) fail_msg("'%s' does not say '%s'", text, cases[i].says);
    mj_deleteModel(m);
  }
}

static void test_work_of_nothing(void **unused) {
  (void)unused;
  mjModel *m = load("sway.xml");
  int id = mj_name2id(m, mjOBJ_ACTUATOR, "rolling:rider:work");
  char *name = m->names + m->name_actuatoradr[id];
  check_is_right(m);
  name[strlen("rolling:")] = 'R'; // no such joint
  check_says(m, ROLL_BAD_ACTUATOR, mjOBJ_ACTUATOR, id);
  name[strlen("rolling:")] = 'r';
  name[strlen(name) - 1] = 'd'; // no such quantity
  check_says(m, ROLL_BAD_ACTUATOR, mjOBJ_ACTUATOR, id);
  name[strlen(name) - 1] = 'k';
  m->actuator_dyntype[id] = mjDYN_INTEGRATOR; // MuJoCo would not ask
  check_says(m, ROLL_BAD_ACTUATOR, mjOBJ_ACTUATOR, id);
  mj_deleteModel(m);
}

// A text as long as there is room, whatever the object is called.
static void test_fault_strings(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  char text[400], few[10];
  int rear = mj_name2id(m, mjOBJ_BODY, "rear_wheel");
  roll_fault_string(text, sizeof text, ROLL_NO_AXLE, (roll_object){mjOBJ_BODY, rear}, m);
  assert_string_equal(text, "rolling_discs: the last joint of a disc's body is not a hinge (body "
                            "'rear_wheel')");
  roll_fault_string(few, sizeof few, ROLL_NO_AXLE, (roll_object){mjOBJ_BODY, rear}, m);
  assert_string_equal(few, "rolling_d");
  m->names[m->name_bodyadr[rear]] = '\0';
  roll_fault_string(text, sizeof text, ROLL_FLAT, (roll_object){mjOBJ_BODY, rear}, m);
  assert_non_null(strstr(text, " (body 2)"));
  mj_deleteModel(m);
}

// A massless wheel makes the mass matrix singular: MuJoCo warns, and nothing hangs or crashes.
static void test_singular_mass_matrix(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  int wheel = mj_name2id(m, mjOBJ_BODY, "front_wheel");
  m->body_mass[wheel] = 0;
  mju_zero(m->body_inertia + 3 * wheel, 3);
  mjData *d = mj_makeData(m);
  for (int i = 0; i < 10; i++) mj_step(m, d);
  assert_true(d->warning[mjWARN_INERTIA].number > 0);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void test_flat_disc_is_left_free(void **unused) {
  (void)unused;
  mjModel *m = load("disc_free.xml");
  mjData *d = mj_makeData(m);
  d->qpos[2] = 1;
  mju_axisAngle2Quat(d->qpos + 3, (mjtNum[3]){1, 0, 0}, 1.5707963267948966);
  roll_disc disc;
  mj_forward(m, d);
  assert_int_equal(roll_discs(&disc, 1, m, d), ROLL_FLAT);
  assert_int_equal(disc.error, ROLL_FLAT);
  assert_near(d->qacc[2], -9.81, 1e-12);
  assert_int_equal(roll_project(m, d), ROLL_FLAT);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void test_small_stack(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  roll_disc disc[2];
  mj_forward(m, d);
  int whole = d->nstack;
  d->nstack = 200;
  mj_forward(m, d);
  assert_int_equal(roll_discs(disc, 2, m, d), ROLL_NO_STACK);
  assert_int_equal(disc[1].error, ROLL_NO_STACK);
  assert_int_equal(roll_project(m, d), ROLL_NO_STACK);
  assert_int_equal(d->pstack, 0);
  d->nstack = whole;
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void step_often(const mjModel *m, int warnings_after_one, int warnings_after_many) {
  mjData *d = mj_makeData(m);
  warnings = 0;
  mj_step(m, d);
  assert_int_equal(warnings, warnings_after_one);
  for (int i = 0; i < 20; i++) mj_step(m, d);
  assert_int_equal(warnings, warnings_after_many);
  mj_deleteData(d);
}

// Each complaint is made once, through mju_warning, and not before the second step.
static void test_warnings(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml"), *blind = load("obstacle.xml"), *off = load("disc_free.xml");
  mjModel *bad = mj_copyModel(NULL, m), *twice = load("tricycle.xml");
  mjModel *misspelt = load_custom(TUPLE("rolling_disks"));
  mjModel *asks = load_text(
      "<mujoco><worldbody><body name=\"b\"><freejoint/><geom size=\"1\"/></body></worldbody>"
      "<sensor><user name=\"rolling:model:enrgy\" objtype=\"body\" objname=\"b\" "
      "datatype=\"real\" dim=\"1\" needstage=\"acc\"/></sensor></mujoco>");
  bad->tuple_objprm[0] = -1;
  off->qpos0[2] += 0.01;
  step_often(m, 0, 0);
  step_often(bad, 0, 1);
  assert_non_null(strstr(last_warning, roll_error_string(ROLL_BAD_RADIUS)));
  assert_non_null(strstr(last_warning, "(body 'rear_wheel')"));
  step_often(bad, 0, 0);
  step_often(blind, 0, 1);
  assert_non_null(strstr(last_warning, "sensors"));
  step_often(asks, 0, 1);
  assert_non_null(strstr(last_warning, "(sensor 'rolling:model:enrgy')"));
  step_often(twice, 0, 1);
  assert_non_null(strstr(last_warning, "repeat"));
  step_often(off, 0, 1);
  assert_non_null(strstr(last_warning, "roll_project"));
  step_often(misspelt, 0, 1);
  assert_non_null(strstr(last_warning, "rolling_driven (tuple 'rolling_disks')"));
  step_often(misspelt, 0, 0);
  mj_deleteModel(misspelt);
  mj_deleteModel(asks);
  mj_deleteModel(twice);
  mj_deleteModel(bad);
  mj_deleteModel(off);
  mj_deleteModel(blind);
  mj_deleteModel(m);
}

// A bad control goes MuJoCo's own way: its warning, and zero in its place.
static void test_nan_control(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  d->ctrl[0] = NAN;
  mj_forward(m, d);
  assert_true(d->warning[mjWARN_BADCTRL].number > 0);
  for (int i = 0; i < m->nv; i++) assert_near(d->qacc[i], 0, 1e-10);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void test_error_strings(void **unused) {
  (void)unused;
  assert_string_equal(roll_error_string(ROLL_OK), "no error");
  for (int i = ROLL_OK; i <= ROLL_NOT_INSTALLED; i++)
    assert_true(strlen(roll_error_string((roll_error)i)) > 5);
  assert_non_null(roll_error_string((roll_error)-1));
  assert_non_null(roll_error_string((roll_error)1000));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_faulty_markers),
      cmocka_unit_test(test_no_axle),
      cmocka_unit_test(test_faulty_skates_and_drives),
      cmocka_unit_test(test_ground_that_moves),
      cmocka_unit_test(test_bad_sensors),
      cmocka_unit_test(test_names),
      cmocka_unit_test(test_work_of_nothing),
      cmocka_unit_test(test_fault_strings),
      cmocka_unit_test(test_singular_mass_matrix),
      cmocka_unit_test(test_flat_disc_is_left_free),
      cmocka_unit_test(test_small_stack),
      cmocka_unit_test(test_warnings),
      cmocka_unit_test(test_nan_control),
      cmocka_unit_test(test_error_strings),
  };
  return cmocka_run_group_tests(tests, install, uninstall_rolling);
}
