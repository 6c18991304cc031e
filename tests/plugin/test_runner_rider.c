// SPDX-License-Identifier: Apache-2.0
// A rider who moves: the generated model's driven joint against the analytic model's rider.
#include "equations/bicycles.h"
#include "runner_test_ride.h"

static trace mujoco, analytic; // too large for the stack

static const double amplitude = 0.02, rate = 2; // m, rad/s

static void sway(double time, bike_input *out, void *user) {
  (void)user;
  *out = (bike_input){.rider_offset = amplitude * sin(rate * time),
                      .rider_velocity = amplitude * rate * cos(rate * time),
                      .rider_acceleration = -amplitude * rate * rate * sin(rate * time)};
}

// The same, while the handlebar is turned too.
static void sway_and_steer(double time, bike_input *out, void *user) {
  sway(time, out, user);
  out->steer_torque = 0.3 * sin(3 * time);
}

typedef struct task {
  const char *bicycle;
  bike_state start;
  bike_input_function *input;
  double rider_offset; // m  that the model is built with
  double tolerance;    //    of CVODE; 0: the integrator below
  mjcf_root root;
  mjcf_integrator integrator;
  double timestep; // s  0: 1 ms
} task;

static void ride_mujoco(const task *t) {
  bike_bicycle b = read_shipped(t->bicycle);
  mjcf_options options = mjcf_default_options();
  options.moving_rider = true;
  options.rider_offset = t->rider_offset;
  options.root = t->root, options.integrator = t->integrator;
  if (t->timestep > 0) options.timestep = t->timestep;
  runner *r = make_runner(&b, &options);
  start_runner(r, &t->start);
  runner_ride_def def = runner_default_ride_def();
  def.input = t->input, def.tolerance = t->tolerance;
  def.on_sample = keep_mujoco, def.user = &mujoco;
  mujoco = (trace){0};
  runner_ride_result result;
  mjcf_error error = {.text = ""};
  if (runner_ride(&result, r, &def, &error) != RUNNER_OK) fail_msg("%s", error.text);
  assert_true(result.complete);
  runner_free(r);
}

static void ride_analytic(const task *t) {
  bike_bicycle b = read_shipped(t->bicycle);
  bike_model model;
  assert_int_equal(bike_model_init(&model, &b), 0);
  bike_ride_def def = bike_default_ride_def();
  def.start = t->start;
  def.duration = runner_default_ride_def().duration;
  def.sample = runner_default_ride_def().sample;
  def.input = t->input;
  def.on_sample = keep_analytic, def.user = &analytic;
  analytic = (trace){0};
  bike_ride_result result;
  assert_int_equal(bike_ride(&result, &model, &def), 0);
}

typedef struct gap {
  double lean, steer; // rad
  double work;        // J
  double balance;     // largest |E(t) - E(0) - work| / E(0)
  double most_lean;   // rad  of the ride
} gap;

// Keeps a NAN, which no limit then lets pass.
static void widen(double *largest, double value) {
  if (!(fabs(value) <= *largest)) *largest = fabs(value);
}

static gap compare(void) {
  gap g = {0};
  double start = mujoco.row[0].energy;
  assert_int_equal(mujoco.count, analytic.count);
  for (int i = 0; i < mujoco.count; i++) {
    const bike_sample *p = &mujoco.row[i], *q = &analytic.row[i];
    widen(&g.lean, p->lean - q->lean);
    widen(&g.steer, p->steer - q->steer);
    widen(&g.work, mujoco.work[i] - analytic.work[i]);
    widen(&g.balance, (p->energy - start - mujoco.work[i]) / start);
    widen(&g.most_lean, q->lean);
  }
  return g;
}

static void check(const task *t, const char *name) {
  ride_mujoco(t);
  ride_analytic(t);
  gap g = compare();
  printf("%s: lean up to %.3f rad; lean %.1e, steer %.1e rad, work %.1e J, energy less work %.1e\n",
         name, g.most_lean, g.lean, g.steer, g.work, g.balance);
  assert_true(g.most_lean > 0.01);
  assert_below(g.lean, 1e-10);
  assert_below(g.steer, 1e-10);
  assert_below(g.work, 1e-9); // of 1.5 kJ
  assert_below(g.balance, 1e-11);
  assert_below(mujoco.slip, 1e-10);
}

static void test_rides_agree(void **state) {
  (void)state;
  const bike_state start = {.speed = 6};
  check(&(task){.bicycle = "roadster", .start = start, .input = sway}, "swaying rider");
  check(&(task){.bicycle = "roadster", .start = start, .input = sway_and_steer},
        "swaying and steering");
  // The offset that the model is built with is but the zero of the joint.
  check(&(task){.bicycle = "roadster", .start = start, .input = sway, .rider_offset = 0.05},
        "built in aside");
  check(&(task){.bicycle = "roadster", .start = start, .input = sway, .tolerance = 1e-13},
        "by CVODE");
  check(&(task){.bicycle = "roadster",
                .start = start,
                .input = sway,
                .tolerance = 1e-13,
                .root = MJCF_ROOT_FREE},
        "by CVODE, free root");
}

// What is not RK4 with hinges converges to the same ride, with the order that MuJoCo has without a
// rider too: his motion is put in at the times of the stages.
static void check_order(const task *t, const char *name, double order, double most) {
  task half = *t;
  gap g[2];
  for (int i = 0; i < 2; i++) {
    half.timestep = i == 0 ? 1e-3 : 5e-4;
    ride_mujoco(&half);
    g[i] = compare();
  }
  double measured = log2(g[0].lean / g[1].lean);
  printf("%s: lean %.1e, %.1e rad at half the step: order %.2f; work %.1e J, energy %.1e\n", name,
         g[0].lean, g[1].lean, measured, g[0].work, g[0].balance);
  assert_below(g[0].lean, most);
  assert_near(measured, order, 0.1);
}

static void test_other_integrators_converge(void **state) {
  (void)state;
  const bike_state start = {.speed = 6};
  task t = {.bicycle = "roadster", .start = start, .input = sway_and_steer};
  ride_analytic(&t);
  t.root = MJCF_ROOT_FREE;
  check_order(&t, "free root", 2, 1e-7);
  const mjcf_integrator first_order[] = {MJCF_EULER, MJCF_IMPLICIT};
  for (int i = 0; i < 4; i++) {
    t.root = i % 2 ? MJCF_ROOT_FREE : MJCF_ROOT_HINGE;
    t.integrator = first_order[i / 2];
    check_order(&t, i / 2 ? "implicit" : "Euler", 1, 3e-3); // rad: some 2 rad/s by 1 ms
  }
}

// One instant of a rider on the move; afterwards he sits where the model has him.
static void test_instant(void **state) {
  (void)state;
  bike_bicycle b = read_shipped("roadster");
  bike_model model;
  bike_rates rates;
  assert_int_equal(bike_model_init(&model, &b), 0);
  mjcf_options options = mjcf_default_options();
  options.moving_rider = true;
  runner *r = make_runner(&b, &options);
  const bike_state at = {.lean = 0.1, .steer = -0.05, .lean_rate = 0.2, .speed = 5};
  const bike_input input = {
      .rider_offset = 0.03, .rider_velocity = 0.2, .rider_acceleration = -1.5, .steer_torque = 1};
  const bike_input *inputs[] = {&input, NULL};
  for (int i = 0; i < 2; i++) {
    runner_instant is;
    mjcf_error error = {.text = ""};
    if (runner_evaluate(&is, r, &at, inputs[i], &error) != RUNNER_OK) fail_msg("%s", error.text);
    assert_int_equal(bike_rates_of(&rates, &model, &at, inputs[i]), 0);
    assert_near(is.lean_acceleration, rates.acceleration.lean, 1e-11);
    assert_near(is.steer_acceleration, rates.acceleration.steer, 1e-11);
  }
  runner_free(r);
}

static void refuse(const char *bicycle, const mjcf_options *options, const char *word) {
  bike_bicycle b = read_shipped(bicycle);
  mjcf_error error = {.text = ""};
  assert_null(mjcf_text(&b, options, NULL, &error));
  assert_non_null(strstr(error.text, word));
}

static void test_refusals(void **state) {
  (void)state;
  mjcf_options options = mjcf_default_options();
  options.moving_rider = true;
  refuse("roadster_riderless", &options, "rider");
  options.rolling = MJCF_ROLLING_CONTACT;
  refuse("roadster", &options, "exact rolling");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_rides_agree), cmocka_unit_test(test_other_integrators_converge),
      cmocka_unit_test(test_instant), cmocka_unit_test(test_refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
