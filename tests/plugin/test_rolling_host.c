// SPDX-License-Identifier: Apache-2.0
// The library as a guest: other callbacks, models, threads and constraints, redundant wheels.
#include "rolling_support.h"

#include <pthread.h>

//---------------------------------- installing ----------------------------------------------------

static int calls;

static void other_control(const mjModel *m, mjData *d) {
  (void)m;
  calls++;
  if (m->nu) d->ctrl[0] = 3;
}

static void test_install_chains(void **unused) {
  (void)unused;
  assert_int_equal(roll_uninstall(), ROLL_OK);
  assert_int_equal(roll_uninstall(), ROLL_NOT_INSTALLED);
  mjcb_control = other_control;
  assert_false(roll_is_installed());
  roll_install();
  roll_install();
  assert_true(roll_is_installed());

  // the chained callback's control is seen in the same call: J qacc = 0 with the torque on
  mjModel *m = load("bicycle.xml");
  mjData *d = mj_makeData(m);
  roll_disc disc[2];
  calls = 0;
  mj_forward(m, d);
  assert_int_equal(calls, 1);
  assert_int_equal(roll_discs(disc, 2, m, d), ROLL_OK);
  assert_true(fabs(disc[1].force[1]) > 1); // the steer torque pushes the front wheel aside
  assert_true(fabs(d->qacc[7]) > 1);
  mj_deleteData(d);
  mj_deleteModel(m);

  mjcb_control = other_control; // a host takes it away
  assert_false(roll_is_installed());
  assert_int_equal(roll_uninstall(), ROLL_NOT_INSTALLED);
  assert_true(mjcb_control == other_control);
  mjcb_control = roll_control;
  assert_int_equal(roll_uninstall(), ROLL_OK);
  assert_true(mjcb_control == other_control);
  mjcb_control = NULL;
  roll_install();
}

static void test_unmarked_model_is_untouched(void **unused) {
  (void)unused;
  mjModel *m = load("unmarked.xml");
  mjData *with = mj_makeData(m), *without = mj_makeData(m);
  for (int i = 0; i < 200; i++) mj_step(m, with);
  mjcb_control = NULL;
  for (int i = 0; i < 200; i++) mj_step(m, without);
  mjcb_control = roll_control;
  assert_memory_equal(with->qpos, without->qpos, sizeof(mjtNum) * m->nq);
  assert_memory_equal(with->qvel, without->qvel, sizeof(mjtNum) * m->nv);
  roll_object where = {mjOBJ_BODY, 7};
  assert_int_equal(roll_disc_count(m), 0);
  assert_int_equal(roll_check(&where, m), ROLL_NO_MARKER);
  assert_int_equal(where.type, mjOBJ_UNKNOWN);
  assert_int_equal(roll_discs(NULL, 0, m, with), ROLL_NO_MARKER);
  assert_int_equal(roll_project(m, with), ROLL_NO_MARKER);
  mj_deleteData(with);
  mj_deleteData(without);
  mj_deleteModel(m);
}

//---------------------------------- purity --------------------------------------------------------

enum { BICYCLE_DOFS = 9, PURITY_STEPS = 2000 };

typedef struct run {
  const mjModel *m;
  mjtNum lean_rate;
  mjtNum state[2 * BICYCLE_DOFS];
} run;

static void *take_run(void *argument) {
  run *r = argument;
  mjData *d = mj_makeData(r->m);
  mjtNum speed = 5;
  d->qvel[0] = speed;
  d->qvel[6] = speed / 0.3;
  d->qvel[8] = speed / 0.35;
  d->qvel[4] = r->lean_rate;
  if (roll_project(r->m, d)) return NULL;
  for (int i = 0; i < PURITY_STEPS; i++) mj_step(r->m, d);
  mju_copy(r->state, d->qpos, BICYCLE_DOFS);
  mju_copy(r->state + BICYCLE_DOFS, d->qvel, BICYCLE_DOFS);
  mj_deleteData(d);
  return r;
}

static void test_threads_are_bitwise_serial(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml");
  run serial[2] = {{.m = m, .lean_rate = 0.5}, {.m = m, .lean_rate = -0.3}};
  run threaded[2] = {serial[0], serial[1]};
  pthread_t thread[2];
  for (int i = 0; i < 2; i++) assert_non_null(take_run(&serial[i]));
  for (int i = 0; i < 2; i++)
    assert_int_equal(pthread_create(&thread[i], NULL, take_run, &threaded[i]), 0);
  for (int i = 0; i < 2; i++) {
    void *done = NULL;
    assert_int_equal(pthread_join(thread[i], &done), 0);
    assert_non_null(done);
    assert_memory_equal(serial[i].state, threaded[i].state, sizeof serial[i].state);
  }
  mj_deleteModel(m);
}

// The same ride after a reset, after another model, and after being asked for its discs all the
// way.
static void test_nothing_is_remembered(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml"), *other = load("disc.xml");
  mjData *d = mj_makeData(m), *other_d = mj_makeData(other);
  roll_disc disc[2];
  mjtNum first[BICYCLE_DOFS];
  for (int round = 0; round < 2; round++) {
    mj_resetData(m, d);
    d->qpos[7] = 0.1;
    assert_int_equal(roll_project(m, d), ROLL_OK);
    for (int i = 0; i < 500; i++) {
      mj_step(m, d);
      if (round == 0) continue;
      mj_step(other, other_d);
      mj_forward(m, d);
      assert_int_equal(roll_discs(disc, 2, m, d), ROLL_OK);
    }
    if (round == 0) mju_copy(first, d->qpos, BICYCLE_DOFS);
  }
  assert_memory_equal(first, d->qpos, sizeof first);
  mj_deleteData(other_d);
  mj_deleteData(d);
  mj_deleteModel(other);
  mj_deleteModel(m);
}

//---------------------------------- MuJoCo's own constraints --------------------------------------

// Contacts, friction loss, an equality, a tendon and actuators in one model, every solver, both
// friction cones, dense and sparse. What is left is RK4's error at the jumps of the contact forces;
// rows that move the disc leave 1e-2.
static void test_beside_contacts(void **unused) {
  (void)unused;
  for (int kind = 0; kind < 12; kind++) {
    mjModel *m = load("obstacle.xml");
    m->opt.solver = kind / 2 % 3; // mjSOL_PGS, mjSOL_CG, mjSOL_NEWTON
    m->opt.cone = kind % 2;       // mjCONE_PYRAMIDAL, mjCONE_ELLIPTIC
    m->opt.jacobian = kind < 6 ? mjJAC_DENSE : mjJAC_SPARSE;
    mjData *d = mj_makeData(m);
    d->qvel[0] = 2;
    d->qvel[3] = 0.2;
    d->qvel[5] = 2 / 0.3;
    for (int i = 0; i < m->nu; i++) d->ctrl[i] = 0.3 - 0.1 * i;
    assert_int_equal(roll_project(m, d), ROLL_OK);
    worst w = ride(m, d, 1000);
    assert_true(d->qvel[0] < 0.5); // the box has stopped it
    assert_below(w.height, 1e-8);
    assert_below(w.slip, 1e-5);
    mj_deleteData(d);
    mj_deleteModel(m);
  }
}

// Euler and implicit are of first order, and so are the constraints under them: half the step, half
// the slip. Under RK4 there is none to speak of.
static void test_other_integrators(void **unused) {
  (void)unused;
  for (int integrator = 0; integrator < 3; integrator++) { // mjINT_EULER, RK4, IMPLICIT
    mjtNum slip[2];
    for (int half = 0; half < 2; half++) {
      mjModel *m = load("bicycle.xml");
      m->opt.integrator = integrator;
      m->opt.timestep = half ? 5e-4 : 1e-3;
      mjData *d = start_from_key(m);
      slip[half] = ride(m, d, half ? 2000 : 1000).slip;
      mj_deleteData(d);
      mj_deleteModel(m);
    }
    if (integrator == mjINT_RK4) {
      assert_below(slip[0], 1e-11);
    } else {
      assert_below(slip[0], 3e-3);
      assert_near(slip[0] / slip[1], 2, 0.1);
    }
  }
}

//---------------------------------- redundant constraints -----------------------------------------

static mjtNum lateral(const roll_disc *disc) {
  return disc->force[1];
}

// Going straight a tricycle has one lateral constraint too many; driven by a steer torque it turns.
static void test_tricycle(void **unused) {
  (void)unused;
  mjModel *m = load("tricycle.xml");
  mjData *d = mj_makeData(m);
  d->qvel[0] = 3;
  d->qvel[6] = d->qvel[7] = 3 / 0.25;
  d->qvel[9] = 3 / 0.3;
  assert_int_equal(roll_project(m, d), ROLL_OK);
  worst w = ride(m, d, 1000);
  assert_below(w.height, 1e-12);
  assert_below(w.slip, 1e-10);
  assert_near(d->qpos[0], 3, 1e-9); // nothing slows it down
  roll_disc disc[3];
  assert_int_equal(roll_discs(disc, 3, m, d), ROLL_OK);
  mjtNum weight = disc[0].normal_force + disc[1].normal_force + disc[2].normal_force;
  assert_near(weight, 69 * 9.81, 1e-9);

  d->ctrl[0] = 0.5;
  for (int i = 0; i < 500; i++) mj_step(m, d);
  d->ctrl[0] = 0;
  mj_forward(m, d);
  assert_int_equal(roll_discs(disc, 3, m, d), ROLL_OK);
  for (int i = 0; i < 3; i++) {
    assert_below(disc[i].height, 1e-11);
    assert_below(mju_norm3(disc[i].slip), 1e-9);
  }
  assert_true(fabs(d->qpos[1]) > 1e-3); // it has turned
  // the part along the common axle is shared out evenly: the smallest forces
  mjtNum axle[3] = {d->xmat[9 + 1], d->xmat[9 + 4], d->xmat[9 + 7]};
  assert_true(fabs(lateral(&disc[0])) > 0.1);
  assert_near(mju_dot3(disc[0].force, axle), mju_dot3(disc[1].force, axle), 1e-6);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// The model with its first disc marked again as the second: three constraints said twice.
static void test_disc_marked_twice(void **unused) {
  (void)unused;
  mjModel *m = load("bicycle.xml"), *twice = load("bicycle.xml");
  twice->tuple_objid[1] = twice->tuple_objid[0];
  twice->tuple_objprm[1] = twice->tuple_objprm[0];
  m->tuple_size[0] = 1;
  mjData *d = mj_makeData(m), *d_twice = mj_makeData(twice);
  d->qvel[4] = d_twice->qvel[4] = 0.2;
  mj_forward(m, d);
  mj_forward(twice, d_twice);
  roll_disc one, two[2];
  assert_int_equal(roll_discs(&one, 1, m, d), ROLL_OK);
  assert_int_equal(roll_discs(two, 2, twice, d_twice), ROLL_OK);
  for (int i = 0; i < m->nv; i++) assert_near(d_twice->qacc[i], d->qacc[i], 1e-9);
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 2; i++) assert_near(two[i].force[k], one.force[k] / 2, 1e-9);
  mj_deleteData(d_twice);
  mj_deleteData(d);
  mj_deleteModel(twice);
  mj_deleteModel(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_install_chains),
      cmocka_unit_test(test_unmarked_model_is_untouched),
      cmocka_unit_test(test_threads_are_bitwise_serial),
      cmocka_unit_test(test_nothing_is_remembered),
      cmocka_unit_test(test_beside_contacts),
      cmocka_unit_test(test_other_integrators),
      cmocka_unit_test(test_tricycle),
      cmocka_unit_test(test_disc_marked_twice),
  };
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
