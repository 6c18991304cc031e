// SPDX-License-Identifier: Apache-2.0
// Section 5, the literature that section 1 quotes, and the equations themselves.
#include "equations/meijaard_appendix.h"
#include "equations/nine_equations.h"
#include "shared.h"
#include <bicycle/linear.h>
#include <math.h>
#include <string.h>

// Where, between two values of a variation, a stable range begins or ends to exist, by bisection;
// NaN where both have one or neither has.
static double border(const bike_bicycle *b, bike_variation variation, double one, double other) {
  bike_bicycle v = varied(b, variation, one, BIKE_FRONT_IN_SPACE);
  bike_bicycle u = varied(b, variation, other, BIKE_FRONT_IN_SPACE);
  bool has = limits_of(&v, 40).ranges > 0;
  if (has == (limits_of(&u, 40).ranges > 0)) return NAN;
  while (fabs(other - one) > 1e-9) {
    double middle = 0.5 * (one + other);
    v = varied(b, variation, middle, BIKE_FRONT_IN_SPACE);
    if ((limits_of(&v, 40).ranges > 0) == has)
      one = middle;
    else
      other = middle;
  }
  return one;
}

// The ranges of the shipped bicycles when their riders are taken off; below which steering inertia
// the roadster has one, and its range with 0.03 kg m^2.
static void riderless(figures *out) {
  static const char *const names[] = {"roadster", "penny_farthing", "recumbent"};
  for (int i = 0; i < 3; i++) {
    bike_bicycle with = bicycle_of(names[i]), b = without_rider(&with);
    limits l = limits_of(&b, 40);
    put(out, l.low);
    put(out, l.high);
  }
  bike_bicycle roadster = bicycle_of("roadster"), b = without_rider(&roadster);
  put(out, present(&b, BIKE_VARY_STEERING_INERTIA));
  put(out, border(&b, BIKE_VARY_STEERING_INERTIA, 0.10, 0));
  b = varied(&b, BIKE_VARY_STEERING_INERTIA, 0.03, BIKE_FRONT_IN_SPACE);
  limits l = limits_of(&b, 40);
  put(out, l.low);
  put(out, l.high);
}

static void former_works(figures *out) {
  static const char *const names[] = {"roadster", "benchmark"};
  for (int i = 0; i < 2; i++) {
    bike_bicycle b = bicycle_of(names[i]);
    limits l = limits_of(&b, 40);
    put(out, l.low);
    put(out, l.high);
  }
}

// Of the largest entry of a matrix.
static double gap_of(const double *is, const double *should) {
  double size = 0, gap = 0;
  for (int i = 0; i < 4; i++) size = fmax(size, fabs(should[i]));
  for (int i = 0; i < 4; i++) {
    double error = fabs(is[i] - should[i]) / size;
    if (!(error <= gap)) gap = error;
  }
  return gap;
}

static double linear_gap(const bike_bicycle *b) {
  bike_model model = model_of(b);
  bike_upright_matrices is, should = meijaard_matrices(b);
  must(bike_linearize_upright(&is, &model), "linearisation");
  double gap = fmax(gap_of(is.M, should.M), gap_of(is.C1, should.C1));
  return fmax(gap, fmax(gap_of(is.K0, should.K0), gap_of(is.K2, should.K2)));
}

static void linearises(figures *out) {
  static const char *const names[] = {"roadster",       "roadster_riderless", "benchmark",
                                      "penny_farthing", "recumbent",          "recumbent_damped"};
  for (int i = 0; i < 6; i++) {
    bike_bicycle b = bicycle_of(names[i]);
    put(out, linear_gap(&b));
  }
}

// Residual of the corrected (23), as a share of its terms, when the lean acceleration is wrong by
// 1 rad/s^2.
static double wrong_lean_residual(const bike_bicycle *b, const bike_state *state, double wrong,
                                  int weight_sign) {
  nine_solution n;
  paper_roots roots;
  const bike_input none = {0};
  must(nine_solve(&n, b, state, &none) ? 0 : -1, "nine equations");
  must(paper_roots_of(&roots, &b->geometry, state) ? 0 : -1, "roots");
  paper_acceleration a = n.acceleration;
  a.kappa += wrong;
  paper_motion m = paper_motion_of(b, &roots, state, &none, a);
  return (double)equation_23(b, state, &none, &m, weight_sign);
}

// Whether (23) can be solved for the accelerations: at a lean and steer it sees a wrong one,
// upright it does not.
static void solvable(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  const bike_state generic = {0.2, -0.1, 0.3, -0.2, 5}, upright = {.speed = 5};
  put(out, wrong_lean_residual(&b, &generic, 1, -1));
  put(out, wrong_lean_residual(&b, &upright, 1, -1));
}

// The corrected (23) at the true accelerations, and as printed.
static void corrections(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  const bike_state generic = {0.2, -0.1, 0.3, -0.2, 5};
  put(out, wrong_lean_residual(&b, &generic, 0, -1));
  put(out, wrong_lean_residual(&b, &generic, 0, +1));
}

enum { STATES = 6 }; // steer, lean, their rates, the rider's offset and its rate

// Accelerations of steer and lean by a unit of the rider's offset (0) or its rate (1): upright they
// are odd in it, so that this central difference errs by the square of its step.
static void by_rider(double out[2], const bike_model *model, double speed, int rate) {
  const double h = 1e-5;
  bike_acceleration up, down;
  const bike_state state = {.speed = speed};
  bike_input right = {.rider_offset = rate ? 0 : h, .rider_velocity = rate ? h : 0};
  bike_input left = {.rider_offset = -right.rider_offset, .rider_velocity = -right.rider_velocity};
  must(bike_accelerate(&up, model, &state, &right), "rider");
  must(bike_accelerate(&down, model, &state, &left), "rider");
  out[0] = (up.steer - down.steer) / (2 * h);
  out[1] = (up.lean - down.lean) / (2 * h);
}

// Dimension that a rider who moves sideways commands (Kalman), out of 6.
static int commanded(const bike_model *model, double speed) {
  bike_linear linear;
  const bike_state state = {.speed = speed};
  const bike_input none = {0};
  must(bike_linearize(&linear, model, &state, &none), "linearisation");
  double A[STATES][STATES] = {{0}}, column[STATES] = {0}, krylov[STATES][STATES];
  for (int i = 0; i < 4; i++) {
    for (int j = 0; j < 4; j++) A[i][j] = linear.A[4 * i + j];
    column[i] = linear.B[3 * i + 2];
  }
  for (int rate = 0; rate < 2; rate++) {
    double by[2];
    by_rider(by, model, speed, rate);
    A[2][4 + rate] = by[0];
    A[3][4 + rate] = by[1];
  }
  A[4][5] = column[5] = 1;
  for (int k = 0; k < STATES; k++) {
    double length = 0, next[STATES] = {0};
    for (int i = 0; i < STATES; i++) length = hypot(length, column[i]);
    for (int i = 0; i < STATES; i++) krylov[k][i] = column[i] / length;
    for (int i = 0; i < STATES; i++)
      for (int j = 0; j < STATES; j++) next[i] += A[i][j] * krylov[k][j];
    memcpy(column, next, sizeof column);
  }
  return rank_of(krylov[0], STATES, STATES, 1e-6); // the differences leave some 1e-10
}

// The front wheel's angular momentum compensated: how unstable, and whether a rider can command it.
static void skilled_rider(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  bike_bicycle v = varied(&b, BIKE_VARY_FRONT_WHEEL_INERTIA, 0, BIKE_FRONT_IN_SPACE);
  bike_model model = model_of(&v);
  bike_eigenvalues e;
  must(bike_upright_eigenvalues(&e, &model, 6), "eigenvalues");
  put(out, e.re[0]);
  put(out, commanded(&model, 6));
}

static void controllable(figures *out) {
  bike_model model = shipped_model("roadster");
  for (int speed = 3; speed <= 9; speed += 3) put(out, commanded(&model, speed));
}

// Other parameters that end the stable region of the roadster: the steering inertia above which and
// the trail below which there is none.
static void only_limits(figures *out) {
  bike_bicycle b = bicycle_of("roadster");
  put(out, border(&b, BIKE_VARY_STEERING_INERTIA, 0.10, 1));
  put(out, border(&b, BIKE_VARY_TRAIL, 0.07, -0.05));
}

const claim claims_conclusion[] = {
    {"former-works", former_works},   {"only-limits", only_limits},   {"riderless", riderless},
    {"skilled-rider", skilled_rider}, {"controllable", controllable}, {"solvable", solvable},
    {"linearises", linearises},       {"corrections", corrections},   {0}};
