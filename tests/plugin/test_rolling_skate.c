// SPDX-License-Identifier: Apache-2.0
// Skates: Chaplygin's sleigh against its closed form, and blades on slopes.
#include "rolling_support.h"

enum { X, Y, Z, YAW, SLEIGH_DOFS };

// sleigh.xml: mass m, inertia I about the centre of mass, which is a before the blade.
static const double mass = 5, inertia = 0.6, ahead = 0.4;

typedef struct sleigh {
  double speed, turning, yaw; // m/s along the blade, rad/s, rad
} sleigh;

// v' = a w^2, (I + m a^2) w' = -m a v w. With k^2 = (I + m a^2)/m and c^2 = v^2 + k^2 w^2:
//   v = c tanh(s), w = (c/k) / cosh(s), yaw = (k/a) (2 atan(tanh(s/2)) + constant), s' = a c/k^2.
static sleigh sleigh_at(double time, double speed, double turning) {
  double k = sqrt((inertia + mass * ahead * ahead) / mass), c = hypot(speed, k * turning);
  double start = atanh(speed / c), s = start + ahead * c / (k * k) * time;
  return (sleigh){c * tanh(s), c / k / cosh(s),
                  k / ahead * 2 * (atan(tanh(s / 2)) - atan(tanh(start / 2)))};
}

// Where the blade is: Simpson's rule over the closed form.
static void place_at(double place[2], double time, double speed, double turning) {
  enum { INTERVALS = 2000 };
  double h = time / INTERVALS;
  place[0] = place[1] = 0;
  for (int i = 0; i <= INTERVALS; i++) {
    double weight = (i == 0 || i == INTERVALS ? 1 : i % 2 ? 4 : 2) * h / 3;
    sleigh s = sleigh_at(i * h, speed, turning);
    place[0] += weight * s.speed * cos(s.yaw);
    place[1] += weight * s.speed * sin(s.yaw);
  }
}

static void test_sleigh(void **unused) {
  (void)unused;
  mjModel *m = load("sleigh.xml");
  mjData *d = start_from_key(m);
  worst w = ride(m, d, 10000);
  sleigh expected = sleigh_at(10, -1, 1);
  double place[2], c = cos(d->qpos[YAW]), s = sin(d->qpos[YAW]);
  place_at(place, 10, -1, 1);
  print_message("sleigh, 10 s: yaw off by %.1e, place by %.1e; slip %.1e, energy %.1e\n",
                d->qpos[YAW] - expected.yaw, hypot(d->qpos[X] - place[0], d->qpos[Y] - place[1]),
                w.slip, w.energy);
  assert_near(d->qpos[YAW], expected.yaw, 1e-10);
  assert_near(d->qvel[YAW], expected.turning, 1e-10);
  assert_near(c * d->qvel[X] + s * d->qvel[Y], expected.speed, 1e-10);
  assert_near(d->qpos[X], place[0], 1e-9);
  assert_near(d->qpos[Y], place[1], 1e-9);
  assert_below(w.height, 1e-12);
  assert_below(w.slip, 1e-10);
  assert_below(w.energy, 1e-11);
  assert_true(expected.speed > 1); // it has turned round
  mj_deleteData(d);
  mj_deleteModel(m);
}

// The blade carries the weight, and pushes sideways only: m (v w + a w') there, v w at the start.
static void test_sleigh_forces(void **unused) {
  (void)unused;
  mjModel *m = load("sleigh.xml");
  mjData *d = start_from_key(m);
  roll_disc blade;
  mj_forward(m, d);
  assert_int_equal(roll_disc_count(m), 1);
  assert_int_equal(roll_discs(&blade, 1, m, d), ROLL_OK);
  assert_string_equal(blade.name, "blade");
  double v = -1, w = 1, w_rate = -mass * ahead * v * w / (inertia + mass * ahead * ahead);
  assert_near(blade.force[0], 0, 1e-12);
  assert_near(blade.force[1], mass * (v * w + ahead * w_rate), 1e-11);
  assert_near(blade.normal_force, mass * 9.81, 1e-11);
  assert_near(sensor(m, d, "rolling:blade:force")[1], blade.force[1], 1e-14);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// Sideways velocity of the blade after `time` of motion with the present acceleration.
static mjtNum slip_after(const mjModel *m, const mjData *now, mjtNum time) {
  mjData *d = mj_copyData(NULL, m, now);
  mju_addToScl(d->qvel, now->qacc, time / 2, m->nv);
  mj_integratePos(m, d->qpos, d->qvel, time);
  mju_addToScl(d->qvel, now->qacc, time / 2, m->nv);
  mj_forward(m, d);
  roll_disc blade;
  assert_int_equal(roll_discs(&blade, 1, m, d), ROLL_OK);
  mjtNum sideways[3] = {d->geom_xmat[2], d->geom_xmat[5], 0};
  mju_normalize3(sideways);
  mj_deleteData(d);
  return mju_dot3(blade.slip, sideways);
}

// A curved blade (rocker) on a body that leans, pitches and turns: the rows' derivatives, by
// differences.
static void test_leaning_rocker(void **unused) {
  (void)unused;
  mjModel *m = load("rocker.xml");
  mjData *d = mj_makeData(m);
  const mjtNum axis[3] = {0.8, 0.2, 0.5}, omega[3] = {0.7, 2, -1.5};
  mju_axisAngle2Quat(d->qpos + 3, axis, 0.5);
  mju_normalize4(d->qpos + 3);
  d->qvel[0] = 2;
  mju_copy3(d->qvel + 3, omega);
  assert_int_equal(roll_project(m, d), ROLL_OK);
  assert_true(mju_norm3(d->qvel) > 1);
  const mjtNum h = 1e-4;
  mjtNum rate = (slip_after(m, d, h) - slip_after(m, d, -h)) / (2 * h);
  assert_near(rate, 0, 1e-5);
  roll_disc blade;
  assert_int_equal(roll_discs(&blade, 1, m, d), ROLL_OK);
  mjtNum heading[3], up[3] = {0, 0, 1};
  mju_cross(heading, (mjtNum[3]){d->geom_xmat[2], d->geom_xmat[5], d->geom_xmat[8]}, up);
  assert_near(mju_dot3(blade.force, heading), 0, 1e-11); // it glides
  assert_true(blade.normal_force > 0);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// On a body that only slides and turns in the plane, the blade's height is an empty row: what
// rounding leaves of it on a tilted plane must not become a force.
static void test_planar_blade_has_no_normal_force(void **unused) {
  (void)unused;
  mjModel *m = load("cart.xml");
  mjData *d = mj_makeData(m);
  d->qvel[2] = 1;
  d->qvel[4] = 0.5;
  worst w = ride(m, d, 1000);
  roll_disc blade;
  assert_int_equal(roll_discs(&blade, 1, m, d), ROLL_OK);
  assert_below(w.slip, 1e-10);
  assert_near(blade.normal_force, 0, 1e-9);
  assert_true(mju_norm3(blade.force) > 0.1);
  mj_deleteData(d);
  mj_deleteModel(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_sleigh),
      cmocka_unit_test(test_sleigh_forces),
      cmocka_unit_test(test_leaning_rocker),
      cmocka_unit_test(test_planar_blade_has_no_normal_force),
  };
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
