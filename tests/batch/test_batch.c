// SPDX-License-Identifier: Apache-2.0
// Accelerations in lanes against those of one state at a time.
#include "batch/columns.h"
#include "batch/lanes_support.h"
#include "support/near.h"
#include <bicycle/error.h>

static const double DEGREE = M_PI / 180;

// The same source, the same sines, and the compiler fuses the same products: the same bits. Where
// it is not held to that (lane_math.h), light steering makes a thousand roundings of one.
static void check_one(double got, double want, const char *what) {
#ifdef __x86_64__
  assert_same_bits(got, want, what);
#else
  (void)what;
  assert_near(got, want, 1e-11 * fmax(1, fabs(want)));
#endif
}

static void check_same(bike_acceleration got, const bike_model *model, const bike_state *state) {
  bike_acceleration want;
  assert_int_equal(bike_accelerate(&want, model, state, NULL), BIKE_OK);
  check_one(got.lean, want.lean, "lean");
  check_one(got.steer, want.steer, "steer");
  check_one(got.speed, want.speed, "speed");
}

static void check_batch(columns *c, const bike_model *models, size_t model_count,
                        const bike_state *states, size_t count) {
  columns_solve(c, models, model_count, states, count, 0);
  for (size_t i = 0; i < count; i++) {
    assert_int_equal(c->codes[i], BIKE_OK);
    check_same(columns_result(c, i, 0), &models[model_count == 1 ? 0 : i], &states[i]);
  }
}

// Every partial block, one full and some after it; many.
static const size_t counts[] = {1,  2,  3,  4,  5,  6,  7,  8,  9,  10,  11,
                                12, 13, 14, 15, 16, 17, 18, 19, 20, 1000};
enum { COUNTS = sizeof counts / sizeof *counts };

static void one_bicycle_in_many_states(void **unused) {
  (void)unused;
  static columns c;
  static bike_state states[1000];
  random_source source = random_begin("one bicycle", 90001);
  for (int which = 0; which < SHIPPED_COUNT; which++) {
    bike_model model = shipped_model(which);
    for (int k = 0; k < COUNTS; k++) {
      for (size_t i = 0; i < counts[k]; i++)
        states[i] = random_state(&source, &shipped_bicycles[which].range);
      check_batch(&c, &model, 1, states, counts[k]);
    }
  }
}

static void another_bicycle_in_each_lane(void **unused) {
  (void)unused;
  static columns c;
  static bike_model models[1000];
  static bike_state states[1000];
  random_source source = random_begin("mixed bicycles", 90002);
  for (int k = 0; k < COUNTS; k++) {
    for (size_t i = 0; i < counts[k]; i++) {
      int which = (int)(random_bits(&source) % SHIPPED_COUNT);
      models[i] = shipped_model(which);
      states[i] = random_state(&source, &shipped_bicycles[which].range);
    }
    check_batch(&c, models, counts[k], states, counts[k]);
  }
}

// Lopsided bicycles have every term; they need not stand at large angles, so moderate ones.
static void random_bicycles(void **unused) {
  (void)unused;
  static columns c;
  static bike_model models[1000];
  static bike_state states[1000];
  const random_range range = {20 * DEGREE, 20 * DEGREE, 2, 1, 10};
  random_source source = random_begin("random bicycles", 90003);
  for (int k = 0; k < COUNTS; k++) {
    for (size_t i = 0; i < counts[k]; i++) {
      models[i] = random_model(&source);
      states[i] = random_state(&source, &range);
    }
    check_batch(&c, models, counts[k], states, counts[k]);
    check_batch(&c, models, 1, states, counts[k]);
  }
}

// Where the Newton steps from the guess near upright do not reach: lanes hand over to the scalar
// path, some lanes of a block or all.
static void large_angles(void **unused) {
  (void)unused;
  static columns c;
  static bike_state states[1000];
  const random_range range = {88 * DEGREE, 179 * DEGREE, 2, -10, 10};
  random_source source = random_begin("large angles", 90005);
  int solved = 0, refused = 0;
  for (int which = 0; which < SHIPPED_COUNT; which++) {
    bike_model model = shipped_model(which);
    for (int i = 0; i < 1000; i++) states[i] = random_state(&source, &range);
    columns_solve(&c, &model, 1, states, 1000, 0);
    for (size_t i = 0; i < 1000; i++) {
      bike_acceleration want, got = columns_result(&c, i, 0);
      int code = bike_accelerate(&want, &model, &states[i], NULL);
      assert_int_equal(c.codes[i], code);
      if (code) {
        assert_true(isnan(got.lean) && isnan(got.steer) && isnan(got.speed));
        refused++;
      } else {
        check_same(got, &model, &states[i]);
        solved++;
      }
    }
  }
  print_message("%d solved, %d refused\n", solved, refused);
  assert_true(solved > 500 && refused > 500);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_bicycle_in_many_states),
      cmocka_unit_test(another_bicycle_in_each_lane),
      cmocka_unit_test(random_bicycles),
      cmocka_unit_test(large_angles),
  };
  return cmocka_run_group_tests(tests, print_instructions, NULL);
}
