// SPDX-License-Identifier: Apache-2.0
// Where rides of MuJoCo's bicycle begin and end, against the analytic ones.
#include "equations/bicycles.h"
#include "runner_test_ride.h"

static trace mujoco, analytic; // too large for the stack

// Rides of a tenth of a second by both engines under the same limits.
static void ride_under(runner_ride_result *is, bike_ride_result *should, const bike_state *start,
                       double lean_limit, bool stop_at_lift, mjcf_root root) {
  bike_bicycle b = read_shipped("benchmark");
  bike_model model;
  mjcf_options options = mjcf_default_options();
  options.root = root;
  runner *r = make_runner(&b, &options);
  start_runner(r, start);
  runner_ride_def def = runner_default_ride_def();
  def.duration = 0.1, def.lean_limit = lean_limit, def.stop_at_lift = stop_at_lift;
  def.on_sample = keep_mujoco, def.user = &mujoco;
  mjcf_error error = {.text = ""};
  mujoco = analytic = (trace){0};
  if (runner_ride(is, r, &def, &error) != RUNNER_OK) fail_msg("%s", error.text);
  runner_free(r);
  bike_ride_def reference = bike_default_ride_def();
  assert_int_equal(bike_model_init(&model, &b), 0);
  reference.start = *start;
  reference.duration = def.duration, reference.sample = def.sample;
  reference.lean_limit = lean_limit, reference.stop_at_lift = stop_at_lift;
  reference.on_sample = keep_analytic, reference.user = &analytic;
  assert_int_equal(bike_ride(should, &model, &reference), 0);
}

// What holds at the start happens at time 0, exactly; who starts at rest does not come to rest.
static void test_events_at_the_start(void **state) {
  (void)state;
  const struct {
    bike_state start;
    double lean_limit;
    bool stop_at_lift;
    int events;
  } cases[] = {{{.lean = 0.5, .speed = 4}, 0.4, false, 1},
               {{.lean = -0.5, .speed = 4}, 0.5, false, 1},
               {{.lean = 0.1, .steer = 0.3, .speed = 300}, 1, true, 1},
               {{.lean = 0.1, .lean_rate = 0.3}, 1, false, 0},
               {{.lean = 0.2, .steer = -0.3, .steer_rate = 1}, 1, false, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    for (int root = 0; root < 2; root++) {
      runner_ride_result is;
      bike_ride_result should;
      ride_under(&is, &should, &cases[i].start, cases[i].lean_limit, cases[i].stop_at_lift,
                 (mjcf_root)root);
      assert_int_equal(should.event_count, cases[i].events);
      assert_int_equal(is.event_count, should.event_count);
      assert_int_equal(is.complete, should.complete);
      assert_int_equal(mujoco.count, analytic.count);
      assert_near(is.end_time, should.end_time, 0);
      for (int k = 0; k < is.event_count; k++) {
        assert_int_equal(is.events[k].kind, should.events[k].kind);
        assert_near(is.events[k].time, 0, 0);
      }
    }
}

// The first row is what was asked for, without the rounding of a start found by iteration.
static void test_first_row_is_exact(void **state) {
  (void)state;
  const bike_state starts[] = {{.lean = 0.3, .steer = -0.4, .lean_rate = 1, .speed = 5.3},
                               {.lean = -0.2, .steer = 0.7, .steer_rate = 2, .speed = -3.1}};
  for (int i = 0; i < 4; i++) {
    const bike_state *start = &starts[i / 2];
    runner_ride_result is;
    bike_ride_result should;
    ride_under(&is, &should, start, 1.4, false, (mjcf_root)(i % 2));
    const bike_sample *first = &mujoco.row[0];
    assert_near(first->x, 0, 0);
    assert_near(first->y, 0, 0);
    assert_near(first->yaw, 0, 0);
    assert_near(first->speed, start->speed, 0);
    assert_near(first->lean, start->lean, 0);
    assert_near(first->steer_rate, start->steer_rate, 0);
  }
}

// The end of a ride is given though no row stands there.
static void test_end_of_a_fall(void **state) {
  (void)state;
  runner_ride_result is;
  bike_ride_result should;
  const bike_state start = {.lean = 0.4, .lean_rate = 1, .speed = 4};
  ride_under(&is, &should, &start, 0.45, false, MJCF_ROOT_HINGE);
  assert_false(is.complete);
  assert_near(is.end.time, is.end_time, 0);
  assert_near(should.end.time, should.end_time, 0);
  assert_near(should.end.lean, 0.45, 1e-11);
  // Interpolated within a step of 1 ms.
  assert_near(is.end.lean, 0.45, 1e-12);
  assert_near(is.end.steer, should.end.steer, 1e-5);
  assert_near(is.end.rear_friction, should.end.rear_friction, 1e-4);
  assert_true(should.end.lean > analytic.row[analytic.count - 1].lean);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_events_at_the_start),
                                     cmocka_unit_test(test_first_row_is_exact),
                                     cmocka_unit_test(test_end_of_a_fall)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
