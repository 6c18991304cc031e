// SPDX-License-Identifier: Apache-2.0
// The benchmark bicycle as a MuJoCo model with two rolling discs, against published numbers.
#include "rolling_support.h"

// Order of the joints in bicycle.xml.
enum { X, Y, Z, YAW, ROLL, PITCH, REAR, STEER, FRONT, BICYCLE_DOFS };

static const mjtNum rear_radius = 0.3, front_radius = 0.35; // bicycle.xml

// Upright at `speed`, leaning at `lean_rate` about the line between the contact points.
static mjData *start(const mjModel *m, mjtNum speed, mjtNum lean_rate) {
  mjData *d = mj_makeData(m);
  d->qvel[X] = speed;
  d->qvel[REAR] = speed / rear_radius;
  d->qvel[FRONT] = speed / front_radius;
  d->qvel[ROLL] = lean_rate;
  d->qvel[Y] = -rear_radius * lean_rate; // the hub, where the root is
  assert_int_equal(roll_project(m, d), ROLL_OK);
  assert_near(d->qvel[ROLL], lean_rate, 1e-14);
  return d;
}

// Basu-Mandal, Chatterjee and Papadopoulos, Proc. R. Soc. A 463 (2007), Table 1. Their bicycle runs
// towards -x (x and y change sign), lean = pi/2 - psi, pitch = phi - pi (nose down positive).
static const mjtNum table_q[BICYCLE_DOFS] = {0,
                                             0,
                                             0.2440472102925 - 0.3,
                                             0,
                                             1.5707963267948966 - 0.9501292851472,
                                             3.1257073014894 - 3.1415926535897931,
                                             0,
                                             0.2311385135743,
                                             0};
static const mjtNum table_qd[BICYCLE_DOFS] = {2.8069345714545, 0.1480982396001,  0.1058778746261,
                                              0.7830033527065, -0.6068425835418, -0.0119185528069,
                                              8.912989661489,  0.4859824687093,  8.0133620584155};
static const mjtNum table_qdd[BICYCLE_DOFS] = {0.5041626315047, 0.3449706619454,  -1.460452833298,
                                               0.8353281706379, 7.8555281128244,  0.1205543897884,
                                               1.8472554144217, -4.6198904039403, 2.454807290455};

static void test_published_accelerations(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  mju_copy(d->qpos, table_q, BICYCLE_DOFS);
  mju_copy(d->qvel, table_qd, BICYCLE_DOFS);
  assert_int_equal(roll_project(m, d), ROLL_OK);
  mjtNum largest = 0;
  for (int i = 0; i < BICYCLE_DOFS; i++) {
    // The table's last digit leaves heights of 5e-14 m and m/s: projection must change no more than
    // that asks for, most of it in the light steering, and 1e-11 of the accelerations goes with it.
    assert_near(d->qpos[i], table_q[i], 5e-12);
    assert_near(d->qvel[i], table_qd[i], 5e-12);
    assert_near(d->qacc[i], table_qdd[i], 1e-11 * fmax(1, fabs(table_qdd[i])));
    largest = fmax(largest, fabs(d->qacc[i] - table_qdd[i]) / fmax(1, fabs(table_qdd[i])));
  }
  print_message("Basu-Mandal table 1: accelerations within %.1e\n", largest);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// Meijaard et al. (2007): 612.836470588236 and 309.303529411765 N on the wheels of the bicycle at
// rest.
static void test_static_loads(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  roll_disc disc[2];
  mj_forward(m, d);
  assert_int_equal(roll_discs(disc, 2, m, d), ROLL_OK);
  assert_near(disc[0].normal_force, 612.836470588236, 1e-10);
  assert_near(disc[1].normal_force, 309.303529411765, 1e-10);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void test_ride_keeps_the_constraints(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = start(m, 5, 0.5);
  worst w = ride(m, d, 60000);
  print_message("bicycle, 60 s at 1 ms: height %.1e m, slip %.1e m/s, energy %.1e\n", w.height,
                w.slip, w.energy);
  assert_below(w.height, 1e-12);
  assert_below(w.slip, 1e-10);
  assert_below(w.energy, 1e-11);
  mj_deleteData(d);
  mj_deleteModel(m);
}

static mjModel *bicycle_with_steer_stop(int solver) {
  mjModel *m = load("bicycle_stops.xml");
  m->opt.solver = solver;
  return m;
}

// Stops at +-0.03 rad, reached at once. Lean after 0.8 s: 0.5559376 rad with the limit as a
// constraint on accelerations beside the discs; 0.19 where MuJoCo's row moves the wheels.
static void test_steer_stop(void **unused) {
  (void)unused;
  for (int kind = 0; kind < 6; kind++) {
    mjModel *m = bicycle_with_steer_stop(kind / 2); // mjSOL_PGS, mjSOL_CG, mjSOL_NEWTON
    m->opt.jacobian = kind % 2 ? mjJAC_SPARSE : mjJAC_DENSE;
    mjData *d = start(m, 5, 0.5);
    worst w = ride(m, d, 800);
    assert_true(d->nefc == 1);
    if (kind == 4)
      print_message("steer stop: lean %.7f rad, height %.1e m, slip %.1e m/s\n", d->qpos[ROLL],
                    w.height, w.slip);
    assert_near(d->qpos[ROLL], 0.55594, 1e-5);
    assert_below(w.height, 1e-10);
    assert_below(w.slip, 1e-9);
    mj_deleteData(d);
    mj_deleteModel(m);
  }
}

// Momentum of the whole bicycle after `time` of motion with the present acceleration.
static void momentum_after(mjtNum p[3], const mjModel *m, const mjData *now, mjtNum time) {
  mjData *d = mj_copyData(NULL, m, now);
  mju_addToScl(d->qvel, now->qacc, time / 2, m->nv);
  mj_integratePos(m, d->qpos, d->qvel, time);
  mju_addToScl(d->qvel, now->qacc, time / 2, m->nv);
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_comVel(m, d);
  mj_subtreeVel(m, d);
  mju_scl3(p, d->subtree_linvel + 3, m->body_subtreemass[1]);
  mj_deleteData(d);
}

// Weight, applied and ground forces make up the change of momentum; a steer stop and the motor are
// internal.
static void test_forces_are_newtons(void **unused) {
  (void)unused;
  for (int stop = 0; stop < 2; stop++) {
    mjModel *m = stop ? bicycle_with_steer_stop(mjSOL_NEWTON) : load("bicycle.xml");
    mjData *d = start(m, 5, 0.5);
    const mjtNum push[3] = {7, -20, 5}, weight[3] = {0, 0, -94 * 9.81};
    mju_copy3(d->xfrc_applied + 6, push); // on the rear frame
    d->qfrc_applied[X] = 11;              // on the whole bicycle, along x
    d->ctrl[0] = stop ? 0 : 3;
    for (int i = 0; i < 300; i++) mj_step(m, d);
    mj_forward(m, d);
    assert_int_equal(d->nefc, stop);
    mjtNum *efc_J = malloc(sizeof(mjtNum) * BICYCLE_DOFS), before[3], after[3];
    assert_non_null(efc_J);
    mju_copy(efc_J, d->efc_J, stop ? BICYCLE_DOFS : 0);
    roll_disc disc[2];
    assert_int_equal(roll_discs(disc, 2, m, d), ROLL_OK);
    // asking leaves everything as it was
    assert_memory_equal(efc_J, d->efc_J, sizeof(mjtNum) * (stop ? BICYCLE_DOFS : 0));
    free(efc_J);
    for (int i = 0; i < 2; i++) assert_below(mju_norm3(disc[i].slip), 1e-9);
    const mjtNum h = 1e-4;
    momentum_after(before, m, d, -h);
    momentum_after(after, m, d, h);
    for (int i = 0; i < 3; i++) {
      mjtNum force = disc[0].force[i] + disc[1].force[i] + push[i] + weight[i] + (i == X ? 11 : 0);
      // differences of 500 kg m/s over h: rounding 1e-9, truncation h^2 times some 1e3 N/s^2
      assert_near((after[i] - before[i]) / (2 * h), force, 1e-4);
    }
    mj_deleteData(d);
    mj_deleteModel(m);
  }
}

// mjd_transitionFD goes through mj_forwardSkip, which keeps qfrc_passive and MuJoCo's rows.
static void test_linearisation(void **unused) {
  (void)unused;
  enum { STATES = 2 * BICYCLE_DOFS };
  mjModel *m = load("bicycle.xml");
  mjData *d = start(m, 5, 0);
  m->opt.integrator = mjINT_EULER;
  m->opt.timestep = 1e-4;
  mjtNum A[STATES * STATES];
  mjd_transitionFD(m, d, 1e-6, 1, A, NULL, NULL, NULL);
  // Meijaard et al.: lean'' per lean at 5 m/s, and steer'' per lean (steer right positive there)
  mjtNum lean_lean = A[(BICYCLE_DOFS + ROLL) * STATES + ROLL] / m->opt.timestep;
  mjtNum steer_lean = A[(BICYCLE_DOFS + STEER) * STATES + ROLL] / m->opt.timestep;
  assert_near(lean_lean, 9.48977, 1e-5);
  print_message("A: %.6f and %.6f\n", lean_lean, steer_lean);
  assert_near(steer_lean, -11.7195, 1e-4);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// Accelerations and forces after mj_forwardSkip are those of mj_forward, with and without rows of
// MuJoCo's own.
static void test_skipped_stages(void **unused) {
  (void)unused;
  for (int stop = 0; stop < 2; stop++) {
    mjModel *m = stop ? bicycle_with_steer_stop(mjSOL_NEWTON) : load("bicycle.xml");
    m->opt.tolerance = 0;
    mjData *d = start(m, 5, 0.5);
    for (int i = 0; i < 300; i++) mj_step(m, d);
    mjtNum qacc[BICYCLE_DOFS];
    roll_disc whole[2], skipped[2];
    d->ctrl[0] = 2;
    d->qvel[ROLL] += 0.01;
    mj_forward(m, d);
    mju_copy(qacc, d->qacc, BICYCLE_DOFS);
    assert_int_equal(roll_discs(whole, 2, m, d), ROLL_OK);

    d->ctrl[0] = -5;
    d->qvel[ROLL] -= 0.02;
    mj_forward(m, d);
    d->qvel[ROLL] += 0.02;
    mj_forwardSkip(m, d, mjSTAGE_POS, 0);
    d->ctrl[0] = 2;
    mj_forwardSkip(m, d, mjSTAGE_VEL, 0);
    assert_int_equal(roll_discs(skipped, 2, m, d), ROLL_OK);
    for (int i = 0; i < BICYCLE_DOFS; i++) assert_near(d->qacc[i], qacc[i], 1e-8);
    for (int i = 0; i < 2; i++)
      for (int k = 0; k < 3; k++) assert_near(skipped[i].force[k], whole[i].force[k], 1e-8);
    mj_deleteData(d);
    mj_deleteModel(m);
  }
}

static void test_projection_finds_the_ground(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  roll_disc disc[2];
  d->qpos[ROLL] = 0.4;
  d->qpos[STEER] = 0.8;
  d->qpos[Z] = 0.2;
  for (int i = 0; i < BICYCLE_DOFS; i++) d->qvel[i] = 1 + i;
  assert_int_equal(roll_project(m, d), ROLL_OK);
  assert_int_equal(roll_discs(disc, 2, m, d), ROLL_OK);
  for (int i = 0; i < 2; i++) {
    assert_below(disc[i].height, 1e-15);
    assert_below(disc[i].height_rate, 1e-13);
    assert_below(mju_norm3(disc[i].slip), 1e-13);
  }
  mj_deleteData(d);
  mj_deleteModel(m);
}

static void test_projection_refuses(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  d->qpos[STEER] = 0.3;
  d->qvel[STEER] = NAN;
  assert_int_equal(roll_project(m, d), ROLL_NOT_FINITE);
  assert_true(d->qpos[STEER] == 0.3 && d->qpos[Z] == 0); // as it was
  d->qvel[STEER] = 0;
  d->qpos[ROLL] = NAN;
  assert_int_equal(roll_project(m, d), ROLL_NOT_FINITE);
  mj_deleteData(d);
  mj_deleteModel(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_published_accelerations),
      cmocka_unit_test(test_static_loads),
      cmocka_unit_test(test_ride_keeps_the_constraints),
      cmocka_unit_test(test_steer_stop),
      cmocka_unit_test(test_forces_are_newtons),
      cmocka_unit_test(test_linearisation),
      cmocka_unit_test(test_skipped_stages),
      cmocka_unit_test(test_projection_finds_the_ground),
      cmocka_unit_test(test_projection_refuses),
  };
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
