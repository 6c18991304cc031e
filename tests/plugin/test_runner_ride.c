// SPDX-License-Identifier: Apache-2.0
// Rides of MuJoCo's bicycle against the analytic ones.
#include "equations/bicycles.h"
#include "runner_test_ride.h"

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <pthread.h>

#define DEGREE 0.017453292519943295

static trace mujoco, analytic; // too large for the stack

typedef struct difference {
  double lean, steer, yaw, place, speed;
  double work;  // of the start's energy
  double force; // of the weight
} difference;

static void widen(double *largest, double is, double should) {
  double error = fabs(is - should);
  if (!(error <= *largest)) *largest = error;
}

static difference compare(const trace *a, const trace *b) {
  difference d = {0};
  assert_int_equal(a->count, b->count);
  for (int i = 0; i < a->count; i++) {
    const bike_sample *p = &a->row[i], *q = &b->row[i];
    assert_near(p->time, q->time, 1e-12);
    widen(&d.lean, p->lean, q->lean);
    widen(&d.steer, p->steer, q->steer);
    widen(&d.yaw, p->yaw, q->yaw);
    widen(&d.place, p->x, q->x);
    widen(&d.place, p->y, q->y);
    widen(&d.speed, p->speed, q->speed);
    double weight = q->rear_normal + q->front_normal;
    for (int k = 0; k < 2; k++) widen(&d.force, a->force[i][k] / weight, b->force[i][k] / weight);
    widen(&d.work, a->work[i] / a->row[0].energy, b->work[i] / a->row[0].energy);
  }
  return d;
}

// Largest |E(t) - E(0) - work| / E(0).
static double balance(const trace *t) {
  double largest = 0, start = t->row[0].energy;
  for (int i = 0; i < t->count; i++)
    widen(&largest, (t->row[i].energy - start - t->work[i]) / start, 0);
  return largest;
}

// What both engines are told.
typedef struct task {
  const char *bicycle;
  bike_state start;
  double duration;
  bike_input_function *input;
  double rider_offset;
} task;

static void ride_mujoco(trace *out, runner_ride_result *result, const task *t,
                        const mjcf_options *options) {
  bike_bicycle b = read_shipped(t->bicycle);
  mjcf_options own = *options;
  own.rider_offset = t->rider_offset;
  runner *r = make_runner(&b, &own);
  start_runner(r, &t->start);
  runner_ride_def def = runner_default_ride_def();
  def.duration = t->duration;
  def.input = t->input;
  def.on_sample = keep_mujoco;
  def.user = out;
  mjcf_error error = {.text = ""};
  *out = (trace){0};
  if (runner_ride(result, r, &def, &error) != RUNNER_OK) fail_msg("%s", error.text);
  runner_free(r);
}

static void ride_analytic(trace *out, bike_ride_result *result, const task *t) {
  bike_bicycle b = read_shipped(t->bicycle);
  bike_model model;
  assert_int_equal(bike_model_init(&model, &b), 0);
  bike_ride_def def = bike_default_ride_def();
  def.start = t->start;
  def.duration = t->duration;
  def.sample = runner_default_ride_def().sample;
  def.lean_limit = runner_default_ride_def().lean_limit;
  def.input = t->input;
  def.on_sample = keep_analytic;
  def.user = out;
  *out = (trace){0};
  assert_int_equal(bike_ride(result, &model, &def), 0);
}

static difference ride_both(const task *t, const mjcf_options *options) {
  runner_ride_result result;
  bike_ride_result reference;
  ride_mujoco(&mujoco, &result, t, options);
  ride_analytic(&analytic, &reference, t);
  assert_true(result.complete);
  return compare(&mujoco, &analytic);
}

//---------------------------------- hands off
//------------------------------------------------------

static void check_ride(const task *t, double limit) {
  mjcf_options options = mjcf_default_options();
  difference d = ride_both(t, &options);
  double drift = balance(&mujoco);
  printf("%-14s v %-4g: lean %.1e, steer %.1e rad; energy %.1e, slip %.1e m/s, height %.1e m\n",
         t->bicycle, t->start.speed, d.lean, d.steer, drift, mujoco.slip, mujoco.height);
  assert_below(d.lean, limit);
  assert_below(d.steer, limit);
  assert_below(d.force, 1e-9);
  assert_below(drift, 1e-11);
  assert_below(mujoco.slip, 1e-10);
  assert_below(mujoco.height, 1e-11);
}

// RK4 at 1 ms, 10 s. M1, M2, M3: IFToMM's 'uncontrolled bicycle'.
static void test_rides_agree(void **state) {
  (void)state;
  const task tasks[] = {
      {"benchmark", {.lean_rate = 0.5, .speed = 4.6}, 10, NULL, 0},
      {"benchmark", {.lean_rate = 0.05, .speed = 8}, 10, NULL, 0},
      {"roadster", {.lean_rate = 0.2, .speed = 6}, 10, NULL, 0},
      {"roadster", {.lean = 20 * DEGREE, .steer = -17 * DEGREE, .speed = 6}, 10, NULL, 0},
      {"recumbent", {.lean_rate = 0.1, .speed = 13}, 10, NULL, 0},
      {"recumbent_damped", {.lean_rate = 0.1, .speed = 13}, 10, NULL, 0},
      {"penny_farthing", {.lean_rate = 0.05, .speed = 2.5}, 10, NULL, 0}};
  for (size_t i = 0; i < sizeof tasks / sizeof tasks[0]; i++) check_ride(&tasks[i], 1e-11);
}

// M1 is unstable: what rounding and truncation leave grows with the largest eigenvalue.
static void test_unstable_ride_agrees(void **state) {
  (void)state;
  const task m1 = {"benchmark", {.lean_rate = 0.05, .speed = 4}, 10, NULL, 0};
  bike_bicycle b = read_shipped("benchmark");
  bike_model model;
  bike_eigenvalues values;
  assert_int_equal(bike_model_init(&model, &b), 0);
  assert_int_equal(bike_upright_eigenvalues(&values, &model, m1.start.speed), 0);
  assert_true(values.re[0] > 0.1);
  check_ride(&m1, 1e-11 * exp(values.re[0] * m1.duration));
}

static void test_order_of_rk4(void **state) {
  (void)state;
  const task m2 = {"benchmark", {.lean_rate = 0.5, .speed = 4.6}, 10, NULL, 0};
  double error[2][2];
  for (int root = 0; root < 2; root++)
    for (int i = 0; i < 2; i++) {
      mjcf_options options = mjcf_default_options();
      options.root = (mjcf_root)root;
      options.timestep = i ? 5e-3 : 1e-2;
      error[root][i] = ride_both(&m2, &options).lean;
    }
  double hinge = log2(error[0][0] / error[0][1]), free_root = log2(error[1][0] / error[1][1]);
  printf("order: hinge root %.2f, free root %.2f\n", hinge, free_root);
  assert_near(hinge, 4, 0.2);
  assert_near(free_root, 2, 0.2);
}

//---------------------------------- inputs --------------------------------------------------------

static void sway_steer(double time, bike_input *out, void *user) {
  (void)user;
  *out = (bike_input){.steer_torque = 0.3 * sin(3 * time), .roll_torque = 2 * cos(2 * time)};
}

// A step's stages see the input at their own times, and the work is one more state.
static void test_torques_agree(void **state) {
  (void)state;
  const task torques = {"recumbent_damped", {.lean_rate = 0.05, .speed = 13}, 5, sway_steer, 0};
  mjcf_options options = mjcf_default_options();
  difference d = ride_both(&torques, &options);
  printf("torques: lean %.1e, steer %.1e rad, work %.1e of E; energy %.1e\n", d.lean, d.steer,
         d.work, balance(&mujoco));
  assert_true(fabs(mujoco.work[mujoco.count - 1]) > 0.01);
  assert_below(d.lean, 1e-11);
  assert_below(d.steer, 1e-11);
  assert_below(d.work, 1e-12);
  assert_below(balance(&mujoco), 1e-12);
}

static void sit_aside(double time, bike_input *out, void *user) {
  (void)time, (void)user;
  *out = (bike_input){.rider_offset = 0.01};
}

static void test_displaced_rider_agrees(void **state) {
  (void)state;
  const task aside = {"roadster", {.lean = 0.05, .speed = 5.5}, 5, sit_aside, 0.01};
  mjcf_options options = mjcf_default_options();
  difference d = ride_both(&aside, &options);
  assert_below(d.lean, 1e-11);
  assert_below(d.steer, 1e-11);
}

//---------------------------------- ends ----------------------------------------------------------

static void test_fall(void **state) {
  (void)state;
  const task fall = {"roadster", {.lean = 0.1, .speed = 0.5}, 10, NULL, 0};
  mjcf_options options = mjcf_default_options();
  runner_ride_result is;
  bike_ride_result should;
  ride_mujoco(&mujoco, &is, &fall, &options);
  ride_analytic(&analytic, &should, &fall);
  assert_false(is.complete);
  assert_false(should.complete);
  assert_true(is.event_count > 0);
  assert_int_equal(is.event_count, should.event_count);
  for (int i = 0; i < is.event_count; i++) {
    assert_int_equal(is.events[i].kind, should.events[i].kind);
    // Interpolated within a step of 1 ms, whose square this is the size of.
    assert_near(is.events[i].time, should.events[i].time, 1e-5);
  }
  assert_near(is.end_time, should.end_time, 1e-5);
  assert_int_equal(mujoco.count, analytic.count);
}

static void test_straight_stays_straight(void **state) {
  (void)state;
  const task straight = {"penny_farthing", {.speed = 5}, 10, NULL, 0};
  mjcf_options options = mjcf_default_options();
  runner_ride_result result;
  ride_mujoco(&mujoco, &result, &straight, &options);
  for (int i = 0; i < mujoco.count; i++) {
    assert_near(mujoco.row[i].lean, 0, 0);
    assert_near(mujoco.row[i].steer, 0, 0);
    assert_near(mujoco.row[i].y, 0, 0);
    assert_near(mujoco.row[i].x, 5 * mujoco.row[i].time, 1e-10);
  }
}

//---------------------------------- variants ------------------------------------------------------

static void push_left(double time, bike_input *out, void *user) {
  (void)time, (void)user;
  *out = (bike_input){.roll_torque = -10};
}

// A turn of more than a circle with a free root: yaw must not jump.
static void test_free_root_turns(void **state) {
  (void)state;
  const task turn = {"benchmark", {.speed = 5}, 10, push_left, 0};
  mjcf_options options = mjcf_default_options();
  options.root = MJCF_ROOT_FREE;
  difference d = ride_both(&turn, &options);
  assert_true(analytic.row[analytic.count - 1].yaw > 6.5);
  // Order 2 in orientation: MuJoCo's RK4 with a free joint.
  assert_below(d.lean, 1e-5);
  assert_below(d.yaw, 1e-5);
}

// Euler and implicit are of order 1; contacts are another model. All must stay near for 2 s.
static void test_coarse_variants(void **state) {
  (void)state;
  const task m2 = {"benchmark", {.lean_rate = 0.5, .speed = 4.6}, 2, NULL, 0};
  for (int rolling = 0; rolling < 2; rolling++)
    for (int integrator = MJCF_EULER; integrator <= MJCF_IMPLICIT; integrator++) {
      mjcf_options options = mjcf_default_options();
      options.rolling = (mjcf_rolling)rolling;
      options.integrator = (mjcf_integrator)integrator;
      difference d = ride_both(&m2, &options);
      printf("%s, %s: lean %.1e rad, slip %.1e m/s\n", rolling ? "contact" : "exact",
             integrator == MJCF_EULER ? "Euler" : "implicit", d.lean, mujoco.slip);
      assert_below(d.lean, 5e-3);
      // The contacts carry the bicycle's weight.
      const bike_sample *last = &mujoco.row[mujoco.count - 1];
      assert_near(last->rear_normal + last->front_normal, 94 * 9.81, 30);
    }
}

//---------------------------------- threads -------------------------------------------------------

typedef struct rider {
  runner *r;
  trace t;
  runner_status status;
} rider;

static void *ride_in_thread(void *argument) {
  rider *who = (rider *)argument;
  runner_ride_def def = runner_default_ride_def();
  def.duration = 2;
  def.on_sample = keep_mujoco;
  def.user = &who->t;
  def.input = sway_steer;
  runner_ride_result result;
  mjcf_error error;
  who->status = runner_ride(&result, who->r, &def, &error);
  return NULL;
}

// Two rides at once are to the last bit what they are one after the other.
static void test_threads(void **state) {
  (void)state;
  enum { RIDERS = 4 };
  static rider riders[RIDERS];
  static const char *const names[] = {"benchmark", "roadster"};
  const bike_state start = {.lean_rate = 0.1, .speed = 5.5};
  mjcf_options options = mjcf_default_options();
  for (int i = 0; i < RIDERS; i++) {
    bike_bicycle b = read_shipped(names[i % 2]);
    riders[i] = (rider){.r = make_runner(&b, &options)};
    start_runner(riders[i].r, &start);
  }
  ride_in_thread(&riders[0]);
  ride_in_thread(&riders[1]);
  pthread_t threads[2];
  for (int i = 0; i < 2; i++)
    assert_int_equal(pthread_create(&threads[i], NULL, ride_in_thread, &riders[2 + i]), 0);
  for (int i = 0; i < 2; i++) pthread_join(threads[i], NULL);
  for (int i = 0; i < RIDERS; i++) {
    assert_int_equal(riders[i].status, RUNNER_OK);
    assert_int_equal(riders[i].t.count, 201);
    runner_free(riders[i].r);
  }
  for (int i = 0; i < 2; i++)
    assert_memory_equal(riders[i].t.row, riders[2 + i].t.row, sizeof riders[i].t.row);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_rides_agree),
                                     cmocka_unit_test(test_unstable_ride_agrees),
                                     cmocka_unit_test(test_order_of_rk4),
                                     cmocka_unit_test(test_torques_agree),
                                     cmocka_unit_test(test_displaced_rider_agrees),
                                     cmocka_unit_test(test_fall),
                                     cmocka_unit_test(test_straight_stays_straight),
                                     cmocka_unit_test(test_free_root_turns),
                                     cmocka_unit_test(test_coarse_variants),
                                     cmocka_unit_test(test_threads)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
