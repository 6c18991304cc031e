// SPDX-License-Identifier: Apache-2.0
// One rolling disc against closed forms and against the same disc in its own five speeds.
#include "rolling_support.h"

#include <disc.h>

static const disc_body thin_disc = {2, 0.3, 0.045, 0.09, 9.81}; // of disc.xml and disc_free.xml

// A generic motion: rolling at about 1 m/s, leaning, turning and nodding.
static const double generic[DISC_STATES] = {[DISC_YAW] = 0.4, [DISC_LEAN] = 0.3, [DISC_SPIN] = 0,
                                            [DISC_W1] = 0.5,  [DISC_W2] = 4,     [DISC_W3] = -2};

// Puts a state of the reduced model into disc.xml (qpos: x, y, z - R, yaw, roll, spin).
static void put_hinges(mjData *d, const double s[DISC_STATES], disc_body b) {
  double f[DISC_STATES];
  disc_rates(f, s, &b);
  double qpos[6] = {s[DISC_X],   s[DISC_Y],    b.radius * (cos(s[DISC_LEAN]) - 1),
                    s[DISC_YAW], s[DISC_LEAN], s[DISC_SPIN]};
  double qvel[6] = {f[DISC_X],   f[DISC_Y],    -b.radius * sin(s[DISC_LEAN]) * f[DISC_LEAN],
                    f[DISC_YAW], f[DISC_LEAN], f[DISC_SPIN]};
  mju_copy(d->qpos, qpos, 6);
  mju_copy(d->qvel, qvel, 6);
}

// The same into disc_free.xml: rotation Rz(yaw) Rx(lean) Ry(spin), angular velocity in the body.
static void put_free(mjData *d, const double s[DISC_STATES], disc_body b) {
  double f[DISC_STATES];
  disc_rates(f, s, &b);
  const mjtNum axis[3][3] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  const int angle[3] = {DISC_YAW, DISC_LEAN, DISC_SPIN};
  mjtNum quat[4] = {1, 0, 0, 0}, turn[4], product[4], back[4];
  for (int i = 0; i < 3; i++) {
    mju_axisAngle2Quat(turn, axis[i], s[angle[i]]);
    mju_mulQuat(product, quat, turn);
    mju_copy4(quat, product);
  }
  // w = w1 e1 + w2 e2 + w3 e3 in the leaning frame, seen from the spinning body: Ry(-spin)
  const mjtNum w[3] = {s[DISC_W1], s[DISC_W2], s[DISC_W3]};
  mju_axisAngle2Quat(back, axis[2], -s[DISC_SPIN]);
  const mjtNum place[3] = {s[DISC_X], s[DISC_Y], b.radius * cos(s[DISC_LEAN])};
  const mjtNum velocity[3] = {f[DISC_X], f[DISC_Y], -b.radius * sin(s[DISC_LEAN]) * f[DISC_LEAN]};
  mju_copy3(d->qpos, place);
  mju_copy4(d->qpos + 3, quat);
  mju_copy3(d->qvel, velocity);
  mju_rotVecQuat(d->qvel + 3, w, back);
}

typedef void putter(mjData *, const double *, disc_body);

// Distance of MuJoCo's disc from the reduced one after `time`, over hub and attitude.
static double error_after(const char *model, putter *put, double time, double timestep) {
  mjModel *m = load(model);
  mjData *d = mj_makeData(m), *exact = mj_makeData(m);
  m->opt.timestep = timestep;
  put(d, generic, thin_disc);
  int steps = (int)lround(time / timestep);
  for (int i = 0; i < steps; i++) mj_step(m, d);

  double s[DISC_STATES];
  mju_copy(s, generic, DISC_STATES);
  int fine = (int)lround(time / 2.5e-4);
  for (int i = 0; i < fine; i++) disc_advance(s, &thin_disc, time / fine);
  put(exact, s, thin_disc);

  double error = 0;
  mj_forward(m, d);
  mj_forward(m, exact);
  for (int i = 0; i < 3; i++) error = fmax(error, fabs(d->xpos[3 + i] - exact->xpos[3 + i]));
  for (int i = 0; i < 9; i++) error = fmax(error, fabs(d->xmat[9 + i] - exact->xmat[9 + i]));
  mj_deleteData(exact);
  mj_deleteData(d);
  mj_deleteModel(m);
  return error;
}

static void test_trajectory(void **unused) {
  (void)unused;
  double error = error_after("disc.xml", put_hinges, 10, 1e-3);
  print_message("disc, 10 s at 1 ms: %.2e from the reduced model\n", error);
  // truncation of RK4 at 1 ms is some 1e-10; leaving out Jdot v costs all digits
  assert_below(error, 1e-9);
}

static double observed_order(const char *model, putter *put) {
  double coarse = error_after(model, put, 2, 8e-3), fine = error_after(model, put, 2, 4e-3);
  print_message("%s: error %.2e at 8 ms, %.2e at 4 ms\n", model, coarse, fine);
  return log2(coarse / fine);
}

static void test_order(void **unused) {
  (void)unused;
  double hinges = observed_order("disc.xml", put_hinges);
  double free = observed_order("disc_free.xml", put_free);
  print_message("order: %.2f with hinges, %.2f with a free joint\n", hinges, free);
  assert_near(hinges, 4, 0.2);
  assert_near(free, 2, 0.2); // MuJoCo's RK4 moves quaternions with second order only
}

static void test_invariants(void **unused) {
  (void)unused;
  mjModel *m = load("disc.xml");
  mjData *d = mj_makeData(m);
  put_hinges(d, generic, thin_disc);
  worst w = ride(m, d, 10000);
  print_message("disc, 10 s at 1 ms: height %.1e m, slip %.1e m/s, energy %.1e\n", w.height, w.slip,
                w.energy);
  assert_below(w.height, 1e-12);
  assert_below(w.slip, 1e-10);
  assert_below(w.energy, 1e-11);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// lean' = 0 asks for (C + m R^2) w2 w3 = I w3^2 tan(lean) - m g R sin(lean): a circle for ever.
static void test_steady_precession(void **unused) {
  (void)unused;
  disc_body b = thin_disc;
  double mR2 = b.mass * b.radius * b.radius, s[DISC_STATES] = {[DISC_LEAN] = 0.35, [DISC_W3] = -3};
  s[DISC_W2] = (b.diametral * s[DISC_W3] * s[DISC_W3] * tan(s[DISC_LEAN]) -
                b.mass * b.gravity * b.radius * sin(s[DISC_LEAN])) /
               ((b.axial + mR2) * s[DISC_W3]);
  double yaw_rate = s[DISC_W3] / cos(s[DISC_LEAN]), circle = b.radius * s[DISC_W2] / yaw_rate,
         time = 10;

  mjModel *m = load("disc.xml");
  mjData *d = mj_makeData(m);
  put_hinges(d, s, b);
  m->opt.timestep = 5e-4; // truncation over five turns: 3e-10, and sixteen times that at 1 ms
  for (int i = 0; i < 20000; i++) mj_step(m, d);
  assert_near(d->qpos[4], s[DISC_LEAN], 1e-9);
  assert_near(d->qpos[3], yaw_rate * time, 1e-9);
  assert_near(d->qpos[0], circle * sin(yaw_rate * time), 1e-9);
  assert_near(d->qpos[1], circle * (1 - cos(yaw_rate * time)), 1e-9);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// Lean acceleration of a disc that leans by `lean` and turns as its angular momentum demands.
static double lean_acceleration(const mjModel *m, mjData *d, disc_body b, double speed) {
  const double lean = 1e-4;
  double spin = speed / b.radius;
  double s[DISC_STATES] = {
      [DISC_LEAN] = lean, [DISC_W2] = spin, [DISC_W3] = -b.axial / b.diametral * spin * lean};
  put_hinges(d, s, b);
  mj_forward(m, d);
  return d->qacc[4] / lean;
}

// The speed above which an upright disc is stable: bisection on the sign of the lean acceleration.
static double critical_speed(disc_body b) {
  mjModel *m = load("disc.xml");
  mju_copy3(m->body_inertia + 3, (mjtNum[3]){b.diametral, b.axial, b.diametral});
  mjData *d = mj_makeData(m);
  double slow = 0, fast = 10;
  for (int i = 0; i < 60; i++) {
    double middle = (slow + fast) / 2;
    *(lean_acceleration(m, d, b, middle) > 0 ? &slow : &fast) = middle;
  }
  mj_deleteData(d);
  mj_deleteModel(m);
  return slow;
}

// Upright: v^2 > m g R I R^2 / (C (C + m R^2)); g R/3 for a thin disc, g R/4 for a ring.
static void test_critical_speed(void **unused) {
  (void)unused;
  disc_body ring = thin_disc;
  double gR = ring.gravity * ring.radius;
  ring.axial = ring.mass * ring.radius * ring.radius;
  ring.diametral = ring.axial / 2;
  // a lean of 1e-4 differs from none by its square
  assert_relative(critical_speed(thin_disc), sqrt(gR / 3), 1e-7);
  assert_relative(critical_speed(ring), sqrt(gR / 4), 1e-7);
}

static void test_resting_disc_carries_its_weight(void **unused) {
  (void)unused;
  mjModel *m = load("disc.xml");
  mjData *d = mj_makeData(m);
  roll_disc disc;
  mj_forward(m, d);
  assert_int_equal(roll_discs(&disc, 1, m, d), ROLL_OK);
  assert_string_equal(disc.name, "rim");
  assert_near(disc.normal_force, 2 * 9.81, 1e-12);
  assert_near(disc.force[0], 0, 1e-12);
  assert_near(disc.force[1], 0, 1e-12);
  assert_near(disc.point[2], 0, 1e-15);
  for (int i = 0; i < m->nv; i++) assert_near(d->qacc[i], 0, 1e-12);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// Velocity of the contact point after `time` of motion with the present acceleration.
static void contact_velocity(mjtNum velocity[3], const mjModel *m, const mjData *now, mjtNum time) {
  mjData *d = mj_copyData(NULL, m, now);
  roll_disc disc;
  mju_addToScl(d->qvel, now->qacc, time / 2, m->nv); // midpoint rule: exact to time^2
  mj_integratePos(m, d->qpos, d->qvel, time);
  mju_addToScl(d->qvel, now->qacc, time / 2, m->nv);
  mj_forward(m, d);
  assert_int_equal(roll_discs(&disc, 1, m, d), ROLL_OK);
  mju_addScl3(velocity, disc.slip, (mjtNum[3]){0, 0, 1}, disc.height_rate);
  mj_deleteData(d);
}

// On the constraint the contact velocity must not grow: J qacc + Jdot v = 0, by differences.
// Without Jdot v it grows by metres per second squared.
static void test_contact_acceleration(void **unused) {
  (void)unused;
  const char *models[2] = {"disc.xml", "disc_free.xml"};
  putter *const put[2] = {put_hinges, put_free};
  for (int k = 0; k < 2; k++) {
    mjModel *m = load(models[k]);
    mjData *d = mj_makeData(m);
    const mjtNum h = 1e-4; // differences err by h^2 times the motion's third derivatives, 1e-6
    mjtNum before[3], after[3];
    put[k](d, generic, thin_disc);
    mj_forward(m, d);
    contact_velocity(before, m, d, -h);
    contact_velocity(after, m, d, h);
    for (int i = 0; i < 3; i++) assert_near((after[i] - before[i]) / (2 * h), 0, 1e-5);
    mj_deleteData(d);
    mj_deleteModel(m);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_trajectory),
      cmocka_unit_test(test_order),
      cmocka_unit_test(test_invariants),
      cmocka_unit_test(test_steady_precession),
      cmocka_unit_test(test_critical_speed),
      cmocka_unit_test(test_resting_disc_carries_its_weight),
      cmocka_unit_test(test_contact_acceleration),
  };
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
