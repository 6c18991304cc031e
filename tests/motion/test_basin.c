// SPDX-License-Identifier: Apache-2.0
// Basins of attraction: symmetry, threads, and the leaning fixed point that bounds them.
#include "equations/bicycles.h"
#include "support/near.h"
#include <bicycle/basin.h>
#include <bicycle/cycle.h>
#include <bicycle/error.h>
#include <bicycle/turn.h>
#include <string.h>

static const double DEGREE = M_PI / 180;

static bike_model roadster(void) {
  bike_model model;
  bike_bicycle bicycle = read_shipped("roadster");
  assert_int_equal(bike_model_init(&model, &bicycle), BIKE_OK);
  return model;
}

static bike_fate fate(const bike_model *model, double speed, double lean, double steer) {
  bike_fate out;
  double time;
  bike_basin_def def = bike_default_basin_def();
  def.speed = speed;
  assert_int_equal(bike_fate_of(&out, &time, model, &def, lean, steer), BIKE_OK);
  assert_true(time >= 0 && time <= def.duration);
  return out;
}

// 5.8 m/s is inside the stable range, 4.8 m/s just below it, where a cycle of some 6 deg attracts.
static void known_fates(void **state) {
  (void)state;
  bike_model model = roadster();
  assert_int_equal(fate(&model, 5.8, 0, 0), BIKE_FATE_STRAIGHT);
  assert_int_equal(fate(&model, 5.8, 10 * DEGREE, 0), BIKE_FATE_STRAIGHT);
  assert_int_equal(fate(&model, 5.8, 40 * DEGREE, 0), BIKE_FATE_FALLEN);
  assert_int_equal(fate(&model, 4.8, 1 * DEGREE, 0), BIKE_FATE_RIDING);
  assert_int_equal(fate(&model, 2, 5 * DEGREE, 0), BIKE_FATE_FALLEN);
  assert_int_equal(fate(&model, 5.8, 80 * DEGREE, 60 * DEGREE), BIKE_FATE_NO_START);
  // a slow fall, 0.07 1/s at 8 m/s, looks straight at first; a passage is not yet a return
  assert_true(fate(&model, 8, 0.05 * DEGREE, 0) != BIKE_FATE_STRAIGHT);
  bike_fate out;
  double time;
  bike_basin_def def = bike_default_basin_def();
  def.speed = 5.8;
  assert_int_equal(bike_fate_of(&out, &time, &model, &def, 0.01 * DEGREE, 0), BIKE_OK);
  assert_true(out == BIKE_FATE_STRAIGHT && time > 0.9);
}

static bike_fate fate_from(const bike_model *model, bike_state start, double offset, double *time) {
  bike_fate out;
  bike_basin_def def = bike_default_basin_def();
  assert_int_equal(bike_fate_of_start(&out, time, model, &def, &start, offset), BIKE_OK);
  return out;
}

// From the same starts both ways of asking have the same answer, decided at the same time.
static void any_start_agrees_with_the_basin(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_basin_def def = bike_default_basin_def();
  def.speed = 5.8;
  for (int lean = -60; lean <= 60; lean += 12)
    for (int steer = -60; steer <= 60; steer += 20) {
      bike_fate expected;
      double time, expected_time;
      bike_state start = {.lean = lean * DEGREE, .steer = steer * DEGREE};
      assert_int_equal(
          bike_fate_of(&expected, &expected_time, &model, &def, start.lean, start.steer), BIKE_OK);
      if (expected == BIKE_FATE_NO_START) continue;
      assert_int_equal(bike_speed_of_equal_energy(&start.speed, &model, &start, 5.8), BIKE_OK);
      assert_int_equal(fate_from(&model, start, 0, &time), expected);
      assert_near(time, expected_time, 1e-6);
    }
}

static void fates_of_rates_and_offsets(void **state) {
  (void)state;
  double time;
  bike_model model = roadster();
  assert_int_equal(fate_from(&model, (bike_state){.speed = 5.8, .lean_rate = 0.2}, 0, &time),
                   BIKE_FATE_STRAIGHT);
  assert_int_equal(fate_from(&model, (bike_state){.speed = 5.8, .lean_rate = 9}, 0, &time),
                   BIKE_FATE_FALLEN);
  assert_int_equal(fate_from(&model, (bike_state){.speed = 5.8, .lean = 1.5, .steer = 1}, 0, &time),
                   BIKE_FATE_NO_START);
  // a slow fall rides straight for seconds; no attraction, no return
  assert_true(fate_from(&model, (bike_state){.speed = 8, .lean = 0.05 * DEGREE}, 0, &time) !=
              BIKE_FATE_STRAIGHT);
  // 3 mm beside: not straight, but a circle that attracts; beyond the weave speed none does
  assert_int_equal(fate_from(&model, (bike_state){.speed = 5.8}, 0.003, &time), BIKE_FATE_STRAIGHT);
  assert_true(time > 1);
  assert_true(fate_from(&model, (bike_state){.speed = 4.5}, 0.003, &time) != BIKE_FATE_STRAIGHT);
  bike_fate out;
  bike_basin_def def = bike_default_basin_def();
  model.rider_mass = 0;
  assert_int_equal(bike_fate_of_start(&out, &time, &model, &def, &(bike_state){.speed = 5}, 0.01),
                   BIKE_ERROR_NO_RIDER);
}

enum { SIDE = 9 };

static void make_grid(double leans[SIDE], double steers[SIDE]) {
  for (int i = 0; i < SIDE; i++) {
    leans[i] = (i - SIDE / 2) * 9 * DEGREE;
    steers[i] = (i - SIDE / 2) * 12 * DEGREE;
  }
}

static void basin(bike_fate out[SIDE * SIDE], const bike_model *model, int threads) {
  double leans[SIDE], steers[SIDE];
  bike_basin_def def = bike_default_basin_def();
  make_grid(leans, steers);
  def.speed = 5.8;
  def.leans = leans;
  def.steers = steers;
  def.lean_count = def.steer_count = SIDE;
  def.threads = threads;
  assert_int_equal(bike_basin(out, model, &def), BIKE_OK);
}

static void threads_change_nothing(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_fate one[SIDE * SIDE], three[SIDE * SIDE];
  basin(one, &model, 1);
  basin(three, &model, 3);
  assert_memory_equal(one, three, sizeof one);
}

static void basins_are_symmetric(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_fate out[SIDE * SIDE];
  double leans[SIDE], steers[SIDE];
  int count[BIKE_FATES] = {0};
  basin(out, &model, 1);
  make_grid(leans, steers);
  for (int k = 0; k < SIDE * SIDE; k++) {
    assert_int_equal(out[k], out[SIDE * SIDE - 1 - k]);
    count[out[k]]++;
  }
  assert_true(count[BIKE_FATE_STRAIGHT] > SIDE && count[BIKE_FATE_FALLEN] > SIDE);
  assert_int_equal(out[SIDE * SIDE / 2], BIKE_FATE_STRAIGHT);
  // row by row from the lowest steer, as promised
  assert_int_equal(fate(&model, 5.8, leans[7], steers[2]), BIKE_FATE_STRAIGHT);
  assert_int_equal(out[2 * SIDE + 7], BIKE_FATE_STRAIGHT);
  assert_int_equal(out[7 * SIDE + 7], BIKE_FATE_FALLEN);
}

// At the same energy as the unstable leaning circle (hands off, no offset), a little less lean and
// steer comes back to riding straight, a little more falls.
static void the_leaning_circle_bounds_it(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_turn_def def = bike_default_turn_def();
  bike_turns turns;
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_OFFSET] = true;
  def.value[BIKE_TURN_SPEED] = 5.8;
  assert_int_equal(bike_turns_find(&turns, &model, &def), BIKE_OK);
  const bike_turn *circle = NULL;
  for (int i = turns.count - 1; i >= 0; i--) // the least lean to the right; there are steeper ones
    if (turns.turns[i].lean > 0.1) circle = &turns.turns[i];
  assert_non_null(circle);
  assert_true(circle->eps_max > 0);
  bike_state leaning = {.lean = circle->lean, .steer = circle->steer, .speed = circle->speed};
  bike_state standing = {0};
  bike_snapshot there, upright;
  double M[9];
  assert_int_equal(bike_evaluate(&there, &model, &leaning, NULL), BIKE_OK);
  assert_int_equal(bike_evaluate(&upright, &model, &standing, NULL), BIKE_OK);
  assert_int_equal(bike_mass_matrix(M, &model, &standing, 0), BIKE_OK);
  double speed = sqrt(2 * (there.kinetic + there.potential - upright.potential) / M[8]);
  assert_int_equal(fate(&model, speed, 0.97 * leaning.lean, 0.97 * leaning.steer),
                   BIKE_FATE_STRAIGHT);
  assert_int_equal(fate(&model, speed, 1.03 * leaning.lean, 1.03 * leaning.steer),
                   BIKE_FATE_FALLEN);
}

static void impossible_questions_are_refused(void **state) {
  (void)state;
  bike_model model = roadster();
  double angle[2] = {0, 0.1};
  bike_fate out[4];
  bike_basin_def good = bike_default_basin_def();
  good.speed = 5;
  good.leans = good.steers = angle;
  good.lean_count = good.steer_count = 2;
  assert_int_equal(bike_basin(out, &model, &good), BIKE_OK);
  bike_basin_def bad = good;
  bad.speed = NAN;
  assert_int_equal(bike_basin(out, &model, &bad), BIKE_ERROR_ARGUMENT);
  bad = good;
  bad.threads = 0;
  assert_int_equal(bike_basin(out, &model, &bad), BIKE_ERROR_ARGUMENT);
  bad = good;
  bad.duration = -1;
  assert_int_equal(bike_basin(out, &model, &bad), BIKE_ERROR_ARGUMENT);
  bad = good;
  bad.leans = NULL;
  assert_int_equal(bike_basin(out, &model, &bad), BIKE_ERROR_ARGUMENT);
  bad = good;
  bad.settled = 0;
  assert_int_equal(bike_basin(out, &model, &bad), BIKE_ERROR_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(known_fates),
      cmocka_unit_test(any_start_agrees_with_the_basin),
      cmocka_unit_test(fates_of_rates_and_offsets),
      cmocka_unit_test(threads_change_nothing),
      cmocka_unit_test(basins_are_symmetric),
      cmocka_unit_test(the_leaning_circle_bounds_it),
      cmocka_unit_test(impossible_questions_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
