// SPDX-License-Identifier: Apache-2.0
// Where hands-free turns branch off riding straight: at a capsize speed, and close to it.
#include "equations/bicycles.h"
#include "motion/bicycles.h"
#include "motion/turns.h"
#include "support/near.h"
#include <bicycle/error.h>

// Turns that branch off lean and steer by less in these tests; all others lean or steer by more.
static bool is_beside(const bike_turn *turn) {
  const double least = 0.3; // rad
  return fabs(turn->lean) < least && fabs(turn->steer) < least;
}

static double capsize_speed(const bike_model *model) {
  bike_critical_speeds critical;
  assert_int_equal(bike_upright_critical_speeds(&critical, model, 0, 20), BIKE_OK);
  assert_int_equal(critical.capsize_count, 1);
  return critical.capsize[0];
}

// The solutions beside straight riding, by their lean.
typedef struct beside {
  int count;
  bike_turn turn[4];
} beside;

static beside found_beside(const bike_turns *found) {
  beside out = {0};
  for (int i = 0; i < found->count; i++) {
    if (!is_beside(&found->turns[i])) continue;
    assert_in_range(out.count, 0, 3);
    assert_true(found->turns[i].main_family);
    out.turn[out.count++] = found->turns[i];
  }
  return out;
}

static beside hands_free(const bike_model *model, double speed, double offset) {
  bike_turn_def def = turn_def(BIKE_TURN_SPEED, speed, BIKE_TURN_OFFSET, offset);
  return found_beside(turns_of(model, &def));
}

static void check_straight(const bike_turn *turn, double speed, bike_turn_mark mark) {
  assert_near(turn->lean, 0, 0);
  assert_near(turn->steer, 0, 0);
  assert_near(turn->speed, speed, 1e-15 * speed); // the root of a square
  assert_int_equal(turn->mark, mark);
}

// The speed of the turn with that lean: another curve, another unknown.
static double speed_of_lean(const bike_model *model, double lean, double offset) {
  bike_turn_def def = turn_def(BIKE_TURN_OFFSET, offset, BIKE_TURN_LEAN, lean);
  beside found = found_beside(turns_of(model, &def));
  assert_int_equal(found.count, 1);
  return found.turn[0].speed;
}

// One pair of turns on one side of the speed, none on the other, as near as `nearest`, m/s.
static void check_pitchfork(const bike_model *model, double capsize, double offset,
                            double nearest) {
  int with_pair = 0;
  for (double away = 1e-3; away > 0.5 * nearest; away *= 0.01) {
    for (int side = -1; side <= 1; side += 2) {
      const double speed = capsize + side * away;
      beside near = hands_free(model, speed, offset);
      if (near.count == 3 && with_pair == 0) with_pair = side;
      if (near.count != (side == with_pair ? 3 : 1))
        fail_msg("%d turns %g m/s from the capsize speed", near.count, side * away);
      check_straight(&near.turn[near.count / 2], speed, BIKE_TURN_PLAIN);
      if (near.count == 1) continue;
      const double lean = near.turn[2].lean;
      // lean^2 is in proportion to the distance, known to 1e-12 m/s
      assert_near(near.turn[0].lean, -lean, 1e-3 * lean);
      assert_near(near.turn[0].steer, -near.turn[2].steer, 1e-3 * fabs(near.turn[2].steer));
      assert_near(speed_of_lean(model, lean, offset), speed, 1e-4 * away + 1e-11);
    }
  }
  assert_int_not_equal(with_pair, 0);
}

static void turns_branch_off_riding_straight(void **state) {
  (void)state;
  for (int i = 0; i < SHIPPED_COUNT; i++) {
    bike_model model = shipped(shipped_bicycles[i].name);
    check_pitchfork(&model, capsize_speed(&model), 0, 1e-9);
  }
}

// With the rider moved back to where he was. Without symmetry nothing is exactly zero, and 1e-9 m/s
// away rounding is as large as the offset at which two turns meet.
static void a_rider_who_sits_beside_rides_straight_too(void **state) {
  (void)state;
  bike_model model = roadster(), moved = roadster_with_rider_at(0.01);
  check_pitchfork(&moved, capsize_speed(&model), -0.01, 1e-7);
}

static double smallest_eigenvalue(const bike_eigenvalues *e) {
  double smallest = INFINITY;
  for (int i = 0; i < 4; i++) smallest = fmin(smallest, hypot(e->re[i], e->im[i]));
  return smallest;
}

static void check_neutral(const bike_turns *found, double speed) {
  beside near = found_beside(found);
  assert_int_equal(near.count, 1);
  check_straight(&near.turn[0], speed, BIKE_TURN_STRAIGHT);
  assert_below(smallest_eigenvalue(&near.turn[0].eigenvalues), 1e-10);
  bike_turn mark = main_mark(found, BIKE_TURN_STRAIGHT, 0);
  assert_near(mark.speed, speed, 1e-10);
  const double rounding = 1e-4; // rad: no folds that are its work
  for (int i = 0; i < found->mark_count; i++)
    assert_true(fabs(found->marks[i].lean) + fabs(found->marks[i].steer) > rounding ||
                found->marks[i].mark == BIKE_TURN_STRAIGHT);
}

// At the speed itself, whatever its last digits, there is riding straight and nothing else.
static void the_speed_itself_is_neutral(void **state) {
  (void)state;
  static const double off[] = {0, 2e-16, -2e-16, 1e-14, 5e-12, -5e-12};
  static const bike_turn_variable zero[] = {BIKE_TURN_OFFSET, BIKE_TURN_LEAN, BIKE_TURN_STEER};
  for (int i = 0; i < SHIPPED_COUNT; i++) {
    bike_model model = shipped(shipped_bicycles[i].name);
    const double capsize = capsize_speed(&model);
    for (size_t k = 0; k < sizeof off / sizeof off[0]; k++) {
      const double speed = capsize * (1 + off[k]);
      for (int v = 0; v < (model.rider_mass > 0 ? 3 : 1); v++) {
        bike_turn_def def = turn_def(BIKE_TURN_SPEED, speed, zero[v], 0);
        check_neutral(turns_of(&model, &def), speed);
      }
    }
  }
}

// There the sign of what decides is rounding, and so differs between neighbouring numbers: all of
// them have the answer. Those of the recumbent once had none, or a place that was no turn.
static void neighbouring_numbers_agree(void **state) {
  (void)state;
  bike_model model = shipped("recumbent");
  double speed = capsize_speed(&model);
  for (int i = 0; i < 30; i++) {
    bike_turn_def def = turn_def(BIKE_TURN_SPEED, speed, BIKE_TURN_OFFSET, 0);
    check_neutral(turns_of(&model, &def), speed);
    speed = nextafter(speed, INFINITY);
  }
}

// With the rider a hair beside, one turn of the three is left beyond the fold; the cubic
// a lean + b lean^3 = offset has no square, so that its zeros add up to none.
static void a_hair_beside_there_are_three_or_one(void **state) {
  (void)state;
  bike_model model = roadster();
  const double speed = capsize_speed(&model) - 1e-4;
  bike_turn_def def = turn_def(BIKE_TURN_SPEED, speed, BIKE_TURN_OFFSET, 0);
  const bike_turns *found = turns_of(&model, &def);
  double fold = 0;
  for (int i = 0; i < found->mark_count; i++)
    if (is_beside(&found->marks[i])) fold = fmax(fold, found->marks[i].rider_offset);
  assert_true(fold > 0 && fold < 1e-6);
  beside near = hands_free(&model, speed, 0.5 * fold);
  assert_int_equal(near.count, 3);
  double sum = 0;
  for (int i = 0; i < 3; i++) {
    sum += near.turn[i].lean;
    assert_near(near.turn[i].rider_offset, 0.5 * fold, 0);
  }
  assert_near(sum, 0, 1e-5 * near.turn[2].lean);
  assert_int_equal(hands_free(&model, speed, 2 * fold).count, 1);
  assert_int_equal(hands_free(&model, speed, -2 * fold).count, 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(turns_branch_off_riding_straight),
      cmocka_unit_test(a_rider_who_sits_beside_rides_straight_too),
      cmocka_unit_test(the_speed_itself_is_neutral),
      cmocka_unit_test(neighbouring_numbers_agree),
      cmocka_unit_test(a_hair_beside_there_are_three_or_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
