// SPDX-License-Identifier: Apache-2.0
// Lanes do not know their neighbours; errors, addresses, arguments of batches.
#include "batch/columns.h"
#include "batch/lanes_support.h"
#include "support/near.h"
#include <bicycle/error.h>

static const double DEGREE = M_PI / 180;

enum { COUNT = 203 };

typedef struct crowd {
  bike_model models[COUNT];
  bike_state states[COUNT];
} crowd;

static void gather(crowd *all, random_source *source) {
  for (int i = 0; i < COUNT; i++) {
    int which = (int)(random_bits(source) % SHIPPED_COUNT);
    all->models[i] = i % 5 ? shipped_model(which) : random_model(source);
    random_range range = shipped_bicycles[which].range;
    if (i % 5 == 0) range.lean = range.steer = 20 * DEGREE;
    all->states[i] = random_state(source, &range);
  }
}

static void assert_same(const columns *a, size_t i, const columns *b, size_t j, size_t offset) {
  bike_acceleration x = columns_result(a, i, 0), y = columns_result(b, j, offset);
  assert_int_equal(a->codes[i], b->codes[j]);
  assert_same_bits(x.lean, y.lean, "lean");
  assert_same_bits(x.steer, y.steer, "steer");
  assert_same_bits(x.speed, y.speed, "speed");
}

static void place_means_nothing(void **unused) {
  (void)unused;
  static crowd all;
  static bike_model models[COUNT];
  static bike_state states[COUNT];
  static columns straight, other;
  random_source source = random_begin("place", 90011);
  gather(&all, &source);
  columns_solve(&straight, all.models, COUNT, all.states, COUNT, 0);
  for (size_t i = 0; i < COUNT; i++) { // alone
    columns_solve(&other, &all.models[i], 1, &all.states[i], 1, 0);
    assert_same(&straight, i, &other, 0, 0);
  }
  for (size_t by = 1; by < 9; by++) { // every lane in turn
    for (size_t i = 0; i < COUNT; i++) {
      models[(i + by) % COUNT] = all.models[i];
      states[(i + by) % COUNT] = all.states[i];
    }
    columns_solve(&other, models, COUNT, states, COUNT, 0);
    for (size_t i = 0; i < COUNT; i++) assert_same(&straight, i, &other, (i + by) % COUNT, 0);
  }
}

// Columns of doubles at any address that doubles may have.
static void columns_need_no_alignment(void **unused) {
  (void)unused;
  static crowd all;
  static columns aligned, odd;
  random_source source = random_begin("alignment", 90012);
  gather(&all, &source);
  columns_solve(&aligned, all.models, COUNT, all.states, COUNT, 0);
  columns_solve(&odd, all.models, COUNT, all.states, COUNT, 1);
  for (size_t i = 0; i < COUNT; i++) assert_same(&aligned, i, &odd, i, 1);
}

// Writes to nothing but what is asked for.
static void nothing_else_is_written(void **unused) {
  (void)unused;
  static crowd all;
  static columns c;
  random_source source = random_begin("edges", 90013);
  gather(&all, &source);
  for (size_t count = 1; count < 20; count++) {
    for (int k = 0; k < 3; k++) c.out[k][count] = -77;
    c.codes[count] = -77;
    columns_solve(&c, all.models, count, all.states, count, 0);
    for (int k = 0; k < 3; k++) assert_true(c.out[k][count] == -77);
    assert_int_equal(c.codes[count], -77);
  }
}

// Steer at which the yaw rate (13) is not determined: its denominator's zero.
static bike_state singular_state(const bike_model *model) {
  double low = 0, high = 120 * DEGREE;
  for (int i = 0; i < 200; i++) {
    double middle = low + (high - low) / 2;
    bike_snapshot now;
    bike_state at = {.steer = middle};
    int code = bike_evaluate(&now, model, &at, NULL);
    if (code == BIKE_ERROR_SINGULAR) return (bike_state){.steer = middle, .speed = 1};
    assert_int_equal(code, BIKE_OK);
    if (now.T_r * cos(now.phi_tilde) > now.T_f)
      low = middle;
    else
      high = middle;
  }
  fail_msg("no singular state found");
  return (bike_state){0};
}

enum { WRONG_MOST = 32 };

// States that have no accelerations, and some that have though an angle is far out.
static int wrong_states(bike_state out[WRONG_MOST], const bike_model *model) {
  const bike_state good = {0.2, -0.8, 0.3, 0.4, 5};
  int count = 0;
  const double bad[] = {NAN, INFINITY, -INFINITY};
  for (int k = 0; k < 15; k++) {
    bike_state s = good;
    double *part[5] = {&s.lean, &s.steer, &s.lean_rate, &s.steer_rate, &s.speed};
    *part[k % 5] = bad[k / 5];
    out[count++] = s;
  }
  const bike_state more[] = {
      singular_state(model),                        //
      {.lean = 1.3, .steer = 1.5, .speed = 2},      // no geometry
      {.lean = 90 * DEGREE, .speed = 2},            // flat
      {.lean = 3, .steer = 0.3, .speed = 2},        // below the ground
      {.steer = 20, .speed = 2},                    // turned round three times
      {.lean = 1e6, .speed = 2},                    //
      {.lean = 1e300, .steer = -1e300, .speed = 2}, //
      {.speed = 1e300},                             //
      {.steer = 0.1, .speed = 1e200},               // overflows on the way
      {.lean_rate = 1e308, .speed = 1e308},         //
  };
  for (size_t i = 0; i < sizeof more / sizeof *more; i++) out[count++] = more[i];
  return count;
}

static void codes_are_those_of_one_state(void **unused) {
  (void)unused;
  static columns c;
  int seen[4] = {0}; // OK, NOT_FINITE, GEOMETRY, SINGULAR
  for (int which = 0; which < SHIPPED_COUNT; which++) {
    bike_model model = shipped_model(which);
    bike_state states[WRONG_MOST];
    int count = wrong_states(states, &model);
    columns_solve(&c, &model, 1, states, (size_t)count, 0);
    for (int i = 0; i < count; i++) {
      bike_acceleration want, got = columns_result(&c, (size_t)i, 0);
      int code = bike_accelerate(&want, &model, &states[i], NULL);
      if (c.codes[i] != code)
        fail_msg("%s, state %d: %s, not %s", shipped_bicycles[which].name, i,
                 bike_error_string(c.codes[i]), bike_error_string(code));
      seen[0] += code == BIKE_OK;
      seen[1] += code == BIKE_ERROR_NOT_FINITE;
      seen[2] += code == BIKE_ERROR_GEOMETRY;
      seen[3] += code == BIKE_ERROR_SINGULAR;
      if (code) assert_true(isnan(got.lean) && isnan(got.steer) && isnan(got.speed));
    }
  }
  assert_true(seen[0] > 0 && seen[1] > 0 && seen[2] > 0 && seen[3] > 0);
}

// Every wrong state in each lane of a block: the others come out as without it. Angles beyond 40
// deg show a sine that is computed in another manner because of a neighbour.
static void wrong_states_disturb_no_neighbour(void **unused) {
  (void)unused;
  static columns without, with;
  const random_range range = {45 * DEGREE, 60 * DEGREE, 2, 1, 10};
  random_source source = random_begin("neighbours", 90014);
  bike_model model = named_model("roadster");
  bike_state wrong[WRONG_MOST], good[16], mixed[16];
  int count = wrong_states(wrong, &model);
  for (int round = 0; round < 40; round++)
    for (int k = 0; k < count; k++) {
      size_t lane = random_bits(&source) % 16;
      for (int i = 0; i < 16; i++) mixed[i] = good[i] = random_state(&source, &range);
      mixed[lane] = wrong[k];
      columns_solve(&without, &model, 1, good, 16, 0);
      columns_solve(&with, &model, 1, mixed, 16, 0);
      for (size_t i = 0; i < 16; i++)
        if (i != lane) assert_same(&without, i, &with, i, 0);
    }
}

static void codes_may_be_left_out(void **unused) {
  (void)unused;
  bike_model model = named_model("roadster");
  double lean[3] = {0, NAN, 0.1}, zero[3] = {0}, speed[3] = {5, 5, 5}, out[3][3];
  bike_batch *batch;
  assert_int_equal(bike_batch_create(&batch, &model, 1), BIKE_OK);
  bike_batch_states in = {lean, zero, zero, zero, speed};
  bike_batch_accelerations to = {out[0], out[1], out[2], NULL};
  assert_int_equal(bike_batch_accelerate(&to, batch, &in, 3), BIKE_OK);
  assert_true(out[0][0] == 0 && isnan(out[0][1]) && out[0][2] > 0);
  assert_int_equal(bike_batch_accelerate(&to, batch, &in, 0), BIKE_OK);
  bike_batch_free(batch);
}

static void wrong_arguments(void **unused) {
  (void)unused;
  bike_model models[2] = {named_model("roadster"), named_model("benchmark")};
  double x[3] = {0}, y[3][3];
  bike_batch *one = NULL, *two = NULL, *none = NULL;
  assert_int_equal(bike_batch_create(NULL, models, 1), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_batch_create(&none, NULL, 1), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_batch_create(&none, models, 0), BIKE_ERROR_ARGUMENT);
  assert_null(none);
  bike_batch_free(NULL);
  assert_int_equal(bike_batch_create(&one, models, 1), BIKE_OK);
  assert_int_equal(bike_batch_create(&two, models, 2), BIKE_OK);
  const bike_batch_states in = {x, x, x, x, x};
  const bike_batch_accelerations out = {y[0], y[1], y[2], NULL};
  bike_batch_accelerations to = out;
  assert_int_equal(bike_batch_accelerate(&to, one, &in, 3), BIKE_OK);
  assert_int_equal(bike_batch_accelerate(&to, two, &in, 2), BIKE_OK);
  assert_int_equal(bike_batch_accelerate(&to, two, &in, 1), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_batch_accelerate(&to, two, &in, 3), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_batch_accelerate(NULL, one, &in, 1), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_batch_accelerate(&to, NULL, &in, 1), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_batch_accelerate(&to, one, NULL, 1), BIKE_ERROR_ARGUMENT);
  for (int k = 0; k < 8; k++) { // a column is missing
    bike_batch_states from = in;
    const double **column[5] = {&from.lean, &from.steer, &from.lean_rate, &from.steer_rate,
                                &from.speed};
    double **result[3] = {&to.lean, &to.steer, &to.speed};
    to = out;
    if (k < 5)
      *column[k] = NULL;
    else
      *result[k - 5] = NULL;
    assert_int_equal(bike_batch_accelerate(&to, one, &from, 1), BIKE_ERROR_ARGUMENT);
  }
  bike_batch_free(one);
  bike_batch_free(two);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(place_means_nothing),
      cmocka_unit_test(columns_need_no_alignment),
      cmocka_unit_test(nothing_else_is_written),
      cmocka_unit_test(codes_are_those_of_one_state),
      cmocka_unit_test(wrong_states_disturb_no_neighbour),
      cmocka_unit_test(codes_may_be_left_out),
      cmocka_unit_test(wrong_arguments),
  };
  return cmocka_run_group_tests(tests, print_instructions, NULL);
}
