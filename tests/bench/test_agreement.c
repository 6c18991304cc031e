// SPDX-License-Identifier: Apache-2.0
// sympy's bicycle is ours, for every shipped bicycle; and a wrong one is noticed.
#include "peers/agreement.h"
#include "support/near.h"

#include <bicycle/file.h>
#include <stdio.h>

static const char *const BICYCLES[] = {"benchmark", "penny_farthing",   "recumbent",
                                       "roadster",  "recumbent_damped", "roadster_riderless"};

static sympy_accelerator *const SYSTEMS[] = {sympy_accelerate, sympy_accelerate_reduced};

static void load(bench_subject *subject, sympy_bicycle *sympy, const char *name) {
  char path[1024];
  snprintf(path, sizeof path, "%s/model/%s/%s.yml", BICYCLE_SOURCE_DIR, name, name);
  static bike_file file;
  bike_file_error error;
  if (bike_file_read(&file, path, &error)) fail_msg("%s", error.text);
  subject->bicycle = file.bicycle;
  assert_int_equal(bike_model_init(&subject->model, &subject->bicycle), 0);
  assert_true(sympy_bicycle_init(sympy, &subject->bicycle, &subject->model));
}

static double disagreement(sympy_accelerator *system, const sympy_bicycle *sympy,
                           const bench_subject *subject) {
  bench_notes notes = {0};
  if (!sympy_agreement(&notes, system, sympy, subject)) fail_msg("%s", notes.reason);
  assert_int_equal(notes.count, 2);
  assert_string_equal(notes.list[1].name, "disagreement");
  assert_near(notes.list[1].limit, 1e-12, 0);
  return notes.list[1].value;
}

static void shipped_bicycles_agree(void **state) {
  (void)state;
  static bench_subject subject;
  sympy_bicycle sympy;
  for (size_t i = 0; i < sizeof BICYCLES / sizeof BICYCLES[0]; i++) {
    load(&subject, &sympy, BICYCLES[i]);
    for (int k = 0; k < 2; k++) assert_below(disagreement(SYSTEMS[k], &sympy, &subject), 1e-12);
  }
}

// Each parameter matters to both systems, so that none is read from the wrong place.
static void every_parameter_matters(void **state) {
  (void)state;
  enum { PARAMETERS = sizeof(sympy_bicycle) / sizeof(double), START = 2 };
  static bench_subject subject;
  static sympy_bicycle sympy;
  load(&subject, &sympy, "benchmark");
  double *parameter = (double *)&sympy;
  for (int i = 0; i < PARAMETERS - START; i++) {
    double kept = parameter[i];
    parameter[i] += 1e-3;
    for (int k = 0; k < 2; k++)
      if (!(disagreement(SYSTEMS[k], &sympy, &subject) > 1e-9)) fail_msg("parameter %d, %d", i, k);
    parameter[i] = kept;
  }
}

// Whatever the ride of scipy calls is one of these two; upright, at rest and fast it must not be
// 0/0.
static void straight_riding_is_regular(void **state) {
  (void)state;
  static bench_subject subject;
  sympy_bicycle sympy;
  load(&subject, &sympy, "roadster");
  for (int speed = 0; speed <= 10; speed += 5)
    for (int k = 0; k < 2; k++) {
      bike_acceleration a;
      assert_true(SYSTEMS[k](&a, &sympy, &(bike_state){.speed = speed}));
      assert_near(a.lean, 0, 1e-12);
      assert_near(a.steer, 0, 1e-12);
      assert_near(a.speed, 0, 1e-12);
    }
}

static void one_sided_bicycle_is_not_taken(void **state) {
  (void)state;
  static bench_subject subject;
  sympy_bicycle sympy;
  load(&subject, &sympy, "roadster");
  for (int i = 0; i < subject.bicycle.part_count; i++)
    if (subject.bicycle.parts[i].rider) subject.bicycle.parts[i].position[1] = 0.01;
  assert_false(sympy_bicycle_init(&sympy, &subject.bicycle, &subject.model));
}

static void difference_is_relative_to_the_largest(void **state) {
  (void)state;
  bike_acceleration a = {.lean = 100, .steer = 1, .speed = 0.5}, b = a;
  b.speed += 1e-3;
  assert_near(acceleration_difference(&b, &a), 1e-5, 1e-15);
  b.speed = NAN;
  assert_true(isinf(acceleration_difference(&b, &a)));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(shipped_bicycles_agree),
                                     cmocka_unit_test(every_parameter_matters),
                                     cmocka_unit_test(straight_riding_is_regular),
                                     cmocka_unit_test(one_sided_bicycle_is_not_taken),
                                     cmocka_unit_test(difference_is_relative_to_the_largest)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
