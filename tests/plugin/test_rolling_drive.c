// SPDX-License-Identifier: Apache-2.0
// Driven joints: a load pushed along a free cart, and a swaying rider on a bicycle.
#include "rolling_support.h"

//---------------------------------- a motion in userdata ------------------------------------------

enum { RAIL, LOAD };

static const double cart_mass = 3, load_mass = 2; // cart.xml
static const double reach = 0.2, rate = 3;        // w = reach (1 - cos(rate t))

// A host's own callback, before the library's: sets w, w', w'' for every stage's time.
static void push_load(const mjModel *m, mjData *d) {
  (void)m;
  double angle = rate * d->time, *w = d->userdata + 1;
  w[0] = reach * (1 - cos(angle));
  w[1] = reach * rate * sin(angle);
  w[2] = reach * rate * rate * cos(angle);
}

// The common centre of mass stays: x = -m w/(M + m). The force is what moves the cart; its work is
// the kinetic energy, as both were at rest.
static void test_load_on_a_cart(void **unused) {
  (void)unused;
  assert_int_equal(roll_uninstall(), ROLL_OK);
  mjcb_control = push_load;
  roll_install();
  mjModel *m = load("cart.xml");
  mjData *d = mj_makeData(m);
  mjtNum off = 0;
  for (int i = 0; i < 5000; i++) {
    mj_step(m, d);
    off = fmax(off, fabs(d->qpos[LOAD] - reach * (1 - cos(rate * d->time))));
  }
  roll_drive drive;
  mj_forward(m, d);
  assert_int_equal(roll_drives(&drive, 1, m, d), ROLL_OK);
  double share = load_mass / (cart_mass + load_mass), *w = d->userdata + 1;
  double reduced = cart_mass * share; // of the two masses
  print_message("load: off by %.1e m, cart by %.1e m, work by %.1e J\n", off,
                d->qpos[RAIL] + share * w[0], d->act[0] - reduced * w[1] * w[1] / 2);
  assert_below(off, 1e-11); // truncation of RK4 at 1 ms
  assert_near(d->qpos[RAIL], -share * w[0], 1e-11);
  assert_string_equal(drive.name, "load");
  assert_near(drive.off, d->qpos[LOAD] - w[0], 1e-15);
  assert_near(drive.force, reduced * w[2], 1e-9);
  assert_near(drive.power, drive.force * d->qvel[LOAD], 1e-14);
  assert_near(d->act[0], reduced * w[1] * w[1] / 2, 1e-10);
  mj_deleteData(d);
  mj_deleteModel(m);
  assert_int_equal(roll_uninstall(), ROLL_OK);
  mjcb_control = NULL;
  roll_install();
}

//---------------------------------- a motion in the model -----------------------------------------

enum { X, Y, Z, YAW, ROLL, PITCH, RIDER, REAR, STEER, FRONT, SWAY_DOFS };

// Energy - work of the drive: constant. Position, wheels: exact.
static void test_swaying_rider(void **unused) {
  (void)unused;
  mjModel *m = load("sway.xml");
  mjData *d = start_from_key(m);
  assert_int_equal(roll_drive_count(m), 1);
  assert_int_equal(roll_project(m, d), ROLL_OK);
  mjtNum start = energy(d), most_lean = 0, balance = 0, off = 0, slip = 0, height = 0;
  roll_disc disc[2];
  for (int i = 0; i < 10000; i++) {
    mj_step(m, d);
    most_lean = fmax(most_lean, fabs(d->qpos[ROLL]));
    if (i % 100) continue;
    mj_forward(m, d);
    assert_int_equal(roll_discs(disc, 2, m, d), ROLL_OK);
    for (int k = 0; k < 2; k++) slip = fmax(slip, mju_norm3(disc[k].slip));
    for (int k = 0; k < 2; k++) height = fmax(height, fabs(disc[k].height));
    balance = fmax(balance, fabs((energy(d) - d->act[0]) / start - 1));
    off = fmax(off, fabs(d->qpos[RIDER] - 0.02 * sin(2 * d->time)));
    assert_near(*sensor(m, d, "rolling:rider:error"), d->qpos[RIDER] - 0.02 * sin(2 * d->time),
                1e-15);
  }
  print_message("swaying rider, 10 s: lean up to %.3f rad, work %.3f J, energy balance %.1e, rider "
                "off by %.1e m, slip %.1e m/s, height %.1e m\n",
                most_lean, d->act[0], balance, off, slip, height);
  assert_below(balance, 1e-11);
  assert_below(off, 1e-12);
  assert_below(slip, 1e-10);
  assert_below(height, 1e-12);
  assert_true(most_lean > 0.01);
  assert_true(fabs(d->act[0]) > 1e-3);
  mj_deleteData(d);
  mj_deleteModel(m);
}

// The bicycle's trajectory with the drive as with the same force as an input: the drive's force at
// every stage, taken from a run with the drive, holds the rider on w when applied by hand.
static void test_force_is_what_it_takes(void **unused) {
  (void)unused;
  mjModel *m = load("sway.xml"), *bare = load("sway.xml");
  for (int i = 0; i < bare->ntuple; i++)
    if (strcmp(bare->names + bare->name_tupleadr[i], "rolling_driven") == 0)
      bare->tuple_size[i] = 0;
  mjData *d = start_from_key(m), *by_hand = start_from_key(bare);
  assert_int_equal(roll_project(m, d), ROLL_OK);
  d->time = 0.3;
  mj_forward(m, d);
  roll_drive drive;
  assert_int_equal(roll_drives(&drive, 1, m, d), ROLL_OK);
  assert_near(*sensor(m, d, "rolling:rider:force"), drive.force, 1e-12);
  mju_copy(by_hand->qpos, d->qpos, m->nq);
  mju_copy(by_hand->qvel, d->qvel, m->nv);
  by_hand->qfrc_applied[RIDER] = drive.force;
  mj_forward(bare, by_hand);
  for (int i = 0; i < SWAY_DOFS; i++) assert_near(by_hand->qacc[i], d->qacc[i], 1e-10);
  mj_deleteData(by_hand);
  mj_deleteData(d);
  mj_deleteModel(bare);
  mj_deleteModel(m);
}

// A start beside the motion is projected onto it, positions and velocities.
static void test_projection_follows_the_motion(void **unused) {
  (void)unused;
  mjModel *m = load("sway.xml");
  mjData *d = start_from_key(m);
  d->time = 0.7;
  d->qpos[RIDER] = 1;
  d->qvel[RIDER] = 5;
  d->qpos[ROLL] = 0.1;
  assert_int_equal(roll_project(m, d), ROLL_OK);
  assert_near(d->qpos[RIDER], 0.02 * sin(1.4), 1e-14);
  assert_near(d->qvel[RIDER], 0.04 * cos(1.4), 1e-12);
  mj_deleteData(d);
  mj_deleteModel(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_load_on_a_cart),
      cmocka_unit_test(test_swaying_rider),
      cmocka_unit_test(test_force_is_what_it_takes),
      cmocka_unit_test(test_projection_follows_the_motion),
  };
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
