// SPDX-License-Identifier: Apache-2.0
// Sensors that see the ground: user sensors of the discs, and MuJoCo's own force sensors.
#include "rolling_support.h"

// Benchmark bicycle at rest: the fork carries the front load less the wheel's weight,
// 309.303529411765 - 3 * 9.81 N; MuJoCo alone says 3 * 9.81.
static void test_fork_on_wheel(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  mj_forward(m, d);
  const mjtNum *fork = sensor(m, d, "fork_on_wheel");
  print_message("fork on front wheel: %.9f N\n", fork[2]);
  assert_near(fork[2], -279.873529411765, 1e-9);
  assert_near(fork[0], 0, 1e-9);
  assert_near(*sensor(m, d, "rolling:front_wheel:normal"), 309.303529411765, 1e-9);
  assert_near(*sensor(m, d, "rolling:rear_wheel:normal"), 612.836470588236, 1e-9);
  assert_near(*sensor(m, d, "rolling:front_wheel:lift"), 0, 0);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// Newton and Euler for the front wheel alone, in motion: what the fork and the ground do to it
// makes up its momentum's change. And the sums of all external forces, and of those on the world.
static void test_forces_balance_in_motion(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = start_from_key(m);
  for (int i = 0; i < 300; i++) mj_step(m, d);
  const mjtNum push[6] = {3, -8, 2, 0, 0, 0};
  mju_copy(d->xfrc_applied + 6, push, 6);
  mj_forward(m, d);
  roll_disc disc[2];
  assert_int_equal(roll_discs(disc, 2, m, d), ROLL_OK);
  int wheel = disc[1].body;
  const mjtNum *on_wheel = d->cfrc_ext + 6 * wheel + 3, *from_fork = d->cfrc_int + 6 * wheel + 3;
  mjtNum acceleration[6], com[3];
  mj_objectAcceleration(m, d, mjOBJ_BODY, wheel, acceleration, 0);
  mju_copy3(com, acceleration + 3); // the hub is its centre of mass
  for (int k = 0; k < 3; k++) {
    // objects' accelerations count gravity as an acceleration upwards
    assert_near(on_wheel[k], disc[1].force[k], 1e-10);
    assert_near(from_fork[k] + on_wheel[k], m->body_mass[wheel] * com[k], 1e-9);
    // seen from outside: the root joint carries nothing
    assert_near(d->cfrc_int[6 + 3 + k], 0, 1e-8);
    assert_near(d->cfrc_int[6 + k], 0, 1e-8);
  }
  // The force on the wheel in the wheel's frame, as the site has it.
  const mjtNum *site = d->site_xmat + 9 * mj_name2id(m, mjOBJ_SITE, "front_hub");
  mjtNum in_site[3];
  mju_rotVecMatT(in_site, from_fork, site);
  for (int k = 0; k < 3; k++) assert_near(sensor(m, d, "fork_on_wheel")[k], in_site[k], 1e-12);
  // A free hinge transmits no torque along its axle, ground forces and all.
  assert_near(sensor(m, d, "fork_twists_wheel")[1], 0, 1e-9);
  assert_true(mju_norm3(sensor(m, d, "fork_twists_wheel")) > 0.1);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// The same with a steer stop: the ground's answer to it is in the sensors too.
static void test_forces_balance_on_the_stop(void **unused) {
  (void)unused;
  for (int sparse = 0; sparse < 2; sparse++) {
    mjModel *m = load("bicycle_stops.xml");
    m->opt.jacobian = sparse ? mjJAC_SPARSE : mjJAC_DENSE;
    mjData *d = start_from_key(m);
    for (int i = 0; i < 400; i++) mj_step(m, d);
    mj_forward(m, d);
    assert_int_equal(d->nefc, 1);
    for (int k = 0; k < 6; k++) assert_near(d->cfrc_int[6 + k], 0, 1e-7);
    assert_near(sensor(m, d, "fork_twists_wheel")[1], 0, 1e-9);
    mj_deleteData(d);
    mj_deleteModel(m);
  }
}

// A disc rolling over a crest of its own lean: pushed up harder than it weighs, it would lift.
static void test_lift_off(void **unused) {
  (void)unused;
  mjModel *m = load("disc.xml");
  mjData *d = start_from_key(m);
  int body = mj_name2id(m, mjOBJ_BODY, "disc");
  roll_disc disc;
  mj_forward(m, d);
  assert_int_equal(roll_discs(&disc, 1, m, d), ROLL_OK);
  assert_int_equal(disc.lifts, 0);
  assert_near(*sensor(m, d, "rolling:rim:lift"), 0, 0);
  d->xfrc_applied[6 * body + 2] = 2 * 9.81 + 1;
  mj_forward(m, d);
  assert_int_equal(roll_discs(&disc, 1, m, d), ROLL_OK);
  assert_near(disc.normal_force, -1, 1e-12);
  assert_int_equal(disc.lifts, 1);
  assert_near(*sensor(m, d, "rolling:rim:lift"), 1, 0);
  assert_near(sensor(m, d, "rolling:rim:force")[2], -1, 1e-12);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// Energy of the whole model: what mj_forward says where the flag asks for it, and without it.
static void check_energy(const char *name, const char *quantity, int flag) {
  char text[1500];
  snprintf(
      text, sizeof text,
      "<mujoco><option><flag energy=\"%s\"/></option>%s"
      "<worldbody><body name=\"b\" pos=\"0 0 0.3\"><joint type=\"slide\" axis=\"1 0 0\"/>"
      "<joint type=\"slide\" axis=\"0 0 1\"/><joint type=\"hinge\" axis=\"0 1 0\"/>"
      "<inertial pos=\"0 0 0\" mass=\"2\" diaginertia=\"0.045 0.09 0.045\"/></body></worldbody>"
      "<sensor><user name=\"%s:%s\" objtype=\"body\" objname=\"b\" datatype=\"real\" dim=\"1\" "
      "needstage=\"acc\"/></sensor></mujoco>",
      flag ? "enable" : "disable",
      strcmp(name, "marked") == 0 ? "<custom><tuple name=\"rolling_discs\"><element "
                                    "objtype=\"body\" objname=\"b\" prm=\"0.3\"/></tuple>"
                                    "</custom>"
                                  : "",
      "rolling:model", quantity);
  mjModel *m = load_text(text);
  mjData *d = mj_makeData(m);
  d->qvel[0] = 3, d->qvel[2] = 10;
  mj_forward(m, d);
  // m g h = 2 * 9.81 * 0.3;  m v^2/2 + J w^2/2 = 9 + 4.5
  double potential = strcmp(quantity, "kinetic") == 0 ? 0 : 5.886;
  double kinetic = strcmp(quantity, "potential") == 0 ? 0 : 13.5;
  assert_near(d->sensordata[0], potential + kinetic, 1e-14);
  assert_int_equal(roll_check(NULL, m), strcmp(name, "marked") == 0 ? ROLL_OK : ROLL_NO_MARKER);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void test_energy_of_the_model(void **unused) {
  (void)unused;
  static const char *const quantities[] = {"energy", "kinetic", "potential"};
  for (int i = 0; i < 12; i++)
    check_energy(i / 6 ? "marked" : "unmarked", quantities[i % 3], i / 3 % 2);
}

static int calls;

static void other_sensor(const mjModel *m, mjData *d, int stage) {
  (void)m;
  (void)d;
  calls += stage == mjSTAGE_ACC;
}

static void test_sensors_are_chained(void **unused) {
  (void)unused;
  assert_int_equal(roll_uninstall(), ROLL_OK);
  assert_null(mjcb_sensor);
  mjcb_sensor = other_sensor;
  roll_install();
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  calls = 0;
  mj_forward(m, d);
  assert_int_equal(calls, 1);
  assert_near(*sensor(m, d, "rolling:front_wheel:normal"), 309.303529411765, 1e-9);
  mj_deleteData(d);
  mj_deleteModel(m);
  assert_int_equal(roll_uninstall(), ROLL_OK);
  assert_true(mjcb_sensor == other_sensor);
  mjcb_sensor = NULL;
  roll_install();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_fork_on_wheel),
      cmocka_unit_test(test_forces_balance_in_motion),
      cmocka_unit_test(test_forces_balance_on_the_stop),
      cmocka_unit_test(test_lift_off),
      cmocka_unit_test(test_energy_of_the_model),
      cmocka_unit_test(test_sensors_are_chained),
  };
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
