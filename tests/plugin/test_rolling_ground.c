// SPDX-License-Identifier: Apache-2.0
// The ground as a plane of any height and tilt; radii from geoms.
#include "rolling_support.h"

// Order of the joints of slope.xml and disc.xml.
enum { X, Y, Z, YAW, ROLL, SPIN, DOFS };

static const mjtNum mass = 2, radius = 0.3, axial = 0.09, gravity = 9.81; // slope.xml

// Gravity as the slope sees it.
static void gravity_on_slope(mjtNum g[3], const mjModel *m, mjData *d) {
  mj_kinematics(m, d);
  const mjtNum *R = d->geom_xmat + 9 * mj_name2id(m, mjOBJ_GEOM, "hillside");
  mju_rotVecMatT(g, m->opt.gravity, R);
}

// The same motion, started the same, on level ground under gravity that leans the other way.
static void test_slope_is_leaning_gravity(void **unused) {
  (void)unused;
  mjModel *slope = load("slope.xml"), *level = load("disc.xml");
  mjData *on_slope = mj_makeData(slope), *on_level = mj_makeData(level);
  gravity_on_slope(level->opt.gravity, slope, on_slope);
  const mjtNum qpos[DOFS] = {0, 0, 0.01, 0.4, 0.3, 0}, qvel[DOFS] = {1, 0.5, 0, -2, 0.5, 4};
  mju_copy(on_slope->qpos, qpos, DOFS);
  mju_copy(on_slope->qvel, qvel, DOFS);
  assert_int_equal(roll_project(slope, on_slope), ROLL_OK);
  mju_copy(on_level->qpos, on_slope->qpos, DOFS);
  mju_copy(on_level->qvel, on_slope->qvel, DOFS);

  worst w = ride(slope, on_slope, 2000);
  worst flat = ride(level, on_level, 2000);
  print_message("slope: height %.1e m, slip %.1e m/s, energy %.1e\n", w.height, w.slip, w.energy);
  // a wild ride: no worse than on level ground, but for rounding
  assert_below(w.height, 2 * flat.height);
  assert_below(w.slip, 2 * flat.slip);
  assert_below(w.height, 1e-11);
  assert_below(w.slip, 1e-9);
  assert_below(w.energy, 1e-10);
  roll_disc here, there;
  assert_int_equal(roll_discs(&here, 1, slope, on_slope), ROLL_OK);
  assert_int_equal(roll_discs(&there, 1, level, on_level), ROLL_OK);
  // rounding of coordinates some metres from the origin, over 2000 steps
  for (int i = 0; i < DOFS; i++) assert_near(on_slope->qpos[i], on_level->qpos[i], 1e-10);
  assert_near(here.normal_force, there.normal_force, 1e-9);
  assert_true(fabs(on_slope->qpos[Y]) > 0.1);
  mj_deleteData(on_slope);
  mj_deleteData(on_level);
  mj_deleteModel(slope);
  mj_deleteModel(level);
}

// Straight down the hill: acceleration g sin(tilt) / (1 + C/(m R^2)) of a disc that rolls along x
// where x points downhill.
static void test_downhill(void **unused) {
  (void)unused;
  mjModel *m = load("slope.xml");
  const mjtNum tilt = 0.35;
  const mjtNum half[4] = {cos(tilt / 2), 0, sin(tilt / 2), 0}; // about y: x goes down
  mju_copy4(m->body_quat + 4 * mj_name2id(m, mjOBJ_BODY, "slope"), half);
  mjData *d = mj_makeData(m);
  assert_int_equal(roll_project(m, d), ROLL_OK);
  mjtNum expected = gravity * sin(tilt) / (1 + axial / (mass * radius * radius));
  assert_near(d->qacc[X], expected, 1e-12);
  assert_near(d->qacc[SPIN], expected / radius, 1e-12);
  roll_disc disc;
  assert_int_equal(roll_discs(&disc, 1, m, d), ROLL_OK);
  assert_near(disc.normal_force, mass * gravity * cos(tilt), 1e-12);
  for (int i = 0; i < 1000; i++) mj_step(m, d);
  assert_near(d->qpos[X], expected / 2, 1e-10);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static mjtNum radius_of(const char *type, const char *size) {
  static const char text[] =
      "<mujoco><custom><tuple name='rolling_discs'><element objtype='geom' objname='rim'/></tuple>"
      "</custom><worldbody><body pos='0 0 1'><freejoint/>"
      "<geom name='rim' type='%s' size='%s' zaxis='0 1 0' mass='1'/></body></worldbody></mujoco>";
  char filled[sizeof text + 100];
  snprintf(filled, sizeof filled, text, type, size);
  mjModel *m = load_text(filled);
  mjData *d = mj_makeData(m);
  roll_disc disc;
  mj_forward(m, d);
  roll_discs(&disc, 1, m, d);
  mj_deleteData(d);
  mj_deleteModel(m);
  return disc.radius;
}

static void test_radius_of_geoms(void **unused) {
  (void)unused;
  assert_near(radius_of("cylinder", "0.35 0.01"), 0.35, 0);
  assert_near(radius_of("sphere", "0.25"), 0.25, 0);
  assert_near(radius_of("ellipsoid", "0.4 0.4 0.001"), 0.4, 0);
  assert_near(radius_of("box", "0.4 0.4 0.1"), 0, 0); // refused: not round
}

// A body has the radius of its round geom, unless there are two.
static void test_radius_of_bodies(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  roll_disc disc[2];
  m->tuple_objprm[0] = m->tuple_objprm[1] = 0;
  mj_forward(m, d);
  assert_int_equal(roll_discs(disc, 2, m, d), ROLL_OK);
  assert_near(disc[0].radius, 0.3, 0);
  assert_near(disc[1].radius, 0.35, 0);
  mj_deleteData(d);
  mj_deleteModel(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_slope_is_leaning_gravity),
      cmocka_unit_test(test_downhill),
      cmocka_unit_test(test_radius_of_geoms),
      cmocka_unit_test(test_radius_of_bodies),
  };
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
