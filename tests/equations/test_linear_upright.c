// SPDX-License-Identifier: Apache-2.0
// The library's linearisation, derivatives of its nonlinear kernel, against the closed formulas of
// Meijaard et al. (2007), appendix A, and against differences of the nine equations.
#include "bicycles.h"
#include "meijaard_appendix.h"
#include "nine_equations.h"
#include "support/near.h"
#include <bicycle/error.h>

// Of the largest entry of each matrix.
static double matrix_gap(const double actual[4], const double expected[4]) {
  double size = 0, gap = 0;
  for (int i = 0; i < 4; i++) size = fmax(size, fabs(expected[i]));
  for (int i = 0; i < 4; i++) {
    double error = fabs(actual[i] - expected[i]) / size;
    if (!(error <= gap)) gap = error;
  }
  return gap;
}

static double appendix_gap(const bike_bicycle *bicycle) {
  bike_model model;
  bike_upright_matrices is, should;
  assert_int_equal(bike_model_init(&model, bicycle), 0);
  assert_int_equal(bike_linearize_upright(&is, &model), 0);
  should = meijaard_matrices(bicycle);
  double gap = fmax(matrix_gap(is.M, should.M), matrix_gap(is.C1, should.C1));
  gap = fmax(gap, fmax(matrix_gap(is.K0, should.K0), matrix_gap(is.K2, should.K2)));
  assert_below(matrix_gap(is.M, should.M), 1e-12);
  assert_below(matrix_gap(is.C1, should.C1), 1e-12);
  assert_below(matrix_gap(is.K0, should.K0), 1e-12);
  assert_below(matrix_gap(is.K2, should.K2), 1e-12);
  return gap;
}

static void shipped_bicycles_match_appendix_A(void **unused) {
  (void)unused;
  for (int b = 0; b < SHIPPED_COUNT; b++) {
    const bike_bicycle bicycle = read_shipped(shipped_bicycles[b].name);
    printf("%-19s %.1e\n", bicycle.name, appendix_gap(&bicycle));
  }
}

static void random_bicycles_match_appendix_A(void **unused) {
  (void)unused;
  random_source source = random_begin(__func__, 2007);
  double worst = 0;
  for (int i = 0; i < 1000; i++) {
    const bike_bicycle bicycle = random_bicycle(&source, true);
    worst = fmax(worst, appendix_gap(&bicycle));
  }
  printf("1000 random bicycles: worst %.1e\n", worst);
}

static void asymmetric_bicycle_is_refused(void **unused) {
  (void)unused;
  bike_bicycle bicycle = read_shipped("roadster");
  for (int i = 0; i < bicycle.part_count; i++)
    if (bicycle.parts[i].assembly == BIKE_REAR_FRAME) bicycle.parts[i].position[1] = 0.01;
  bike_model model;
  bike_upright_matrices untouched = {.M = {1, 2, 3, 4}};
  assert_int_equal(bike_model_init(&model, &bicycle), 0);
  assert_int_equal(bike_linearize_upright(&untouched, &model), BIKE_ERROR_NOT_STATIONARY);
  assert_true(untouched.M[3] == 4);
}

// The oracle's x' for x = (steer, lean, steer_rate, lean_rate) and u, the speed slaved to the
// energy by one differential: dE = 0, so dv = -sum (dE/dx_i) dx_i / (dE/dv).
typedef struct setting {
  const bike_bicycle *bicycle;
  bike_state state;
  bike_input input;
} setting;

static void nudge(setting *at, int column, double step) {
  double *const place[8] = {&at->state.steer,
                            &at->state.lean,
                            &at->state.steer_rate,
                            &at->state.lean_rate,
                            &at->input.steer_torque,
                            &at->input.roll_torque,
                            &at->input.rider_acceleration,
                            &at->state.speed};
  *place[column] += step;
}

typedef struct response {
  real steer, lean, energy;
} response;

static response respond(const setting *at) {
  nine_solution n;
  assert_true(nine_solve(&n, at->bicycle, &at->state, &at->input));
  return (response){n.acceleration.phi, n.acceleration.kappa,
                    paper_kinetic(&n.motion) + paper_potential(&n.motion, at->bicycle->gravity)};
}

// Derivatives by a central difference of order 4 with the step 2^-13: truncation is near 1e-16
// times the fifth derivative, round-off of the long doubles near 1e-14.
static response slope(const setting *at, int column) {
  const double h = 0x1p-13;
  const double weight[2] = {8.0 / 12, -1.0 / 12};
  response d = {0, 0, 0};
  for (int k = 1; k <= 2; k++) {
    setting up = *at, down = *at;
    nudge(&up, column, k * h);
    nudge(&down, column, -k * h);
    response a = respond(&up), b = respond(&down);
    d.steer += (real)weight[k - 1] * (a.steer - b.steer) / h;
    d.lean += (real)weight[k - 1] * (a.lean - b.lean) / h;
    d.energy += (real)weight[k - 1] * (a.energy - b.energy) / h;
  }
  return d;
}

static double linear_gap(const bike_linear *is, const setting *at, int columns) {
  enum { SPEED = 7 };
  const response by_speed = slope(at, SPEED);
  double worst = 0;
  for (int column = 0; column < columns; column++) {
    response d = slope(at, column);
    if (column < 4) {
      real dv = -d.energy / by_speed.energy;
      d.steer += by_speed.steer * dv;
      d.lean += by_speed.lean * dv;
    }
    const double expected[4] = {column == 2, column == 3, (double)d.steer, (double)d.lean};
    for (int i = 0; i < 4; i++) {
      double actual = column < 4 ? is->A[4 * i + column] : is->B[3 * i + column - 4];
      double error = fabs(actual - expected[i]) / fmax(1, fabs(expected[i]));
      if (!(error <= worst)) worst = error;
    }
  }
  return worst;
}

static void jacobian_matches_nine_equations(void **unused) {
  (void)unused;
  random_source source = random_begin(__func__, 25);
  const random_range range = {0.5, 0.4, 0.5, 3, 8};
  for (int b = 0; b < SHIPPED_COUNT; b++) {
    const bike_bicycle bicycle = read_shipped(shipped_bicycles[b].name);
    bike_model model;
    assert_int_equal(bike_model_init(&model, &bicycle), 0);
    const int columns = model.rider_mass > 0 ? 7 : 6; // the last is the rider's acceleration
    double worst = 0;
    for (int i = 0; i < 20; i++) {
      setting at = {&bicycle, random_state(&source, &range), {.steer_torque = 1}};
      bike_linear is;
      assert_int_equal(bike_linearize(&is, &model, &at.state, &at.input), 0);
      double gap = linear_gap(&is, &at, columns);
      if (!(gap <= worst)) worst = gap;
    }
    printf("%-19s A, B against differences: worst %.1e\n", bicycle.name, worst);
    assert_below(worst, 1e-9); // of the differences, at the wildest state; 6e-11 was seen
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shipped_bicycles_match_appendix_A),
      cmocka_unit_test(random_bicycles_match_appendix_A),
      cmocka_unit_test(asymmetric_bicycle_is_refused),
      cmocka_unit_test(jacobian_matches_nine_equations),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
