// SPDX-License-Identifier: Apache-2.0
// Turns of bicycles of any size and of very unequal masses: what is true of a roadster is true of
// the similar bicycle, with speeds as the square root of the length.
#include "equations/bicycles.h"
#include "motion/bicycles.h"
#include "motion/turns.h"
#include "support/near.h"
#include <bicycle/error.h>
#include <math.h>
#include <string.h>

static bike_model model_of(const bike_bicycle *bicycle) {
  bike_model model;
  assert_int_equal(bike_model_init(&model, bicycle), BIKE_OK);
  return model;
}

static bike_bicycle scaled(const char *name, double scale) {
  bike_bicycle b = read_shipped(name);
  bike_geometry *g = &b.geometry;
  double *const lengths[] = {&g->L_r, &g->L_f, &g->L_s, &g->R_r, &g->R_f};
  for (int i = 0; i < 5; i++) *lengths[i] *= scale;
  for (int p = 0; p < b.part_count; p++) {
    for (int i = 0; i < 3; i++) b.parts[p].position[i] *= scale;
    for (int i = 0; i < 6; i++) b.parts[p].inertia[i] *= scale * scale;
  }
  return b;
}

static bike_turn_def scaled_def(const bike_turn_def *def, double scale) {
  bike_turn_def out = *def;
  out.value[BIKE_TURN_SPEED] *= sqrt(scale);
  out.value[BIKE_TURN_OFFSET] *= scale;
  out.speed_limit *= sqrt(scale);
  out.offset_limit *= scale;
  out.steer_torque *= scale;
  return out;
}

static bool is_near(double a, double b, double tolerance) {
  return fabs(a - b) <= tolerance * fmax(1, fabs(b));
}

// Turns are polished to rounding; folds, which lie flat, to its root.
static bool is_similar(const bike_turn *is, const bike_turn *should, double scale,
                       double tolerance) {
  return is_near(is->lean, should->lean, tolerance) &&
         is_near(is->steer, should->steer, tolerance) &&
         is_near(is->speed / sqrt(scale), should->speed, tolerance) &&
         is_near(is->rider_offset / scale, should->rider_offset, tolerance) &&
         is_near(is->eps_max * sqrt(scale), should->eps_max, 1e3 * tolerance) &&
         is_near(is->steer_torque / scale, should->steer_torque, tolerance) &&
         is_near(is->rear_normal, should->rear_normal, 1e3 * tolerance) &&
         is->main_family == should->main_family && is->mark == should->mark;
}

static void compare(const bike_turn *is, int is_count, const bike_turn *should, int count,
                    double scale, double tolerance) {
  assert_int_equal(is_count, count);
  for (int i = 0; i < count; i++) {
    bool found = false;
    for (int k = 0; k < count; k++) found |= is_similar(&is[k], &should[i], scale, tolerance);
    if (!found)
      fail_msg("scale %g: no turn like lean %.9g, steer %.9g, speed %.9g", scale, should[i].lean,
               should[i].steer, should[i].speed);
  }
}

static bike_turn_def with_torque(bike_turn_def def, double torque) {
  def.steer_torque = torque;
  return def;
}

static void similar_bicycles_ride_similar_turns(void **state) {
  (void)state;
  static const double scales[] = {1e-3, 0.03, 0.3, 30, 1e3};
  const char *const names[] = {"roadster", "recumbent"};
  const bike_turn_def defs[] = {
      turn_def(BIKE_TURN_SPEED, 5.5, BIKE_TURN_OFFSET, 0.01),
      turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_LEAN, 0.1),
      turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_OFFSET, 0),
      turn_def(BIKE_TURN_LEAN, 0.1, BIKE_TURN_STEER, -0.05),
      with_torque(turn_def(BIKE_TURN_SPEED, 4, BIKE_TURN_OFFSET, 0), 0.3)};
  for (size_t n = 0; n < sizeof names / sizeof names[0]; n++)
    for (size_t d = 0; d < sizeof defs / sizeof defs[0]; d++) {
      bike_bicycle usual = scaled(names[n], 1);
      bike_model model = model_of(&usual);
      bike_turn_def def = bike_turn_limits(&defs[d], &model);
      const bike_turns should = *turns_of(&model, &def);
      assert_true(should.count + should.mark_count > 0);
      for (size_t i = 0; i < sizeof scales / sizeof scales[0]; i++) {
        bike_bicycle other = scaled(names[n], scales[i]);
        bike_model similar = model_of(&other);
        bike_turn_def question = scaled_def(&def, scales[i]);
        const bike_turns *is = turns_of(&similar, &question);
        compare(is->turns, is->count, should.turns, should.count, scales[i], 1e-9);
        compare(is->marks, is->mark_count, should.marks, should.mark_count, scales[i], 1e-5);
      }
    }
}

// Units are powers of two: a bicycle four times as large is computed with the same numbers, limits
// included.
static void limits_follow_the_size(void **state) {
  (void)state;
  bike_bicycle usual = scaled("roadster", 1);
  bike_model model = model_of(&usual);
  bike_turn_def def = turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_LEAN, 0.2);
  bike_turn_def limits = bike_turn_limits(&def, &model);
  assert_near(limits.speed_limit, 50, 0);
  assert_near(limits.offset_limit, 1, 0);
  const bike_turns should = *turns_of(&model, &def);
  for (int k = -5; k <= 5; k++) {
    double scale = ldexp(1, 2 * k);
    bike_bicycle other = scaled("roadster", scale);
    bike_model similar = model_of(&other);
    limits = bike_turn_limits(&def, &similar);
    assert_near(limits.speed_limit, ldexp(50, k), 0);
    assert_near(limits.offset_limit, scale, 0);
    const bike_turns *is = turns_of(&similar, &def);
    compare(is->turns, is->count, should.turns, should.count, scale, 1e-12);
    compare(is->marks, is->mark_count, should.marks, should.mark_count, scale, 1e-9);
  }
  // numbers of the caller's stay
  def.speed_limit = 7, def.offset_limit = 0.1;
  limits = bike_turn_limits(&def, &model);
  assert_near(limits.speed_limit, 7, 0);
  assert_near(limits.offset_limit, 0.1, 0);
}

static void neighbours_are_found_at_any_size(void **state) {
  (void)state;
  for (double scale = 1e-3; scale < 2e3; scale *= 10) {
    bike_bicycle bicycle = scaled("roadster", scale);
    bike_model model = model_of(&bicycle);
    bike_turn_def at = turn_def(BIKE_TURN_SPEED, 6 * sqrt(scale), BIKE_TURN_LEAN, 0.2);
    bike_turn_def beside = turn_def(BIKE_TURN_SPEED, 6.1 * sqrt(scale), BIKE_TURN_LEAN, 0.21);
    bike_turn from = turns_of(&model, &at)->turns[0], near;
    bike_turn should = turns_of(&model, &beside)->turns[0];
    assert_int_equal(bike_turn_near(&near, &model, &beside, &from), BIKE_OK);
    assert_true(is_similar(&near, &should, 1, 1e-10));
  }
}

static double largest_acceleration(const bike_model *model, const bike_turn *turn, double beside) {
  bike_state state = {.lean = turn->lean + beside, .steer = turn->steer, .speed = turn->speed};
  bike_input input = {.rider_offset = turn->rider_offset};
  bike_acceleration a;
  assert_int_equal(bike_accelerate(&a, model, &state, &input), BIKE_OK);
  return fmax(fabs(a.lean), fabs(a.steer));
}

// A turn's accelerations are nothing beside those of the same bicycle leaned by a milliradian more.
static void are_turns(const bike_model *model, const bike_turn_def *def) {
  const bike_turns *found = turns_of(model, def);
  assert_true(found->count + found->mark_count > 0);
  for (int i = 0; i < found->count; i++) {
    double left = largest_acceleration(model, &found->turns[i], 0);
    assert_below(left, 1e-9 * largest_acceleration(model, &found->turns[i], 1e-3));
  }
}

static void ask_all(const bike_bicycle *bicycle) {
  bike_model model = model_of(bicycle);
  const bike_turn_def defs[] = {turn_def(BIKE_TURN_SPEED, 5.5, BIKE_TURN_OFFSET, 0.01),
                                turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_OFFSET, 0),
                                turn_def(BIKE_TURN_OFFSET, 0, BIKE_TURN_LEAN, 0.02)};
  for (size_t i = 0; i < sizeof defs / sizeof defs[0]; i++) are_turns(&model, &defs[i]);
}

static bike_part *part(bike_bicycle *bicycle, const char *name) {
  for (int i = 0; i < bicycle->part_count; i++)
    if (strcmp(bicycle->parts[i].name, name) == 0) return &bicycle->parts[i];
  fail_msg("no part '%s'", name);
  return NULL;
}

static void heavy_riders_on_light_forks_turn(void **state) {
  (void)state;
  for (double mass = 1e4; mass < 2e8; mass *= 100) {
    bike_bicycle bicycle = read_shipped("roadster");
    part(&bicycle, "rider")->mass = mass;
    ask_all(&bicycle);
    *part(&bicycle, "handlebar and fork") = bicycle.parts[--bicycle.part_count];
    ask_all(&bicycle);
  }
}

// A vertical steering axis through the front contact and the hub: the wheel can be turned across,
// where the bicycle turns on the spot, and the weight hardly steers.
static void upright_axes_without_trail_turn(void **state) {
  (void)state;
  for (int mm = -50; mm <= 50; mm += 25) {
    bike_bicycle bicycle = read_shipped("roadster");
    bike_part *wheel = part(&bicycle, "front wheel");
    bicycle.geometry = (bike_geometry){.L_r = wheel->position[0], .R_r = 0.34, .R_f = 0.34};
    part(&bicycle, "handlebar and fork")->position[0] = wheel->position[0] + mm / 1000.0;
    ask_all(&bicycle);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(similar_bicycles_ride_similar_turns),
      cmocka_unit_test(limits_follow_the_size),
      cmocka_unit_test(neighbours_are_found_at_any_size),
      cmocka_unit_test(heavy_riders_on_light_forks_turn),
      cmocka_unit_test(upright_axes_without_trail_turn),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
