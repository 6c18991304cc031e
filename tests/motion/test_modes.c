// SPDX-License-Identifier: Apache-2.0
// Modes: eigenvectors, names of the literature, names that depend on the bicycle and the speed
// alone. test_modes BICYCLES LISTS: how many random ones.
#include "equations/bicycles.h"
#include "reference/reference.h"
#include "support/near.h"
#include <bicycle/error.h>
#include <bicycle/file.h>
#include <bicycle/modes.h>
#include <stdlib.h>

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

// How many random bicycles, and lists of speeds for each: given on the command line for long runs.
static int random_count = 30, list_count = 10;

// The shipped bicycles, then random ones.
static bike_model any_model(int index, random_source *source) {
  if (index < SHIPPED_COUNT) return model_of(shipped_bicycles[index].name);
  bike_bicycle bicycle = random_bicycle(source, true);
  bike_model model;
  assert_int_equal(bike_model_init(&model, &bicycle), BIKE_OK);
  return model;
}

static int rising(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

// A name is a function of the bicycle and the speed: whatever else is asked, in whatever order.
static void names_do_not_depend_on_the_list(void **state) {
  (void)state;
  enum { MOST = 12 };
  random_source source = random_begin("names and lists", 11);
  long compared = 0;
  for (int b = 0; b < SHIPPED_COUNT + random_count; b++) {
    bike_model model = any_model(b, &source);
    for (int l = 0; l < list_count; l++) {
      double speeds[MOST];
      bike_modes listed[MOST], alone;
      const int count = 2 + (int)(random_bits(&source) % (MOST - 1));
      const double low = random_between(&source, -20, 20), high = random_between(&source, low, 45);
      for (int i = 0; i < count; i++) speeds[i] = random_between(&source, low, high);
      qsort(speeds, (size_t)count, sizeof speeds[0], rising);
      assert_int_equal(bike_upright_modes(listed, &model, speeds, count), BIKE_OK);
      const int asked = (int)(random_bits(&source) % (unsigned)count);
      assert_int_equal(bike_upright_modes(&alone, &model, &speeds[asked], 1), BIKE_OK);
      for (int k = 0; k < 4; k++) {
        assert_int_equal(listed[asked].mode[k], alone.mode[k]);
        compared++;
      }
    }
  }
  printf("%d bicycles, %d lists each: %ld names compared\n", SHIPPED_COUNT + random_count,
         list_count, compared);
}

// Where eigenvectors tell the names of the literature by themselves, they are the same; an
// oscillation is one mode.
static long compare_with_vectors(const bike_model *model) {
  enum { COUNT = 100 };
  double speeds[COUNT];
  static bike_modes named[COUNT];
  long same = 0;
  for (int i = 0; i < COUNT; i++) speeds[i] = 0.2 * (i + 1);
  assert_int_equal(bike_upright_modes(named, model, speeds, COUNT), BIKE_OK);
  for (int i = 0; i < COUNT; i++) {
    bike_state straight = {.speed = speeds[i]};
    bike_linear linear;
    bike_modes told;
    assert_int_equal(bike_linearize(&linear, model, &straight, NULL), BIKE_OK);
    assert_int_equal(bike_modes_of(&told, linear.A), BIKE_OK);
    const bike_modes *m = &named[i];
    for (int k = 0; k < 4; k++) {
      bool both = m->mode[k] != BIKE_MODE_UNNAMED && told.mode[k] != BIKE_MODE_UNNAMED;
      if (both) assert_int_equal(m->mode[k], told.mode[k]);
      same += both;
      for (int n = 0; n < 4; n++)
        if (m->values.im[k] != 0 && m->values.im[n] == -m->values.im[k])
          assert_int_equal(m->mode[k], m->mode[n]);
    }
  }
  return same;
}

// What passes zero at a capsize speed is capsize, or has lost its name.
static void check_capsize(const bike_model *model, bool always_named) {
  bike_critical_speeds critical;
  assert_int_equal(bike_upright_critical_speeds(&critical, model, 0, 40), BIKE_OK);
  for (int i = 0; i < critical.capsize_count; i++) {
    bike_modes at;
    int passing = -1;
    assert_int_equal(bike_upright_modes(&at, model, &critical.capsize[i], 1), BIKE_OK);
    for (int k = 0; k < 4; k++)
      if (at.values.im[k] == 0 &&
          (passing < 0 || fabs(at.values.re[k]) < fabs(at.values.re[passing])))
        passing = k;
    assert_true(passing >= 0);
    if (always_named || at.mode[passing] != BIKE_MODE_UNNAMED)
      assert_int_equal(at.mode[passing], BIKE_MODE_CAPSIZE);
  }
}

static void names_are_those_of_the_vectors(void **state) {
  (void)state;
  random_source source = random_begin("names and vectors", 12);
  long same = 0;
  for (int b = 0; b < SHIPPED_COUNT + random_count; b++) {
    bike_model model = any_model(b, &source);
    same += compare_with_vectors(&model);
    check_capsize(&model, b < SHIPPED_COUNT);
  }
  printf("%d bicycles: %ld names are told by eigenvectors too, all the same\n",
         SHIPPED_COUNT + random_count, same);
  assert_true(same > 100 * random_count);
}

static int unnamed_at(const bike_model *model, double speed) {
  bike_modes at;
  assert_int_equal(bike_upright_modes(&at, model, &speed, 1), BIKE_OK);
  return count_of(&at, BIKE_MODE_UNNAMED);
}

// Modes are unnamed beyond a speed at which names end, and nowhere else.
static void ends_of_names_are_told(void **state) {
  (void)state;
  enum { PLACES = 161 };
  static bike_modes at[PLACES];
  double speeds[PLACES];
  random_source source = random_begin("ends of names", 13);
  int ended = 0, joined = 0;
  for (int b = 0; b < SHIPPED_COUNT + random_count; b++) {
    bike_model model = any_model(b, &source);
    bike_name_end ends[BIKE_MAX_NAME_ENDS];
    int count, most = 0, least = 4;
    assert_int_equal(bike_upright_name_ends(ends, &count, &model), BIKE_OK);
    if (b < SHIPPED_COUNT) assert_int_equal(count, 0);
    for (int i = 0; i < PLACES; i++) speeds[i] = 0.25 * (i - PLACES / 2);
    assert_int_equal(bike_upright_modes(at, &model, speeds, PLACES), BIKE_OK);
    for (int i = 0; i < PLACES; i++) {
      const int unnamed = count_of(&at[i], BIKE_MODE_UNNAMED);
      if (unnamed > most) most = unnamed;
      if (unnamed < least) least = unnamed;
      joined += count_of(&at[i], BIKE_MODE_JOINED) > 0;
    }
    if (count == 0) assert_true(most == least); // all have names, or none
    ended += count > 0;
    for (int i = 0; i < count; i++) {
      if (ends[i].modes[0] == BIKE_MODE_CASTERING && ends[i].modes[1] == BIKE_MODE_CASTERING)
        continue; // unnamed on both sides
      const double beside = 1e-9 * fabs(ends[i].speed);
      assert_true(unnamed_at(&model, ends[i].speed - beside) !=
                  unnamed_at(&model, ends[i].speed + beside));
    }
  }
  printf("names of %d bicycles end; capsize and castering were joined at %d speeds\n", ended,
         joined);
  assert_true(ended > 0 && joined > 0);
}

static bike_model odd(const char *name) {
  char path[512];
  snprintf(path, sizeof path, "%s/tests/odd_bicycles/%s.yml", BICYCLE_SOURCE_DIR, name);
  bike_file file;
  bike_file_error error;
  bike_model model;
  if (bike_file_read(&file, path, &error)) fail_msg("%s", error.text);
  assert_int_equal(bike_model_init(&model, &file.bicycle), BIKE_OK);
  return model;
}

static void check_named(const char *name, double speed, const double values[2]) {
  bike_model model = odd(name);
  for (int list = 0; list < 2; list++) { // one that starts slow, one that starts at the speed
    const double speeds[] = {list ? speed : 0.25 * speed, list ? 1.125 * speed : speed};
    bike_modes modes[2];
    assert_int_equal(bike_upright_modes(modes, &model, speeds, 2), BIKE_OK);
    assert_near(named(&modes[1 - list], BIKE_MODE_CAPSIZE), values[0], 1e-4);
    assert_near(named(&modes[1 - list], BIKE_MODE_CASTERING), values[1], 1e-4);
  }
  check_capsize(&model, true);
}

// Bicycles whose oscillation has more steer or less at other speeds.
static void odd_bicycles_are_named(void **state) {
  (void)state;
  check_named("long_trail", 8, (const double[]){0.977225, -1.25159});
  check_named("two_masses", 4, (const double[]){-1.69409, -41.0132});
}

// At both sides of standing still, where nothing collides, names go on in their order.
static void names_go_on_backwards(void **state) {
  (void)state;
  for (int b = 0; b < SHIPPED_COUNT; b++) {
    bike_model model = model_of(shipped_bicycles[b].name);
    const double speeds[] = {-1e-3, 0, 1e-3};
    bike_modes at[3];
    assert_int_equal(bike_upright_modes(at, &model, speeds, 3), BIKE_OK);
    for (int k = 0; k < 4; k++) {
      assert_int_equal(at[0].mode[k], at[1].mode[k]);
      assert_int_equal(at[2].mode[k], at[1].mode[k]);
    }
  }
}

static void impossible_questions_are_refused(void **state) {
  (void)state;
  bike_model model = model_of("benchmark");
  bike_modes modes[2];
  const double some[2] = {1, 3}, wild[1] = {NAN};
  double A[16] = {INFINITY};
  assert_int_equal(bike_upright_modes(modes, &model, some, 0), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_upright_modes(modes, NULL, some, 2), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_upright_modes(modes, &model, wild, 1), BIKE_ERROR_NOT_FINITE);
  assert_int_equal(bike_modes_of(modes, A), BIKE_ERROR_NOT_FINITE);
  assert_int_equal(bike_modes_of(NULL, A), BIKE_ERROR_ARGUMENT);
  int count;
  bike_name_end ends[BIKE_MAX_NAME_ENDS];
  assert_int_equal(bike_upright_name_ends(ends, NULL, &model), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_upright_name_ends(NULL, &count, &model), BIKE_ERROR_ARGUMENT);
}

int main(int argc, char **argv) {
  if (argc > 2) random_count = atoi(argv[1]), list_count = atoi(argv[2]);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names_of_the_literature),
      cmocka_unit_test(vectors_are_eigenvectors),
      cmocka_unit_test(names_do_not_depend_on_the_list),
      cmocka_unit_test(names_are_those_of_the_vectors),
      cmocka_unit_test(ends_of_names_are_told),
      cmocka_unit_test(odd_bicycles_are_named),
      cmocka_unit_test(names_go_on_backwards),
      cmocka_unit_test(impossible_questions_are_refused),
  };
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  printf("%d random bicycles, %d lists of speeds each: %d tests failed\n", random_count, list_count,
         failed);
  return failed;
}
