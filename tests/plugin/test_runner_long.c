// SPDX-License-Identifier: Apache-2.0
// A minute of riding through the runner: what the constraint and the energy are worth at its end.
#include "equations/bicycles.h"
#include "runner_test_ride.h"

typedef struct extremes {
  int count;
  double slip, height; // m/s, m  largest of both wheels
  double energy;       // J       at the start
  double drift;        //         largest |E(t) - E(0) - work| / E(0)
} extremes;

// Keeps a NAN, which no limit then lets pass.
static void widen(double *largest, double value) {
  if (!(fabs(value) <= *largest)) *largest = fabs(value);
}

static int look(const runner_sample *s, void *user) {
  extremes *e = (extremes *)user;
  if (e->count++ == 0) e->energy = s->row.energy;
  widen(&e->drift, (s->row.energy - e->energy - s->more.work) / e->energy);
  for (int i = 0; i < 2; i++) {
    widen(&e->slip, s->slip[i]);
    widen(&e->height, s->height[i]);
  }
  return 0;
}

// RK4 at 1 ms with the hinge root, every step looked at.
static extremes ride_a_minute(const bike_state *start) {
  bike_bicycle b = read_shipped("benchmark");
  mjcf_options options = mjcf_default_options();
  runner *r = make_runner(&b, &options);
  start_runner(r, start);
  extremes e = {0};
  runner_ride_def def = runner_default_ride_def();
  def.duration = 60, def.sample = 1e-3;
  def.on_sample = look, def.user = &e;
  runner_ride_result result;
  mjcf_error error = {.text = ""};
  if (runner_ride(&result, r, &def, &error) != RUNNER_OK) fail_msg("%s", error.text);
  runner_free(r);
  assert_true(result.complete);
  assert_int_equal(e.count, 60001);
  return e;
}

// M2 of IFToMM's 'uncontrolled bicycle', and the same push at 5 m/s.
static void test_minute(void **state) {
  (void)state;
  const bike_state starts[] = {{.lean_rate = 0.5, .speed = 4.6}, {.lean_rate = 0.5, .speed = 5}};
  for (int i = 0; i < 2; i++) {
    extremes e = ride_a_minute(&starts[i]);
    printf("60 s from %.1f m/s: height %.1e m, slip %.1e m/s, energy %.1e\n", starts[i].speed,
           e.height, e.slip, e.drift);
    assert_below(e.height, 1e-12);
    assert_below(e.slip, 1e-10);
    assert_below(e.drift, 1e-11);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_minute)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
