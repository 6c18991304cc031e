// SPDX-License-Identifier: Apache-2.0
// Stationary turns: the figures of the paper's section 4 and of the literature, folds, symmetry,
// and rides that must stay where the turn says.
#include "equations/bicycles.h"
#include "motion/bicycles.h"
#include "motion/trace.h"
#include "motion/turns.h"
#include "support/near.h"
#include "support/random.h"
#include <bicycle/error.h>
#include <stdlib.h>

// Hands-free circles of the benchmark (steer in the literature's sign is the opposite): steer, lean
// and speed, computed independently of this project.
static void hands_free_circles_of_the_benchmark(void **state) {
  (void)state;
  static const double published[][3] = {{5, 0.275829694554, 5.773782597692},
                                        {10, 0.408468763281, 5.036778203565}};
  bike_model model = benchmark();
  for (int i = 0; i < 2; i++) {
    bike_turn_def def = turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_STEER, -published[i][0] * DEGREE);
    const bike_turns *found = turns_of(&model, &def);
    assert_int_equal(main_family_count(found), 1);
    assert_near(found->turns[0].lean, published[i][1], 1e-12);
    assert_near(found->turns[0].speed, published[i][2], 1e-12);
  }
}

// Where the lean over the steer of hands-free circles has its top, from the turn given: by five
// points of the curve, with differences of fourth order.
static double offset_of_vertex(const bike_model *model, const bike_turn *top) {
  const double h = 0.05 * DEGREE; // errors of h^4 and of rounding/h are both below 1e-9 deg
  double y[5];
  for (int i = 0; i < 5; i++) {
    bike_turn_def def = turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_STEER, top->steer + (i - 2) * h);
    y[i] = turns_of(model, &def)->turns[0].lean;
  }
  double slope = (y[0] - 8 * y[1] + 8 * y[3] - y[4]) / (12 * h);
  double bend = (-y[0] + 16 * y[1] - 30 * y[2] + 16 * y[3] - y[4]) / (12 * h * h);
  return -slope / bend;
}

// The family's ends: straight riding at the capsize speed, standing still at 76.76 deg, and between
// them the largest lean. At the top the lean is flat, so that six decimals of it say little of the
// steer and the speed there (4.596575794 m/s was found elsewhere, 7e-8 below ours): the place of
// the top is confirmed by the curve itself.
static void ends_of_the_hands_free_family(void **state) {
  (void)state;
  bike_model model = benchmark();
  bike_turn_def def = turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_OFFSET, 0);
  const bike_turns *found = turns_of(&model, &def);
  bike_turn rest = main_mark(found, BIKE_TURN_STATIC, 0);
  assert_near(fabs(rest.steer), 76.761443 * DEGREE, 0.5e-6 * DEGREE);
  assert_near(rest.speed, 0, 0);
  bike_turn straight = main_mark(found, BIKE_TURN_STRAIGHT, 0);
  bike_critical_speeds critical;
  assert_int_equal(bike_upright_critical_speeds(&critical, &model, 0, 20), BIKE_OK);
  assert_near(straight.speed, critical.capsize[0], 1e-12);
  bike_turn fold = main_mark(found, BIKE_TURN_LARGEST, BIKE_TURN_LEAN);
  assert_near(fold.lean, 24.069341 * DEGREE, 0.5e-6 * DEGREE);
  assert_near(fold.steer, -12.547430 * DEGREE, 0.5e-6 * DEGREE);
  assert_near(fold.speed, 4.5965759, 1e-7);
  assert_near(offset_of_vertex(&model, &fold), 0, 1e-8 * DEGREE);
}

static void check_leans(const bike_turns *found, const double *leans, int count) {
  assert_int_equal(main_family_count(found), count);
  for (int i = 0; i < count; i++) assert_near(found->turns[i].lean / DEGREE, leans[i], 0.05);
}

// Three fixed points for a small offset below the limit speed, one beyond w_max or above it.
static void fixed_points_of_the_roadster(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_turn_def def = turn_def(BIKE_TURN_SPEED, 5.5, BIKE_TURN_OFFSET, 0.01);
  check_leans(turns_of(&model, &def), (const double[]){-28.6, 9.7, 21.3}, 3);
  def = turn_def(BIKE_TURN_SPEED, 6.5, BIKE_TURN_OFFSET, 0.003);
  check_leans(turns_of(&model, &def), (const double[]){-24.4}, 1);
  for (double speed = 7.5; speed < 40; speed *= 2) {
    def = turn_def(BIKE_TURN_SPEED, speed, BIKE_TURN_OFFSET, 0.01);
    assert_int_equal(main_family_count(turns_of(&model, &def)), 1);
  }
}

// w_max(v) is a fold: two solutions meet there, and are gone beyond.
static void largest_offset_is_a_fold(void **state) {
  (void)state;
  bike_model model = roadster();
  for (double speed = 4; speed < 6.9; speed += 0.5) {
    bike_turn_def def = turn_def(BIKE_TURN_SPEED, speed, BIKE_TURN_OFFSET, 0);
    bike_turn fold = main_mark(turns_of(&model, &def), BIKE_TURN_LARGEST, BIKE_TURN_OFFSET);
    double largest = fold.rider_offset;
    if (speed == 6.5) assert_near(largest, 2.4e-3, 0.05e-3);
    // beside it the two solutions are apart by the root of what is missing
    def.value[BIKE_TURN_OFFSET] = largest * (1 - 1e-8);
    const bike_turns *below = turns_of(&model, &def);
    assert_int_equal(main_family_count(below), 3);
    assert_near(below->turns[1].lean, fold.lean, 1e-3);
    assert_near(below->turns[2].lean, fold.lean, 1e-3);
    assert_true(below->turns[1].lean < fold.lean && below->turns[2].lean > fold.lean);
    def.value[BIKE_TURN_OFFSET] = largest * (1 + 1e-8);
    assert_int_equal(main_family_count(turns_of(&model, &def)), 1);
    printf("v = %.1f m/s: w_max = %.4f mm at lean %.2f deg\n", speed, 1e3 * largest,
           fold.lean / DEGREE);
  }
}

static void check_mirrored(const bike_turn *a, const bike_turn *b) {
  assert_near(a->lean, -b->lean, 1e-11);
  assert_near(a->steer, -b->steer, 1e-11);
  assert_near(a->yaw_rate, -b->yaw_rate, 1e-10);
  assert_near(a->rider_offset, -b->rider_offset, 1e-11);
  assert_near(a->speed, b->speed, 1e-11);
  assert_near(a->eps_max, b->eps_max, 1e-7);
}

// The fold seen from the other side: with the rider at w_max(v) for good, v is the largest speed of
// the turns that lean towards him.
static void folds_in_speed_are_folds_in_offset(void **state) {
  (void)state;
  bike_model model = roadster();
  for (double speed = 5.5; speed < 6.9; speed += 0.5) {
    bike_turn_def def = turn_def(BIKE_TURN_SPEED, speed, BIKE_TURN_OFFSET, 0);
    bike_turn fold = main_mark(turns_of(&model, &def), BIKE_TURN_LARGEST, BIKE_TURN_OFFSET);
    def = turn_def(BIKE_TURN_OFFSET, fold.rider_offset, BIKE_TURN_OFFSET, fold.rider_offset);
    bike_turn other = main_mark(turns_of(&model, &def), BIKE_TURN_LARGEST, BIKE_TURN_SPEED);
    assert_near(other.speed, speed, 1e-11);
    assert_near(other.lean, fold.lean, 1e-8); // the place of a top: the root of its height's error
    assert_near(other.steer, fold.steer, 1e-8);
  }
}

// A rider with arms of a crane has more than one place for a lean and a steer; each is found again
// from its speed.
static void far_places_of_a_rider(void **state) {
  (void)state;
  bike_model model = roadster();
  int several = 0;
  for (int steer = 10; steer <= 50; steer += 5) {
    bike_turn_def def = turn_def(BIKE_TURN_LEAN, -70 * DEGREE, BIKE_TURN_STEER, steer * DEGREE);
    def.offset_limit = 100;
    const bike_turns *found = turns_of(&model, &def);
    several += found->count > 1;
    for (int i = 0; i < found->count; i++) {
      const bike_turn *t = &found->turns[i];
      bike_turn_def by_speed = turn_def(BIKE_TURN_LEAN, t->lean, BIKE_TURN_SPEED, t->speed);
      by_speed.offset_limit = 100;
      bike_turn from = *t, again;
      from.steer *= 1 + 1e-4;
      assert_int_equal(bike_turn_near(&again, &model, &by_speed, &from), BIKE_OK);
      assert_near(again.steer, t->steer, 1e-9);
      assert_near(again.rider_offset, t->rider_offset, 1e-7);
    }
  }
  assert_true(several >= 4);
}

// A symmetric bicycle in a mirror; with the torque turned too.
static void mirrored_questions_have_mirrored_answers(void **state) {
  (void)state;
  bike_model model = roadster();
  for (int i = 0; i < 3; i++) {
    bike_turn_def def = turn_def(BIKE_TURN_SPEED, 4 + i, BIKE_TURN_OFFSET, 0.004);
    def.steer_torque = 0.3 * i;
    const bike_turns *right = turns_of(&model, &def);
    def.value[BIKE_TURN_OFFSET] *= -1;
    def.steer_torque *= -1;
    const bike_turns *left = turns_of(&model, &def);
    int count = main_family_count(right);
    assert_int_equal(count, main_family_count(left));
    assert_int_equal(right->count, left->count);
    for (int k = 0; k < count; k++) check_mirrored(&right->turns[k], &left->turns[count - 1 - k]);
    for (int k = count; k < right->count; k++)
      check_mirrored(&right->turns[k], &left->turns[left->count - 1 - (k - count)]);
  }
}

// With the rider in place the turns include straight riding, with its eigenvalues; with the rider
// a hair beside it lean and steer are in proportion to the hair.
static void straight_riding_is_a_limit(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_turn_def def = turn_def(BIKE_TURN_SPEED, 6, BIKE_TURN_OFFSET, 0);
  const bike_turns *found = turns_of(&model, &def);
  assert_int_equal(main_family_count(found), 3);
  const bike_turn *straight = &found->turns[1];
  assert_near(straight->lean, 0, 0);
  assert_near(straight->steer, 0, 0);
  assert_true(isinf(straight->radius));
  bike_eigenvalues upright;
  assert_int_equal(bike_upright_eigenvalues(&upright, &model, 6), BIKE_OK);
  for (int i = 0; i < 4; i++) {
    assert_near(straight->eigenvalues.re[i], upright.re[i], 1e-12);
    assert_near(straight->eigenvalues.im[i], upright.im[i], 1e-12);
  }
  double lean[2], steer[2];
  for (int i = 0; i < 2; i++) {
    def.value[BIKE_TURN_OFFSET] = i ? 2e-6 : 1e-6;
    found = turns_of(&model, &def);
    assert_int_equal(main_family_count(found), 3);
    lean[i] = found->turns[1].lean;
    steer[i] = found->turns[1].steer;
  }
  // w = a lean + b lean^3: the cubic term is some 1e-7 of the linear one
  assert_near(lean[1] / lean[0], 2, 1e-5);
  assert_near(steer[1] / steer[0], 2, 1e-5);
}

static bike_sample ride_from(const bike_model *model, const bike_turn *turn, double push,
                             double time) {
  trace t = {0};
  bike_state start = {.lean = turn->lean + push, .steer = turn->steer, .speed = turn->speed};
  bike_ride_def def = ride_def(&t, start, time, time);
  bike_sample end = ride_end(model, &def);
  trace_free(&t);
  return end;
}

// Turns of the moved rider at offset zero are those of the offset; a stable one is kept for a
// minute, an unstable one is left at the rate of eps_max.
static void rides_confirm_turns(void **state) {
  (void)state;
  bike_model model = roadster(), moved = roadster_with_rider_at(0.01);
  bike_turn_def def = turn_def(BIKE_TURN_SPEED, 5.5, BIKE_TURN_OFFSET, 0.01);
  const bike_turns *by_offset = turns_of(&model, &def);
  def.value[BIKE_TURN_OFFSET] = 0;
  const bike_turns *by_place = turns_of(&moved, &def);
  assert_int_equal(by_offset->count, by_place->count);
  for (int i = 0; i < by_offset->count; i++) {
    assert_near(by_place->turns[i].lean, by_offset->turns[i].lean, 1e-11);
    assert_near(by_place->turns[i].eps_max, by_offset->turns[i].eps_max, 1e-7);
  }
  const bike_turn *stable = &by_place->turns[1], *unstable = &by_place->turns[2];
  assert_true(stable->eps_max < -0.1 && unstable->eps_max > 0.1);
  bike_sample end = ride_from(&moved, stable, 0, 60);
  assert_near(end.lean, stable->lean, 1e-11);
  assert_near(end.steer, stable->steer, 1e-11);
  assert_near(end.speed, stable->speed, 1e-11);
  assert_near(end.yaw, stable->yaw_rate * 60, 1e-9);
  // two rides pushed either way cancel what is even in the push; 1e-6 rad grows to 1e-3
  const double push = 1e-7, early = 16, late = 20;
  double apart[2];
  for (int i = 0; i < 2; i++) {
    double time = i ? late : early;
    apart[i] = ride_from(&moved, unstable, push, time).lean -
               ride_from(&moved, unstable, -push, time).lean;
  }
  assert_near(log(apart[1] / apart[0]) / (late - early), unstable->eps_max, 2e-4);
}

// Each pair of a turn's four variables finds it again.
static void every_pair_finds_the_turn(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_turn_def first = turn_def(BIKE_TURN_SPEED, 5.5, BIKE_TURN_OFFSET, 0.01);
  bike_turn turns[3];
  for (int i = 0; i < 3; i++) turns[i] = turns_of(&model, &first)->turns[i];
  for (int i = 0; i < 3; i++) {
    const bike_turn *t = &turns[i];
    const double value[] = {t->speed, t->lean, t->steer, t->rider_offset};
    for (int a = 0; a < BIKE_TURN_VARIABLES; a++) {
      for (int b = a + 1; b < BIKE_TURN_VARIABLES; b++) {
        bike_turn_def def =
            turn_def((bike_turn_variable)a, value[a], (bike_turn_variable)b, value[b]);
        const bike_turns *found = turns_of(&model, &def);
        double best = INFINITY;
        for (int k = 0; k < main_family_count(found); k++) {
          const bike_turn *f = &found->turns[k];
          best =
              fmin(best, fabs(f->lean - t->lean) + fabs(f->steer - t->steer) +
                             fabs(f->speed - t->speed) + fabs(f->rider_offset - t->rider_offset));
        }
        assert_below(best, 1e-10);
      }
    }
  }
}

// Newton's method from random places finds nothing that the enumeration has not.
static void random_starts_find_nothing_new(void **state) {
  (void)state;
  random_source source = random_begin("random starts", 77);
  bike_model models[] = {roadster(), penny_farthing(), benchmark()};
  int hits = 0;
  for (int i = 0; i < 12; i++) {
    const bike_model *model = &models[i % 3];
    double offset = model->rider_mass > 0 ? random_between(&source, -0.05, 0.05) : 0;
    bike_turn_def def =
        turn_def(BIKE_TURN_SPEED, random_between(&source, 0.5, 25), BIKE_TURN_OFFSET, offset);
    const bike_turns *found = turns_of(model, &def);
    for (int k = 0; k < 300; k++) {
      bike_turn near, from = {.lean = random_between(&source, -1.3, 1.3),
                              .steer = random_between(&source, -1.5, 1.5)};
      if (bike_turn_near(&near, model, &def, &from) != BIKE_OK) continue;
      if (fabs(near.lean) > def.lean_limit || fabs(near.steer) > def.steer_limit) continue;
      hits++;
      double best = INFINITY;
      for (int n = 0; n < found->count; n++)
        best = fmin(best, fabs(found->turns[n].lean - near.lean) +
                              fabs(found->turns[n].steer - near.steer));
      if (!(best < 1e-6))
        fail_msg("v = %.17g, w = %.17g: lean %.17g, steer %.17g was missed",
                 def.value[BIKE_TURN_SPEED], offset, near.lean, near.steer);
    }
  }
  printf("%d solutions met by random starts, all known\n", hits);
  assert_true(hits > 500);
}

// Figure 2's sweep: neighbours are followed, and agree with the enumeration.
static void neighbours_are_followed(void **state) {
  (void)state;
  bike_model model = roadster();
  bike_turn turn = {.speed = 5.5};
  bike_turn_def def = turn_def(BIKE_TURN_SPEED, 5.5, BIKE_TURN_LEAN, 0);
  for (int k = 0; k <= 45; k++) {
    def.value[BIKE_TURN_LEAN] = k * DEGREE;
    bike_turn next;
    assert_int_equal(bike_turn_near(&next, &model, &def, &turn), BIKE_OK);
    turn = next;
    if (k % 15 != 0) continue;
    const bike_turns *found = turns_of(&model, &def);
    assert_int_equal(main_family_count(found), 1);
    assert_near(turn.steer, found->turns[0].steer, 1e-11);
    assert_near(turn.rider_offset, found->turns[0].rider_offset, 1e-11);
  }
  // from nowhere near, an error that says what is left
  bike_turn far = {.lean = 1.2, .steer = -2}, out = {0};
  def = turn_def(BIKE_TURN_SPEED, 5.5, BIKE_TURN_STEER, -2);
  assert_int_not_equal(bike_turn_near(&out, &model, &def, &far), BIKE_OK);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hands_free_circles_of_the_benchmark),
      cmocka_unit_test(ends_of_the_hands_free_family),
      cmocka_unit_test(fixed_points_of_the_roadster),
      cmocka_unit_test(largest_offset_is_a_fold),
      cmocka_unit_test(folds_in_speed_are_folds_in_offset),
      cmocka_unit_test(far_places_of_a_rider),
      cmocka_unit_test(mirrored_questions_have_mirrored_answers),
      cmocka_unit_test(straight_riding_is_a_limit),
      cmocka_unit_test(rides_confirm_turns),
      cmocka_unit_test(every_pair_finds_the_turn),
      cmocka_unit_test(random_starts_find_nothing_new),
      cmocka_unit_test(neighbours_are_followed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
