// SPDX-License-Identifier: Apache-2.0
// Modes: eigenvectors, names of the literature, names that do not depend on the path's steps.
#include "equations/bicycles.h"
#include "reference/reference.h"
#include "support/near.h"
#include <bicycle/error.h>
#include <bicycle/modes.h>

enum { SPEEDS = 41 };

static bike_model model_of(const char *name) {
  bike_bicycle bicycle = read_shipped(name);
  bike_model model;
  assert_int_equal(bike_model_init(&model, &bicycle), BIKE_OK);
  return model;
}

static int count_of(const bike_modes *m, bike_mode mode) {
  int count = 0;
  for (int i = 0; i < 4; i++) count += m->mode[i] == mode;
  return count;
}

static double named(const bike_modes *m, bike_mode mode) {
  for (int i = 0; i < 4; i++)
    if (m->mode[i] == mode) return m->values.re[i];
  return NAN;
}

// The published lists of the benchmark tell capsize and castering apart at 0, 1, .. 10 m/s, four
// real eigenvalues at 0 included.
static void names_of_the_literature(void **state) {
  (void)state;
  json_t *document = reference_open();
  bike_model model = model_of("benchmark");
  double speeds[11];
  bike_modes modes[11];
  for (int v = 0; v <= 10; v++) speeds[v] = v;
  assert_int_equal(bike_upright_modes(modes, &model, speeds, 11), BIKE_OK);
  for (int v = 0; v <= 10; v++) {
    char path[64];
    snprintf(path, sizeof path, "meijaard2007.capsize_eig.%d", v);
    assert_near(named(&modes[v], BIKE_MODE_CAPSIZE), reference_number(document, path), 2e-12);
    snprintf(path, sizeof path, "meijaard2007.castering_eig.%d", v);
    assert_near(named(&modes[v], BIKE_MODE_CASTERING), reference_number(document, path), 2e-12);
    assert_int_equal(count_of(&modes[v], BIKE_MODE_WEAVE), 2);
  }
  json_decref(document);
}

// A x = lambda x, of unit length.
static double defect(const bike_modes *m, int k, const double A[16]) {
  double worst = 0, square = 0;
  for (int i = 0; i < 4; i++) {
    const double *re = m->vectors_re[k], *im = m->vectors_im[k];
    double a = 0, b = 0, s = m->values.re[k], t = m->values.im[k];
    for (int j = 0; j < 4; j++) {
      a += A[4 * i + j] * re[j];
      b += A[4 * i + j] * im[j];
    }
    worst = fmax(worst, fabs(a - s * re[i] + t * im[i]) + fabs(b - s * im[i] - t * re[i]));
    square += re[i] * re[i] + im[i] * im[i];
  }
  return fmax(worst, fabs(square - 1));
}

static void vectors_are_eigenvectors(void **state) {
  (void)state;
  double worst = 0;
  for (int b = 0; b < SHIPPED_COUNT; b++) {
    bike_model model = model_of(shipped_bicycles[b].name);
    for (int i = 0; i <= 40; i++) {
      bike_state straight = {.speed = 0.25 * i};
      bike_linear linear;
      bike_modes modes;
      assert_int_equal(bike_linearize(&linear, &model, &straight, NULL), BIKE_OK);
      assert_int_equal(bike_modes_of(&modes, linear.A), BIKE_OK);
      bike_eigenvalues plain;
      assert_int_equal(bike_eigenvalues_of(&plain, linear.A), BIKE_OK);
      for (int k = 0; k < 4; k++) {
        // entries of A reach 1e3, and so does their rounding in A x
        worst = fmax(worst, defect(&modes, k, linear.A));
        // beside a double eigenvalue rounding of 1e-13 shows as its root
        assert_near(modes.values.re[k], plain.re[k], 1e-5);
      }
    }
  }
  printf("|A x - lambda x| <= %.2g\n", worst);
  assert_below(worst, 1e-11);
}

static void steps_do_not_change_names(void **state) {
  (void)state;
  static double fine_speeds[8 * (SPEEDS - 1) + 1], speeds[SPEEDS];
  static bike_modes fine[8 * (SPEEDS - 1) + 1], coarse[SPEEDS];
  int joined = 0;
  for (int b = 0; b < SHIPPED_COUNT; b++) {
    bike_model model = model_of(shipped_bicycles[b].name);
    for (int i = 0; i < 8 * (SPEEDS - 1) + 1; i++) fine_speeds[i] = 20.0 * i / (8 * (SPEEDS - 1));
    for (int i = 0; i < SPEEDS; i++) speeds[i] = fine_speeds[8 * i];
    assert_int_equal(bike_upright_modes(coarse, &model, speeds, SPEEDS), BIKE_OK);
    assert_int_equal(bike_upright_modes(fine, &model, fine_speeds, 8 * (SPEEDS - 1) + 1), BIKE_OK);
    for (int i = 0; i < SPEEDS; i++) {
      assert_int_equal(count_of(&coarse[i], BIKE_MODE_WEAVE), 2);
      assert_int_equal(count_of(&coarse[i], BIKE_MODE_UNNAMED), 0);
      joined += count_of(&coarse[i], BIKE_MODE_JOINED) > 0;
      for (int k = 0; k < 4; k++) {
        assert_int_equal(coarse[i].mode[k], fine[8 * i].mode[k]);
        // an oscillation is one mode, whatever has collided before
        for (int n = 0; n < 4; n++)
          if (coarse[i].values.im[k] != 0 && coarse[i].values.im[n] == -coarse[i].values.im[k])
            assert_int_equal(coarse[i].mode[k], coarse[i].mode[n]);
      }
    }
  }
  assert_true(joined > 0); // the riderless roadster's capsize and castering join
}

static void impossible_questions_are_refused(void **state) {
  (void)state;
  bike_model model = model_of("benchmark");
  bike_modes modes[3];
  const double unordered[3] = {1, 3, 2}, wild[1] = {NAN};
  double A[16] = {INFINITY};
  assert_int_equal(bike_upright_modes(modes, &model, unordered, 3), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_upright_modes(modes, &model, unordered, 0), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_upright_modes(modes, NULL, unordered, 2), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_upright_modes(modes, &model, wild, 1), BIKE_ERROR_NOT_FINITE);
  assert_int_equal(bike_modes_of(modes, A), BIKE_ERROR_NOT_FINITE);
  assert_int_equal(bike_modes_of(NULL, A), BIKE_ERROR_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names_of_the_literature),
      cmocka_unit_test(vectors_are_eigenvectors),
      cmocka_unit_test(steps_do_not_change_names),
      cmocka_unit_test(impossible_questions_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
