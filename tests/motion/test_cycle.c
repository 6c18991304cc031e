// SPDX-License-Identifier: Apache-2.0
// Limit cycles: closed by another integrator, and doing to neighbouring rides what their
// multipliers say.
#include "equations/bicycles.h"
#include "support/near.h"
#include <bicycle/cycle.h>
#include <bicycle/error.h>
#include <bicycle/ride.h>
#include <bicycle/stability.h>
#include <bicycle/variant.h>

static const double DEGREE = M_PI / 180;

static bike_model shipped(const char *name) {
  bike_model model;
  bike_bicycle bicycle = read_shipped(name);
  assert_int_equal(bike_model_init(&model, &bicycle), BIKE_OK);
  return model;
}

static double weave_speed(const bike_model *model) {
  bike_critical_speeds found;
  assert_int_equal(bike_upright_critical_speeds(&found, model, 0, 40), BIKE_OK);
  assert_true(found.weave_count > 0);
  return found.weave[0];
}

static bike_cycle cycle_of(const bike_model *model, double lean) {
  bike_cycle cycle;
  double weave = weave_speed(model);
  assert_int_equal(bike_cycle_find(&cycle, model, 1 * DEGREE, weave, NULL), BIKE_OK);
  for (double at = 2 * DEGREE; at < lean + 1e-9; at += DEGREE)
    assert_int_equal(bike_cycle_find(&cycle, model, at, weave, &cycle), BIKE_OK);
  assert_near(cycle.lean, lean, 1e-9);
  return cycle;
}

static int keep_last(const bike_sample *sample, const bike_sample_more *more, void *user) {
  (void)more;
  *(bike_sample *)user = *sample;
  return 0;
}

static bike_sample ride(const bike_model *model, const bike_state *start, double time) {
  bike_sample end;
  bike_ride_result result;
  bike_ride_def def = bike_default_ride_def();
  def.start = *start;
  def.duration = def.sample = time;
  def.method = BIKE_METHOD_ADAMS; // not the one that found the cycle
  def.on_sample = keep_last;
  def.user = &end;
  assert_int_equal(bike_ride(&result, model, &def), BIKE_OK);
  assert_true(result.complete);
  return end;
}

// After a period everything is as before; after half of one it is the mirror image.
static void cycles_close(void **state) {
  (void)state;
  static const char *const names[] = {"roadster", "benchmark", "recumbent"};
  for (int i = 0; i < 3; i++) {
    bike_model model = shipped(names[i]);
    bike_cycle c = cycle_of(&model, 6 * DEGREE);
    bike_sample end = ride(&model, &c.start, c.period), half = ride(&model, &c.start, c.period / 2);
    // shooting leaves 1e-9 of the amplitude
    assert_near(end.lean, c.lean, 1e-8);
    assert_near(end.steer, c.start.steer, 1e-8);
    assert_near(end.lean_rate, 0, 1e-8);
    assert_near(end.steer_rate, c.start.steer_rate, 1e-7);
    assert_near(end.speed, c.start.speed, 1e-8);
    assert_near(half.lean, -c.lean, 1e-8);
    assert_near(half.steer, -c.start.steer, 1e-8);
    assert_near(end.x / c.period, c.mean_speed, 0.1); // the track winds
    bike_snapshot here, upright;
    bike_state straight = {.speed = c.speed};
    assert_int_equal(bike_evaluate(&here, &model, &c.start, NULL), BIKE_OK);
    assert_int_equal(bike_evaluate(&upright, &model, &straight, NULL), BIKE_OK);
    assert_relative(here.kinetic + here.potential, upright.kinetic + upright.potential, 1e-13);
  }
}

static bike_hopf hopf_of(const bike_model *model) {
  bike_hopf hopf;
  assert_int_equal(bike_hopf_at(&hopf, model, weave_speed(model)), BIKE_OK);
  return hopf;
}

// Small cycles lie at weave speed + curvature * lean^2, on the side that the kind of bifurcation
// says, and are as stable.
static void check_birth(const char *name, bool supercritical) {
  bike_model model = shipped(name);
  bike_hopf hopf = hopf_of(&model);
  printf("%s: %scritical, %.4f m/s per rad^2, frequency %.4f rad/s\n", name,
         hopf.supercritical ? "super" : "sub", hopf.curvature, hopf.mode.frequency);
  assert_true(hopf.supercritical == supercritical);
  assert_true(hopf.unstable_side < 0); // all of them weave below
  bike_cycle c = cycle_of(&model, 2 * DEGREE);
  double distance = c.speed - hopf.speed;
  assert_true((distance * hopf.unstable_side > 0) == supercritical);
  assert_true((c.multiplier < 1) == supercritical);
  // the next term is some ten times lean^2 of it
  assert_relative(distance / (c.lean * c.lean), hopf.curvature, 0.02);
  assert_relative(2 * M_PI / c.period, hopf.mode.frequency, 0.01);
  assert_relative(c.ratio, hopf.mode.ratio, 0.01);
  assert_near(c.lag, hopf.mode.lag, 0.01);
}

static void births(void **state) {
  (void)state;
  check_birth("roadster", true);
  check_birth("benchmark", true);
  check_birth("recumbent", false);
}

// Largest lean over the last of many periods, started off the cycle with its energy; 0 once the
// oscillation has died out below a tenth of the cycle's.
typedef struct swing {
  double from, largest; // s, rad
} swing;

static int watch(const bike_sample *s, const bike_sample_more *more, void *user) {
  (void)more;
  swing *w = user;
  if (s->time >= w->from) w->largest = fmax(w->largest, fabs(s->lean));
  return 0;
}

static double swing_after(const bike_model *model, const bike_cycle *c, double factor,
                          int periods) {
  bike_ride_result result;
  bike_ride_def def = bike_default_ride_def();
  swing w = {.from = (periods - 1) * c->period};
  def.start = (bike_state){.lean = factor * c->start.lean,
                           .steer = factor * c->start.steer,
                           .steer_rate = factor * c->start.steer_rate};
  assert_int_equal(bike_speed_of_equal_energy(&def.start.speed, model, &def.start, c->speed),
                   BIKE_OK);
  def.sample = c->period / 500;
  def.duration = periods * 500 * def.sample;
  def.on_sample = watch;
  def.user = &w;
  assert_int_equal(bike_ride(&result, model, &def), BIKE_OK);
  return result.complete ? w.largest : INFINITY;
}

// "The instability is stopped by non-linear effects at a finite amplitude."
static void a_stable_cycle_attracts(void **state) {
  (void)state;
  bike_model model = shipped("roadster");
  bike_cycle c = cycle_of(&model, 6 * DEGREE);
  assert_true(c.multiplier < 0.7);
  // 40 periods at 0.6 each leave nothing; 500 samples see the largest lean to 5e-6 of it
  assert_relative(swing_after(&model, &c, 0.3, 40), c.lean, 1e-4);
  assert_relative(swing_after(&model, &c, 1.2, 40), c.lean, 1e-4);
}

static void an_unstable_cycle_parts(void **state) {
  (void)state;
  bike_model model = shipped("recumbent");
  bike_cycle c = cycle_of(&model, 6 * DEGREE);
  assert_true(c.multiplier > 1);
  assert_true(swing_after(&model, &c, 0.9, 60) < 0.5 * c.lean);
  assert_true(swing_after(&model, &c, 1.1, 60) > 1.5 * c.lean);
}

// The multiplier is how a small distance from the cycle shrinks in a period.
static void the_multiplier_is_a_rate(void **state) {
  (void)state;
  bike_model model = shipped("roadster");
  bike_cycle c = cycle_of(&model, 3 * DEGREE);
  double one = swing_after(&model, &c, 1.05, 10) - c.lean;
  double two = swing_after(&model, &c, 1.05, 12) - c.lean;
  // the distance is not small enough for more, and the largest lean is seen to 5e-6 of it
  assert_near(sqrt(two / one), c.multiplier, 0.01);
}

// Eigenvector of the 4 x 4 matrix: A x = s x with x = (steer, lean, their rates).
static void modes_are_eigenvectors(void **state) {
  (void)state;
  bike_model model = shipped("benchmark");
  for (double v = 1; v < 9; v += 0.5) {
    bike_weave_mode m;
    bike_linear linear;
    bike_state straight = {.speed = v};
    assert_int_equal(bike_weave_mode_at(&m, &model, v), BIKE_OK);
    assert_int_equal(bike_linearize(&linear, &model, &straight, NULL), BIKE_OK);
    // x(t) = Re(x e^(st)) at two times that are a quarter turn apart gives both parts
    double phi[2] = {m.ratio * cos(m.lag), -m.ratio * sin(m.lag)}, kap[2] = {1, 0};
    double s[2] = {m.growth, m.frequency};
    double phi_[2] = {s[0] * phi[0] - s[1] * phi[1], s[0] * phi[1] + s[1] * phi[0]};
    double kap_[2] = {s[0], s[1]};
    for (int part = 0; part < 2; part++) {
      const double *A = &linear.A[8];
      double left = A[0] * phi[part] + A[1] * kap[part] + A[2] * phi_[part] + A[3] * kap_[part];
      double right = part ? s[0] * phi_[1] + s[1] * phi_[0] : s[0] * phi_[0] - s[1] * phi_[1];
      // entries of A are up to some hundred
      assert_near(left, right, 1e-11);
    }
  }
}

static void impossible_questions_are_refused(void **state) {
  (void)state;
  bike_model model = shipped("roadster");
  bike_cycle c;
  bike_hopf hopf;
  double speed;
  double weave = weave_speed(&model);
  assert_int_equal(bike_cycle_find(&c, &model, 0, weave, NULL), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_cycle_find(&c, &model, NAN, weave, NULL), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_cycle_find(&c, &model, 2, weave, NULL), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_cycle_find(NULL, &model, 0.1, weave, NULL), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_hopf_at(&hopf, &model, -1), BIKE_ERROR_ARGUMENT);
  assert_true(bike_cycle_find(&c, &model, 60 * DEGREE, weave, NULL) != BIKE_OK); // too far
  bike_cycle larger = cycle_of(&model, 2 * DEGREE);
  assert_int_equal(bike_cycle_of_speed(&c, &model, weave + 0.01, weave, NULL, &larger),
                   BIKE_ERROR_ARGUMENT); // the other side
  assert_int_equal(bike_cycle_of_speed(&c, &model, larger.speed - 0.01, weave, NULL, &larger),
                   BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_cycle_of_speed(&c, &model, weave, weave, &larger, &larger),
                   BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_cycle_of_speed(&c, &model, weave, weave, NULL, NULL), BIKE_ERROR_ARGUMENT);
  bike_state fast = {.lean = 0.1, .lean_rate = 50};
  assert_int_equal(bike_speed_of_equal_energy(&speed, &model, &fast, 1), BIKE_ERROR_NOT_STATIONARY);
}

// Beyond the end of this bicycle's branch Newton's method would ask for a ride of 1e8 s.
static void a_search_that_gets_lost_ends(void **state) {
  (void)state;
  bike_bicycle roadster = read_shipped("roadster"), bicycle;
  assert_int_equal(bike_vary(&bicycle, &roadster, BIKE_VARY_TRAIL, 1.12, BIKE_FRONT_IN_SPACE),
                   BIKE_OK);
  bike_model model;
  assert_int_equal(bike_model_init(&model, &bicycle), BIKE_OK);
  bike_cycle c;
  double weave = weave_speed(&model), step = 3 * M_PI / 180, lean = step;
  assert_int_equal(bike_cycle_find(&c, &model, lean, weave, NULL), BIKE_OK);
  int code = BIKE_OK;
  while (!code) code = bike_cycle_find(&c, &model, lean += step, weave, &c);
  assert_int_equal(code, BIKE_ERROR_NO_CONVERGENCE);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cycles_close),
      cmocka_unit_test(births),
      cmocka_unit_test(a_stable_cycle_attracts),
      cmocka_unit_test(an_unstable_cycle_parts),
      cmocka_unit_test(the_multiplier_is_a_rate),
      cmocka_unit_test(modes_are_eigenvectors),
      cmocka_unit_test(impossible_questions_are_refused),
      cmocka_unit_test(a_search_that_gets_lost_ends),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
