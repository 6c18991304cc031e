// SPDX-License-Identifier: Apache-2.0
// Derivatives by tangents in lanes against complex steps, for every pass that this machine can run.
#include "equations/bicycles.h"
#include "slopes.h"
#include "support/near.h"
#include "support/random.h"
#include <bicycle/error.h>
#include <bicycle/linear.h>
#include <string.h>

// Relative to the largest value and slope of the point, times what the elimination amplifies
// rounding by: both ways round some hundred times in a row. The worst of all is printed.
static const double TOLERANCE = 1e-13;

typedef struct group {
  bike_model model;
  jacobian_points points;
  double beta_r[JACOBIAN_POINTS];
} group;

static bike_state state_of(const jacobian_points *p, int i) {
  return (bike_state){.steer = p->at[AT_STEER][i],
                      .lean = p->at[AT_LEAN][i],
                      .steer_rate = p->at[AT_STEER_RATE][i],
                      .lean_rate = p->at[AT_LEAN_RATE][i],
                      .speed = p->at[AT_SPEED][i]};
}

static bike_input input_of(const jacobian_points *p, int i) {
  return (bike_input){.steer_torque = p->at[AT_STEER_TORQUE][i],
                      .roll_torque = p->at[AT_ROLL_TORQUE][i],
                      .rider_offset = p->at[AT_RIDER_OFFSET][i],
                      .rider_velocity = p->at[AT_RIDER_VELOCITY][i],
                      .rider_acceleration = p->at[AT_RIDER_ACCELERATION][i]};
}

static void random_point(jacobian_points *p, int i, random_source *source,
                         const random_range *range, bool rider) {
  bike_state s = random_state(source, range);
  double w = rider ? 0.1 : 0;
  const double at[JACOBIAN_ARGUMENTS] = {
      [AT_STEER] = s.steer,
      [AT_LEAN] = s.lean,
      [AT_STEER_RATE] = s.steer_rate,
      [AT_LEAN_RATE] = s.lean_rate,
      [AT_SPEED] = s.speed,
      [AT_STEER_TORQUE] = random_between(source, -5, 5),
      [AT_ROLL_TORQUE] = random_between(source, -5, 5),
      [AT_RIDER_ACCELERATION] = random_between(source, -w, w),
      [AT_RIDER_OFFSET] = random_between(source, -w, w),
      [AT_RIDER_VELOCITY] = random_between(source, -w, w),
  };
  for (int k = 0; k < JACOBIAN_ARGUMENTS; k++) p->at[k][i] = at[k];
}

// Eight states of one bicycle: every other group an asymmetric one that was never built.
static void random_group(group *g, random_source *source, int number) {
  const shipped_bicycle *shipped = &shipped_bicycles[number / 2 % SHIPPED_COUNT];
  bike_bicycle bicycle = number % 2 ? random_bicycle(source, false) : read_shipped(shipped->name);
  assert_int_equal(bike_model_init(&g->model, &bicycle), BIKE_OK);
  const random_range moderate = {0.5, 0.6, 2, 1, 8}; // where random bicycles have a geometry
  const random_range *range = number % 2 ? &moderate : &shipped->range;
  for (int i = 0; i < JACOBIAN_POINTS; i++) {
    bike_snapshot is;
    int code;
    do {
      random_point(&g->points, i, source, range, g->model.rider_mass > 0);
      bike_state s = state_of(&g->points, i);
      bike_input in = input_of(&g->points, i);
      code = bike_evaluate(&is, &g->model, &s, &in);
    } while (code);
    g->beta_r[i] = is.beta_r;
  }
}

// By complex step, in every direction.
typedef struct expected {
  slope_result by[JACOBIAN_ARGUMENTS];
} expected;

static void expect(expected *out, const group *g, int i) {
  double at[JACOBIAN_ARGUMENTS];
  for (int k = 0; k < JACOBIAN_ARGUMENTS; k++) at[k] = g->points.at[k][i];
  for (int k = 0; k < JACOBIAN_ARGUMENTS; k++)
    slope_by_step(&out->by[k], &g->model, at, g->beta_r[i], k);
}

// The largest of some results and their slopes, but at least 1.
static double scale_of(const expected *e, int first, int count) {
  double scale = 1;
  for (int k = 0; k < JACOBIAN_ARGUMENTS; k++)
    for (int a = first; a < first + count; a++)
      scale = fmax(scale, fmax(fabs(e->by[k].value[a]), fabs(e->by[k].slope[a])));
  return scale;
}

static double worst; // of all comparisons, in units of the scale

static void compare(double got, double want, double scale) {
  double error = fabs(got - want) / scale;
  worst = fmax(worst, error);
  assert_below(error, TOLERANCE);
}

// A diagonal entry of M and what is left of it as a pivot.
static double amplification(const jacobian_checks *c, int i) {
  return fmax(c->diagonal_phi[i] / c->pivot_phi[i], c->diagonal_kap[i] / c->pivot_kap[i]);
}

static void check_jacobian(const jacobian *got, const expected *want, int i) {
  double scale = scale_of(want, 0, JACOBIAN_ACCELERATIONS) * amplification(&got->checks, i);
  for (int a = 0; a < JACOBIAN_ACCELERATIONS; a++) {
    compare(got->acceleration[a][i], want->by[0].value[a], scale);
    for (int k = 0; k < JACOBIAN_DIRECTIONS; k++)
      compare(got->slope[a][k][i], want->by[k].slope[a], scale);
  }
  double energy_scale = scale_of(want, OF_ENERGY, 1);
  compare(got->energy[i], want->by[0].value[OF_ENERGY], energy_scale);
  for (int k = 0; k < JACOBIAN_VARIABLES; k++)
    compare(got->energy_slope[k][i], want->by[k].slope[OF_ENERGY], energy_scale);
}

static void check_pass(jacobian_pass *pass, const char *name) {
  random_source source = random_begin(name, 20111);
  worst = 0;
  for (int number = 0; number < 600; number++) {
    group g;
    random_group(&g, &source, number);
    jacobian got;
    memset(&got, 0xff, sizeof got); // NaN: what the pass leaves out shows
    pass(&got, &g.model, &g.points);
    for (int i = 0; i < JACOBIAN_POINTS; i++) {
      expected want;
      expect(&want, &g, i);
      check_jacobian(&got, &want, i);
    }
  }
  print_message("%s: worst %.2g of the scale, allowed %.2g\n", name, worst, TOLERANCE);
}

static void plain_pass(void **unused) {
  (void)unused;
  check_pass(jacobian_pass_baseline, "plain pass");
}

static void wide_passes(void **unused) {
  (void)unused;
#ifdef JACOBIAN_X86
  bool v3 = __builtin_cpu_supports("x86-64-v3"), v4 = __builtin_cpu_supports("x86-64-v4");
  if (v3) check_pass(jacobian_pass_v3, "AVX2 pass");
  if (v4) check_pass(jacobian_pass_v4, "AVX-512 pass");
  if (v3) return;
#endif
  skip();
}

static void check_results(const slope_result *got, const slope_result *want, int first, int count,
                          double scale) {
  for (int a = first; a < first + count; a++) {
    compare(got->value[a], want->value[a], scale);
    compare(got->slope[a], want->slope[a], scale);
  }
}

// The directions and the results that the passes leave out, too.
static void one_slope(void **unused) {
  (void)unused;
  random_source source = random_begin("one slope", 20112);
  worst = 0;
  for (int number = 0; number < 200; number++) {
    group g;
    random_group(&g, &source, number);
    jacobian j; // for the amplification
    jacobian_pass_baseline(&j, &g.model, &g.points);
    expected want[TANGENT_POINTS];
    for (int i = 0; i < TANGENT_POINTS; i++) expect(&want[i], &g, i);
    for (int k = 0; k < JACOBIAN_ARGUMENTS; k++) {
      slope_result got[TANGENT_POINTS];
      slopes_by_tangent(got, &g.model, &g.points, k);
      for (int i = 0; i < TANGENT_POINTS; i++) {
        const slope_result *by = &want[i].by[k];
        double gain = amplification(&j.checks, i);
        check_results(&got[i], by, 0, 3, gain * scale_of(&want[i], 0, 3));
        check_results(&got[i], by, OF_ENERGY, 1, scale_of(&want[i], OF_ENERGY, 1));
        check_results(&got[i], by, OF_REAR_FORCE, 3, gain * scale_of(&want[i], OF_REAR_FORCE, 3));
      }
    }
  }
  print_message("one slope: worst %.2g of the scale, allowed %.2g\n", worst, TOLERANCE);
}

// Where Newton's steps have just converged, the slopes have too. A penny-farthing comes closest to
// where they do not; slopes carried through the steps would be off by 2e-13 there.
static void rear_angle_slopes(void **unused) {
  (void)unused;
  random_source source = random_begin("rear angle", 20115);
  const random_range wide = {0.9, 1.2, 2, 1, 10};
  bike_bicycle bicycle = read_shipped("penny_farthing");
  group g;
  assert_int_equal(bike_model_init(&g.model, &bicycle), BIKE_OK);
  double off = 0;
  int converged = 0;
  for (int number = 0; number < 20000; number++) {
    for (int i = 0; i < JACOBIAN_POINTS; i++)
      random_point(&g.points, i, &source, &wide, g.model.rider_mass > 0);
    jacobian j;
    jacobian_codes codes;
    jacobian_at(&j, codes, &g.model, &g.points);
    slope_result got[2][TANGENT_POINTS];
    slopes_by_tangent(got[0], &g.model, &g.points, AT_STEER);
    slopes_by_tangent(got[1], &g.model, &g.points, AT_LEAN);
    for (int i = 0; i < TANGENT_POINTS; i++) {
      if (codes[i]) continue;
      converged++;
      double at[JACOBIAN_ARGUMENTS];
      for (int k = 0; k < JACOBIAN_ARGUMENTS; k++) at[k] = g.points.at[k][i];
      double beta_r = asin(got[0][i].value[OF_REAR_ANGLE]);
      for (int k = 0; k < 2; k++) {
        slope_result want;
        slope_by_step(&want, &g.model, at, beta_r, k ? AT_LEAN : AT_STEER);
        double slope = want.slope[OF_REAR_ANGLE];
        off = fmax(off, fabs(got[k][i].slope[OF_REAR_ANGLE] - slope) / fmax(1, fabs(slope)));
      }
    }
  }
  print_message("rear angle: %d converged, slopes off by %.2g at most\n", converged, off);
  assert_true(converged > 10000);
  assert_below(off, 4e-15); // three times the worst found
}

// A bad point gets its code and spoils no other.
static void points_are_judged(void **unused) {
  (void)unused;
  random_source source = random_begin("codes", 20113);
  group g;
  random_group(&g, &source, 0);
  jacobian clean, got;
  jacobian_codes codes;
  jacobian_at(&clean, codes, &g.model, &g.points);
  for (int i = 0; i < JACOBIAN_POINTS; i++) assert_int_equal(codes[i], BIKE_OK);
  g.points.at[AT_LEAN_RATE][1] = NAN;
  g.points.at[AT_STEER_TORQUE][2] = -INFINITY;
  g.points.at[AT_SPEED][3] = 1e200;     // its square overflows
  g.points.at[AT_LEAN][5] = 0.5 * M_PI; // flat on the ground
  g.points.at[AT_STEER][6] = INFINITY;
  jacobian_at(&got, codes, &g.model, &g.points);
  const int want[JACOBIAN_POINTS] = {
      BIKE_OK, BIKE_ERROR_NOT_FINITE, BIKE_ERROR_NOT_FINITE, BIKE_ERROR_NOT_FINITE,
      BIKE_OK, BIKE_ERROR_GEOMETRY,   BIKE_ERROR_NOT_FINITE, BIKE_OK};
  for (int i = 0; i < JACOBIAN_POINTS; i++) assert_int_equal(codes[i], want[i]);
  for (int i = 0; i < JACOBIAN_POINTS; i += JACOBIAN_POINTS - 1)
    for (int k = 0; k < JACOBIAN_DIRECTIONS; k++)
      assert_true(got.slope[OF_LEAN][k][i] == clean.slope[OF_LEAN][k][i]);
}

// What passes has the accelerations of bike_evaluate, which judges each state on its own; where the
// root of (4) is too far from the guess for the pass, it may fail alone.
static void passed_is_right(void **unused) {
  (void)unused;
  random_source source = random_begin("judged alike", 20114);
  const random_range wild = {1.7, 3.2, 2, -10, 10};
  int passed = 0, refused = 0, left = 0;
  for (int number = 0; number < 600; number++) {
    group g;
    random_group(&g, &source, number);
    for (int i = 0; i < JACOBIAN_POINTS; i++)
      random_point(&g.points, i, &source, &wild, g.model.rider_mass > 0);
    jacobian got;
    jacobian_codes codes;
    jacobian_at(&got, codes, &g.model, &g.points);
    for (int i = 0; i < JACOBIAN_POINTS; i++) {
      bike_state s = state_of(&g.points, i);
      bike_input in = input_of(&g.points, i);
      bike_snapshot is;
      int code = bike_evaluate(&is, &g.model, &s, &in);
      if (codes[i]) {
        *(code ? &refused : &left) += 1;
        continue;
      }
      passed++;
      assert_int_equal(code, BIKE_OK);
      if (fabs(is.acceleration.steer) > 1e4) continue; // nearly singular: little but rounding
      double scale = 1;
      for (int a = 0; a < JACOBIAN_ACCELERATIONS; a++)
        for (int k = 0; k < JACOBIAN_DIRECTIONS; k++) scale = fmax(scale, fabs(got.slope[a][k][i]));
      assert_near(got.acceleration[OF_STEER][i], is.acceleration.steer, 1e-12 * scale);
      assert_near(got.acceleration[OF_LEAN][i], is.acceleration.lean, 1e-12 * scale);
      assert_near(got.acceleration[OF_SPEED][i], is.acceleration.speed, 1e-12 * scale);
    }
  }
  print_message("%d passed, %d refused by both, %d by the pass alone\n", passed, refused, left);
  assert_true(passed > 1000 && refused > 100);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plain_pass),        cmocka_unit_test(wide_passes),
      cmocka_unit_test(one_slope),         cmocka_unit_test(rear_angle_slopes),
      cmocka_unit_test(points_are_judged), cmocka_unit_test(passed_is_right)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
