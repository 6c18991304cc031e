// SPDX-License-Identifier: Apache-2.0
// Questions about stationary turns that have no answer, or more than turns for one.
#include "motion/bicycles.h"
#include "motion/turns.h"
#include "support/near.h"
#include <bicycle/error.h>
#include <bicycle/file.h>
#include <stdio.h>

static int asked(const bike_model *model, bike_turn_def def) {
  static bike_turns found;
  return bike_turns_find(&found, model, &def);
}

static void impossible_questions_are_refused(void **state) {
  (void)state;
  bike_model rider = roadster(), riderless = benchmark();
  bike_turn_def good = turn_def(BIKE_TURN_SPEED, 5, BIKE_TURN_OFFSET, 0), bad;
  static bike_turns found;
  assert_int_equal(bike_turns_find(NULL, &rider, &good), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_turns_find(&found, NULL, &good), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_turns_find(&found, &rider, NULL), BIKE_ERROR_ARGUMENT);
  assert_int_equal(asked(&rider, bike_default_turn_def()), BIKE_ERROR_ARGUMENT);
  bad = good, bad.given[BIKE_TURN_LEAN] = true;
  assert_int_equal(asked(&rider, bad), BIKE_ERROR_ARGUMENT);
  bad = turn_def(BIKE_TURN_LEAN, 0.1, BIKE_TURN_LEAN, 0.1);
  assert_int_equal(asked(&rider, bad), BIKE_ERROR_ARGUMENT);
  bad = good, bad.value[BIKE_TURN_SPEED] = -5;
  assert_int_equal(asked(&rider, bad), BIKE_ERROR_ARGUMENT);
  bad = good, bad.value[BIKE_TURN_SPEED] = NAN;
  assert_int_equal(asked(&rider, bad), BIKE_ERROR_NOT_FINITE);
  bad = good, bad.steer_torque = INFINITY;
  assert_int_equal(asked(&rider, bad), BIKE_ERROR_NOT_FINITE);
  bad = good, bad.lean_limit = 2;
  assert_int_equal(asked(&rider, bad), BIKE_ERROR_ARGUMENT);
  bad = turn_def(BIKE_TURN_SPEED, 5, BIKE_TURN_LEAN, 0.1);
  assert_int_equal(asked(&riderless, bad), BIKE_ERROR_NO_RIDER);
  bad = turn_def(BIKE_TURN_SPEED, 5, BIKE_TURN_OFFSET, 0.1);
  assert_int_equal(asked(&riderless, bad), BIKE_ERROR_NO_RIDER);
  assert_int_equal(asked(&riderless, good), BIKE_OK);
}

// Straight riding has any speed; a steer beyond the geometry has none. Answers, not errors.
static void degenerate_questions_are_answered(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_turn_def def = turn_def(BIKE_TURN_LEAN, 0, BIKE_TURN_STEER, 0);
  const bike_turns *found = turns_of(&model, &def);
  assert_true(found->straight && found->count == 0);
  // upright hands free: straight on, or standing with the handlebar turned to either side
  def = turn_def(BIKE_TURN_LEAN, 0, BIKE_TURN_OFFSET, 0);
  found = turns_of(&model, &def);
  assert_true(found->straight);
  assert_int_equal(main_family_count(found), 2);
  assert_near(found->turns[0].speed, 0, 0);
  assert_near(found->turns[0].steer, -found->turns[1].steer, 1e-11);
  def = turn_def(BIKE_TURN_LEAN, 0.2, BIKE_TURN_STEER, 0);
  found = turns_of(&model, &def);
  assert_true(!found->straight && found->count == 0);
  def = turn_def(BIKE_TURN_LEAN, 0.2, BIKE_TURN_STEER, 2.2);
  assert_int_equal(turns_of(&model, &def)->count, 0);
  def = turn_def(BIKE_TURN_SPEED, 0, BIKE_TURN_OFFSET, 0);
  assert_true(turns_of(&model, &def)->count >= 1);
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

// A branch that runs beyond any speed is one, however many meshes of the grid see the rest of it.
static void a_flat_steering_axis_is_answered(void **state) {
  (void)state;
  bike_model model = odd("flat_axis");
  bike_turn_def def = turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_LEAN, 5 * DEGREE);
  const bike_turns *found = turns_of(&model, &def);
  assert_int_equal(main_family_count(found), 0); // it is ridden beyond the 50 m/s looked at
  assert_in_range(found->branch_count, 1, 8);
  def.speed_limit = 1000;
  found = turns_of(&model, &def);
  assert_int_equal(main_family_count(found), 1);
  assert_near(found->turns[0].speed, 222.687, 1e-3);
  assert_near(found->turns[0].lean, 5 * DEGREE, 0);
}

// Standing upright, it stands at every steer: there is no fold, and no end.
static void a_free_steer_has_no_folds(void **state) {
  (void)state;
  bike_model model = odd("free_steer");
  bike_turn_def def = turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_OFFSET, 0);
  assert_int_equal(turns_of(&model, &def)->mark_count, 0);
  def = turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_LEAN, 5 * DEGREE);
  assert_int_equal(turns_of(&model, &def)->mark_count, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_flat_steering_axis_is_answered),
      cmocka_unit_test(a_free_steer_has_no_folds),
      cmocka_unit_test(impossible_questions_are_refused),
      cmocka_unit_test(degenerate_questions_are_answered),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
