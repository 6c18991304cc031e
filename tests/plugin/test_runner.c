// SPDX-License-Identifier: Apache-2.0
// MuJoCo's bicycle at one instant: published accelerations, and the analytic model at random
// states.
#include "equations/bicycles.h"
#include "reference/reference.h"
#include "runner_internal.h"
#include "support/near.h"
#include <bicycle/error.h>

static runner *runner_of(const bike_bicycle *bicycle, mjcf_root root) {
  mjcf_options options = mjcf_default_options();
  options.root = root;
  runner_status status;
  mjcf_error error = {.text = ""};
  runner *r = runner_create(bicycle, &options, &status, &error);
  if (!r) fail_msg("%s", error.text);
  return r;
}

static runner_instant instant_of(runner *r, const bike_state *state, const bike_input *input) {
  runner_instant out;
  mjcf_error error = {.text = ""};
  runner_status status = runner_evaluate(&out, r, state, input, &error);
  if (status != RUNNER_OK) fail_msg("%s", error.text);
  return out;
}

//---------------------------------- start ---------------------------------------------------------

static void test_start_satisfies_constraints(void **state) {
  (void)state;
  random_source source = random_begin("start", 7);
  double worst = 0;
  for (int i = 0; i < SHIPPED_COUNT; i++) {
    bike_bicycle b = read_shipped(shipped_bicycles[i].name);
    for (int root = 0; root < 2; root++) {
      runner *r = runner_of(&b, (mjcf_root)root);
      for (int k = 0; k < 200; k++) {
        bike_state s = random_state(&source, &shipped_bicycles[i].range);
        mjcf_error error = {.text = ""};
        assert_int_equal(runner_start(r, &s, &error), RUNNER_OK);
        double residual = runner_residual(r, runner_data(r));
        assert_below(residual, 1e-13);
        worst = fmax(worst, residual);
      }
      runner_free(r);
    }
  }
  printf("start: largest residual %.2e m, m/s\n", worst);
}

// The speed is that of the rear contact along its track, and nothing else.
static void test_speed_is_the_contacts(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("benchmark");
  runner *r = runner_of(&b, MJCF_ROOT_HINGE);
  bike_state s = {.lean = 0.3, .steer = 0.2, .lean_rate = 0.5, .steer_rate = 0.7, .speed = 4};
  runner_instant at = instant_of(r, &s, NULL);
  assert_near(at.speed, 4, 1e-14);
  double R = b.geometry.R_r, hub = at.speed + R * sin(s.lean) * at.yaw_rate;
  double hinge = R * at.wheel_rate[RUNNER_REAR];
  assert_true(fabs(at.pitch_rate) > 0.01);
  assert_true(fabs(hub - 4) > 0.01);
  assert_true(fabs(hinge - 4) > 0.003);
  assert_near(r->probe->qvel[0], hub, 1e-13); // what the definitions could be mistaken for
  runner_free(r);
}

// Wheels that all but coincide have many postures: the start is the one that upright leads to.
static void test_start_follows_upright(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("roadster");
  bike_upright upright;
  assert_int_equal(bike_upright_position(&upright, &b.geometry), BIKE_OK);
  b.geometry = bike_geometry_from_wheelbase(0.05, upright.trail, upright.tilt, b.geometry.R_r,
                                            b.geometry.R_f);
  for (int i = 0; i < b.part_count; i++)
    if (b.parts[i].assembly == BIKE_FRONT_WHEEL) b.parts[i].position[0] = 0.05;
  bike_model model;
  assert_int_equal(bike_model_init(&model, &b), BIKE_OK);
  runner *r = runner_of(&b, MJCF_ROOT_HINGE);
  bike_state s = {.lean = 0.44, .steer = 0.44, .speed = 4};
  bike_snapshot should;
  assert_int_equal(bike_evaluate(&should, &model, &s, NULL), BIKE_OK);
  assert_near(instant_of(r, &s, NULL).pitch, should.pitch, 1e-12); // some 0.5 rad, to rounding
  runner_free(r);
}

static void test_bad_starts(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("penny_farthing");
  runner *r = runner_of(&b, MJCF_ROOT_HINGE);
  mjcf_error error = {.text = ""};
  bike_state fallen = {.lean = 1.55, .speed = 3}, nan = {.steer_rate = NAN, .speed = 3};
  assert_int_equal(runner_start(r, &fallen, &error), RUNNER_ARGUMENT);
  assert_int_equal(runner_start(r, &nan, &error), RUNNER_ARGUMENT);
  // Where both engines find a position it is the same one; where there is none, that is said.
  random_source source = random_begin("bad_starts", 5);
  const random_range wide = {1.4, 2.5, 1, 1, 5};
  bike_model model;
  assert_int_equal(bike_model_init(&model, &b), 0);
  int impossible = 0;
  for (int i = 0; i < 500; i++) {
    bike_state s = random_state(&source, &wide);
    bike_snapshot snapshot;
    runner_instant at;
    runner_status status = runner_evaluate(&at, r, &s, NULL, &error);
    assert_true(status == RUNNER_OK || status == RUNNER_START);
    impossible += status == RUNNER_START;
    if (status != RUNNER_OK || bike_evaluate(&snapshot, &model, &s, &(bike_input){0}) != 0)
      continue;
    assert_near(at.pitch, snapshot.pitch, 1e-9); // near-singular positions among them
  }
  assert_in_range(impossible, 10, 250);
  assert_int_equal(runner_exit_code(RUNNER_START), 2);
  runner_free(r);
}

//---------------------------------- published -----------------------------------------------------

static double table1(const json_t *document, const char *path) {
  char full[100];
  snprintf(full, sizeof full, "basu_mandal2007_table1.%s", path);
  return reference_number(document, full);
}

// Basu-Mandal et al. (2007), table 1: x, y, z of the rear hub (there the bicycle heads for -x);
// psi = pi/2 - lean, phi = pi + pitch, psi_f the steer to the left, beta the wheels' hinges.
static void test_published_accelerations(void **state) {
  (void)state;
  json_t *t = reference_open();
  bike_bicycle b = read_shipped("benchmark");
  runner *r = runner_of(&b, MJCF_ROOT_HINGE);
  bike_state s = {.lean = acos(-1.0) / 2 - table1(t, "q.psi"),
                  .steer = table1(t, "q.psi_f"),
                  .lean_rate = -table1(t, "qd.psi"),
                  .steer_rate = table1(t, "qd.psi_f"),
                  .speed = b.geometry.R_r * (table1(t, "qd.phi") + table1(t, "qd.beta_r"))};
  runner_instant at = instant_of(r, &s, NULL);
  const double *v = r->probe->qvel, *a = r->probe->qacc;
  const struct {
    double is;
    const char *name;
    double sign;
  } rows[] = {{v[0], "qd.x", -1},      {v[1], "qd.y", -1},     {v[2], "qd.z", 1},
              {v[3], "qd.theta", 1},   {v[4], "qd.psi", -1},   {v[5], "qd.phi", 1},
              {v[6], "qd.beta_r", 1},  {v[7], "qd.psi_f", 1},  {v[8], "qd.beta_f", 1},
              {a[0], "qdd.x", -1},     {a[1], "qdd.y", -1},    {a[2], "qdd.z", 1},
              {a[3], "qdd.theta", 1},  {a[4], "qdd.psi", -1},  {a[5], "qdd.phi", 1},
              {a[6], "qdd.beta_r", 1}, {a[7], "qdd.psi_f", 1}, {a[8], "qdd.beta_f", 1}};
  double worst = 0;
  for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
    double published = rows[i].sign * table1(t, rows[i].name);
    // The table prints 13 decimals.
    assert_near(rows[i].is, published, 1e-11 * fmax(1, fabs(published)));
    worst = fmax(worst, fabs(rows[i].is - published) / fmax(1, fabs(published)));
  }
  printf("Basu-Mandal table 1: largest error %.2e\n", worst);
  assert_near(at.steer_acceleration, table1(t, "qdd.psi_f"), 1e-11 * 5);
  json_decref(t);
  runner_free(r);
}

//---------------------------------- analytic ------------------------------------------------------

// Largest disagreement of the two engines.
typedef struct gap {
  double acceleration; // of max(1, largest acceleration)
  double rate;         // rad/s, rad, m
  double force;        // of the total weight
  double energy;       // relative
} gap;

static void widen(double *largest, double is, double should, double scale) {
  double error = fabs(is - should) / scale;
  if (!(error <= *largest)) *largest = error;
}

static void widen_accelerations(gap *g, const runner_instant *is, const bike_snapshot *should) {
  const double pairs[7][2] = {
      {is->lean_acceleration, should->acceleration.lean},
      {is->steer_acceleration, should->acceleration.steer},
      {is->speed_rate, should->acceleration.speed},
      {is->yaw_acceleration, should->yaw_acceleration},
      {is->pitch_acceleration, should->pitch_acceleration},
      {is->wheel_acceleration[RUNNER_REAR], should->rear_wheel_acceleration},
      {is->wheel_acceleration[RUNNER_FRONT], should->front_wheel_acceleration}};
  double scale = 1;
  for (int i = 0; i < 7; i++) scale = fmax(scale, fabs(pairs[i][1]));
  for (int i = 0; i < 7; i++) widen(&g->acceleration, pairs[i][0], pairs[i][1], scale);
}

static void widen_rates(gap *g, const runner_instant *is, const bike_snapshot *should) {
  widen(&g->rate, is->pitch, should->pitch, 1);
  widen(&g->rate, is->yaw_rate, should->yaw_rate, 1);
  widen(&g->rate, is->pitch_rate, should->pitch_rate, 1);
  widen(&g->rate, is->wheel_rate[RUNNER_REAR], should->rear_wheel_rate, 1);
  widen(&g->rate, is->wheel_rate[RUNNER_FRONT], should->front_wheel_rate, 1);
  widen(&g->rate, is->x, 0, 1);
  widen(&g->rate, is->y, 0, 1);
  widen(&g->rate, is->power, should->power, 10);
}

// Both engines at one state.
static void compare(gap *g, runner *r, const bike_model *model, const bike_state *s,
                    const bike_input *input) {
  bike_snapshot should;
  assert_int_equal(bike_evaluate(&should, model, s, input), 0);
  runner_instant is = instant_of(r, s, input);
  double weight = model->total_mass * model->gravity;
  for (int k = 0; k < 3; k++) {
    widen(&g->force, is.force[RUNNER_REAR][k], should.rear_force[k], weight);
    widen(&g->force, is.force[RUNNER_FRONT][k], should.front_force[k], weight);
  }
  widen_accelerations(g, &is, &should);
  widen_rates(g, &is, &should);
  widen(&g->energy, is.kinetic, should.kinetic, should.kinetic);
  widen(&g->energy, is.potential, should.potential, should.potential);
}

// MuJoCo eliminates the constraints with cond(M) up to 1e5: what is lost of 1e-16 stays below
// 1e-11, of accelerations and of forces, which follow from them.
static void check_gap(const gap *g, const char *name) {
  printf("%-20s accelerations %.1e, rates %.1e, forces %.1e, energy %.1e\n", name, g->acceleration,
         g->rate, g->force, g->energy);
  assert_below(g->acceleration, 1e-11);
  assert_below(g->rate, 1e-11);
  assert_below(g->force, 1e-11);
  assert_below(g->energy, 1e-12);
}

static bike_input random_torques(random_source *source) {
  return (bike_input){.steer_torque = random_between(source, -5, 5),
                      .roll_torque = random_between(source, -50, 50)};
}

static void test_shipped_agree(void **state) {
  (void)state;
  random_source source = random_begin("shipped_agree", 11);
  for (int root = 0; root < 2; root++)
    for (int i = 0; i < SHIPPED_COUNT; i++) {
      bike_bicycle b = read_shipped(shipped_bicycles[i].name);
      bike_model model;
      assert_int_equal(bike_model_init(&model, &b), 0);
      runner *r = runner_of(&b, (mjcf_root)root);
      gap g = {0};
      for (int k = 0; k < 500; k++) {
        bike_state s = random_state(&source, &shipped_bicycles[i].range);
        bike_input input = random_torques(&source);
        compare(&g, r, &model, &s, &input);
      }
      check_gap(&g, b.name);
      runner_free(r);
    }
}

// Bicycles that are nobody's, with everything off the plane of symmetry.
static void test_random_bicycles_agree(void **state) {
  (void)state;
  random_source source = random_begin("random_bicycles_agree", 12);
  const random_range range = {0.6, 0.7, 2, 1, 10};
  gap g = {0};
  for (int i = 0; i < 60; i++) {
    bike_bicycle b = random_bicycle(&source, false);
    for (int k = 0; k < b.part_count; k++)
      if (b.parts[k].inertia[1] < 0.01) b.parts[k].inertia[1] = 0.01; // MuJoCo's wheels need spin
    bike_model model;
    assert_int_equal(bike_model_init(&model, &b), 0);
    runner *r = runner_of(&b, MJCF_ROOT_HINGE);
    for (int k = 0; k < 20; k++) {
      bike_state s = random_state(&source, &range);
      bike_input input = random_torques(&source);
      compare(&g, r, &model, &s, &input);
    }
    runner_free(r);
  }
  check_gap(&g, "random bicycles");
}

static void test_displaced_rider_agrees(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("roadster");
  bike_model model;
  assert_int_equal(bike_model_init(&model, &b), 0);
  mjcf_options options = mjcf_default_options();
  options.rider_offset = 0.03;
  runner_status status;
  mjcf_error error = {.text = ""};
  runner *r = runner_create(&b, &options, &status, &error);
  assert_non_null(r);
  bike_state s = {0.1, -0.05, 0.2, 0.1, 5};
  bike_input input = {.steer_torque = 1, .rider_offset = 0.03};
  gap g = {0};
  compare(&g, r, &model, &s, &input);
  check_gap(&g, "displaced rider");
  // Elsewhere than the model was built for, or moving: refused.
  runner_instant out;
  input.rider_offset = 0;
  assert_int_equal(runner_evaluate(&out, r, &s, &input, &error), RUNNER_UNSUPPORTED);
  input = (bike_input){.rider_offset = 0.03, .rider_velocity = 0.1};
  assert_int_equal(runner_evaluate(&out, r, &s, &input, &error), RUNNER_UNSUPPORTED);
  input = (bike_input){.rider_offset = 0.03, .steer_torque = NAN};
  assert_int_equal(runner_evaluate(&out, r, &s, &input, &error), RUNNER_ARGUMENT);
  runner_free(r);
}

// Standing upright, the ground carries each wheel's share.
static void test_static_loads(void **state) {
  (void)state;
  json_t *document = reference_open();
  bike_bicycle b = read_shipped("benchmark");
  runner *r = runner_of(&b, MJCF_ROOT_HINGE);
  bike_state s = {0};
  runner_instant at = instant_of(r, &s, NULL);
  assert_near(at.force[RUNNER_REAR][2],
              reference_number(document, "meijaard2007.static_normal_forces.rear"), 1e-9);
  assert_near(at.force[RUNNER_FRONT][2],
              reference_number(document, "meijaard2007.static_normal_forces.front"), 1e-9);
  json_decref(document);
  runner_free(r);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_start_satisfies_constraints),
                                     cmocka_unit_test(test_speed_is_the_contacts),
                                     cmocka_unit_test(test_start_follows_upright),
                                     cmocka_unit_test(test_bad_starts),
                                     cmocka_unit_test(test_published_accelerations),
                                     cmocka_unit_test(test_shipped_agree),
                                     cmocka_unit_test(test_random_bicycles_agree),
                                     cmocka_unit_test(test_displaced_rider_agrees),
                                     cmocka_unit_test(test_static_loads)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
