// SPDX-License-Identifier: Apache-2.0
// Symmetries of the equations, and what a mass matrix must be; the library alone.
#include "bicycles.h"
#include "support/near.h"

enum { STATES = 1000 };
// Of max(1, largest acceleration): the same sums with some signs turned, so round-off only.
static const double tolerance = 1e-12;

static double size_of(const bike_acceleration *a) {
  return fmax(1, fmax(fabs(a->lean), fmax(fabs(a->steer), fabs(a->speed))));
}

// Largest difference, of max(1, largest acceleration).
static double difference(const bike_acceleration *a, const bike_acceleration *b) {
  bike_acceleration d = {a->lean - b->lean, a->steer - b->steer, a->speed - b->speed};
  return fmax(fabs(d.lean), fmax(fabs(d.steer), fabs(d.speed))) / size_of(b);
}

// The bicycles of the symmetry tests: the shipped ones, then random asymmetric ones.
enum { RANDOM_COUNT = 6, ALL_COUNT = SHIPPED_COUNT + RANDOM_COUNT };

static bike_bicycle pick(int index, random_source *source, random_range *range) {
  if (index < SHIPPED_COUNT) {
    *range = shipped_bicycles[index].range;
    return read_shipped(shipped_bicycles[index].name);
  }
  *range = (random_range){0.5, 0.5, 2, 1, 10};
  return random_bicycle(source, false);
}

static bool rider_in(const bike_model *model) {
  return model->rider_mass > 0;
}

static bike_input random_input(random_source *source, const bike_model *model) {
  bike_input input = {.steer_torque = random_between(source, -5, 5),
                      .roll_torque = random_between(source, -50, 50)};
  if (rider_in(model)) {
    input.rider_offset = random_between(source, -0.1, 0.1);
    input.rider_velocity = random_between(source, -1, 1);
    input.rider_acceleration = random_between(source, -5, 5);
  }
  return input;
}

// A bicycle seen in a mirror accelerates as the mirror shows it.
static void mirror_symmetry(void **unused) {
  (void)unused;
  random_source source = random_begin(__func__, 7);
  double worst = 0;
  for (int b = 0; b < ALL_COUNT; b++) {
    random_range range;
    const bike_bicycle bicycle = pick(b, &source, &range), twin = mirrored(&bicycle);
    bike_model model, image;
    assert_int_equal(bike_model_init(&model, &bicycle), 0);
    assert_int_equal(bike_model_init(&image, &twin), 0);
    for (int i = 0; i < STATES; i++) {
      bike_state s = random_state(&source, &range);
      bike_input in = random_input(&source, &model);
      bike_state t = {-s.lean, -s.steer, -s.lean_rate, -s.steer_rate, s.speed};
      bike_input im = {-in.steer_torque, -in.roll_torque, -in.rider_offset, -in.rider_velocity,
                       -in.rider_acceleration};
      bike_acceleration a, m;
      int error = bike_accelerate(&a, &model, &s, &in);
      assert_int_equal(bike_accelerate(&m, &image, &t, &im), error);
      if (error != 0) continue;
      bike_acceleration shown = {-a.lean, -a.steer, a.speed};
      assert_below(difference(&m, &shown), tolerance);
      worst = fmax(worst, difference(&m, &shown));
    }
  }
  printf("mirror symmetry: worst %.1e\n", worst);
}

// Without a damper, a ride filmed backwards is a ride.
static void time_reversal(void **unused) {
  (void)unused;
  random_source source = random_begin(__func__, 8);
  double worst = 0;
  for (int b = 0; b < ALL_COUNT; b++) {
    random_range range;
    bike_bicycle bicycle = pick(b, &source, &range);
    bike_model model;
    bicycle.steer_damping = 0;
    assert_int_equal(bike_model_init(&model, &bicycle), 0);
    for (int i = 0; i < STATES; i++) {
      bike_state s = random_state(&source, &range);
      bike_input in = random_input(&source, &model);
      bike_state t = {s.lean, s.steer, -s.lean_rate, -s.steer_rate, -s.speed};
      bike_input back = in;
      back.rider_velocity = -in.rider_velocity;
      bike_acceleration a, r;
      int error = bike_accelerate(&a, &model, &s, &in);
      assert_int_equal(bike_accelerate(&r, &model, &t, &back), error);
      if (error != 0) continue;
      assert_below(difference(&r, &a), tolerance);
      worst = fmax(worst, difference(&r, &a));
    }
  }
  printf("time reversal: worst %.1e\n", worst);
}

// The damper, which time reversal leaves out, is a steer torque -d phi' and nothing else.
static void damper_is_a_torque(void **unused) {
  (void)unused;
  random_source source = random_begin(__func__, 9);
  bike_bicycle damped = read_shipped("recumbent"), free = damped;
  damped.steer_damping = 1.5;
  free.steer_damping = 0;
  bike_model with, without;
  assert_int_equal(bike_model_init(&with, &damped), 0);
  assert_int_equal(bike_model_init(&without, &free), 0);
  for (int i = 0; i < STATES; i++) {
    bike_state s = random_state(&source, &shipped_bicycles[0].range);
    bike_input none = {0}, torque = {.steer_torque = -1.5 * s.steer_rate};
    bike_acceleration a, b;
    assert_int_equal(bike_accelerate(&a, &with, &s, &none), 0);
    assert_int_equal(bike_accelerate(&b, &without, &s, &torque), 0);
    assert_below(difference(&a, &b), tolerance);
  }
}

static double quadratic_form(const double M[9], const double r[3]) {
  double sum = 0;
  for (int i = 0; i < 9; i++) sum += r[i / 3] * M[i] * r[i % 3];
  return sum;
}

static void check_positive_definite(const double M[9]) {
  // Leading minors, of the matrix scaled to a unit diagonal so that round-off has one size.
  for (int i = 0; i < 3; i++) assert_true(M[4 * i] > 0);
  double c01 = M[1] / sqrt(M[0] * M[4]), c02 = M[2] / sqrt(M[0] * M[8]),
         c12 = M[5] / sqrt(M[4] * M[8]);
  assert_true(1 - c01 * c01 > 0);
  assert_true(1 + 2 * c01 * c02 * c12 - c01 * c01 - c02 * c02 - c12 * c12 > 0);
}

static void mass_matrix(void **unused) {
  (void)unused;
  random_source source = random_begin(__func__, 10);
  double worst = 0;
  for (int b = 0; b < ALL_COUNT; b++) {
    random_range range;
    const bike_bicycle bicycle = pick(b, &source, &range);
    bike_model model;
    assert_int_equal(bike_model_init(&model, &bicycle), 0);
    for (int i = 0; i < STATES; i++) {
      bike_state s = random_state(&source, &range);
      bike_input in = {.rider_offset = rider_in(&model) ? random_between(&source, -0.1, 0.1) : 0};
      bike_snapshot is;
      double M[9];
      int error = bike_evaluate(&is, &model, &s, &in);
      assert_int_equal(bike_mass_matrix(M, &model, &s, in.rider_offset), error);
      if (error != 0) continue;
      assert_true(M[1] == M[3] && M[2] == M[6] && M[5] == M[7]);
      check_positive_definite(M);
      const double r[3] = {s.lean_rate, s.steer_rate, s.speed};
      assert_relative(quadratic_form(M, r) / 2, is.kinetic, 1e-13);
      worst = fmax(worst, fabs(quadratic_form(M, r) / 2 / is.kinetic - 1));
    }
  }
  printf("r.M r / 2 against the kinetic energy: worst %.1e\n", worst);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(mirror_symmetry),
      cmocka_unit_test(time_reversal),
      cmocka_unit_test(damper_is_a_torque),
      cmocka_unit_test(mass_matrix),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
