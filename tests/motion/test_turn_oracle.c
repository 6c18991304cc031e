// SPDX-License-Identifier: Apache-2.0
// Every turn of every bicycle is stationary in the nine equations (18)-(22), which share no line
// with the library.
#include "equations/bicycles.h"
#include "equations/nine_equations.h"
#include "motion/turns.h"
#include "support/near.h"
#include <bicycle/error.h>

typedef struct tally {
  int turns, marks, stable;
  double worst;
} tally;

// The oracle's accelerations at a turn, rad/s^2 and m/s^2; in tight fast turns, where forces are
// many times the weight, as a share of that.
static double oracle_residual(const bike_bicycle *bicycle, const bike_turn *t) {
  bike_state state = {.lean = t->lean, .steer = t->steer, .speed = t->speed};
  bike_input input = {.steer_torque = t->steer_torque, .rider_offset = t->rider_offset};
  nine_solution nine;
  assert_true(nine_solve(&nine, bicycle, &state, &input));
  double a = fmax(fmax(fabs((double)nine.acceleration.phi), fabs((double)nine.acceleration.kappa)),
                  fabs((double)nine.acceleration.v));
  return a / fmax(1, fabs(t->yaw_rate * t->speed) / bicycle->gravity);
}

static void judge(tally *sum, const bike_bicycle *bicycle, const bike_turn *turn) {
  double residual = oracle_residual(bicycle, turn);
  assert_below(residual, 1e-11);
  sum->worst = fmax(sum->worst, residual);
  sum->stable += turn->eps_max < 0;
  assert_near(turn->eps_max, turn->eigenvalues.re[0], 0);
}

static void judge_all(tally *sum, const bike_bicycle *bicycle, const bike_model *model,
                      const bike_turn_def *def) {
  const bike_turns *found = turns_of(model, def);
  for (int i = 0; i < found->count; i++) judge(sum, bicycle, &found->turns[i]);
  for (int i = 0; i < found->mark_count; i++) judge(sum, bicycle, &found->marks[i]);
  sum->turns += found->count;
  sum->marks += found->mark_count;
}

static void report(const tally *sum, const char *name) {
  printf("%s: %d turns, %d folds and ends, %d stable: %.2g at most\n", name, sum->turns, sum->marks,
         sum->stable, sum->worst);
}

static void check_bicycle(const bike_bicycle *bicycle, const char *name, double torque) {
  bike_model model;
  assert_int_equal(bike_model_init(&model, bicycle), BIKE_OK);
  const double speeds[] = {1, 3, 5.5, 9};
  tally sum = {0};
  for (int i = 0; i < 4; i++) {
    double offset = model.rider_mass > 0 ? 0.003 * i : 0;
    bike_turn_def def = turn_def(BIKE_TURN_SPEED, speeds[i], BIKE_TURN_OFFSET, offset);
    def.steer_torque = torque;
    judge_all(&sum, bicycle, &model, &def);
    def = turn_def(BIKE_TURN_STEER, -0.1 * (i + 1), BIKE_TURN_OFFSET, offset);
    def.steer_torque = torque;
    judge_all(&sum, bicycle, &model, &def);
  }
  report(&sum, name);
  assert_true(sum.turns >= 8);
}

static void every_shipped_bicycle(void **state) {
  (void)state;
  for (int i = 0; i < SHIPPED_COUNT; i++) {
    bike_bicycle bicycle = read_shipped(shipped_bicycles[i].name);
    check_bicycle(&bicycle, bicycle.name, 0);
  }
}

static void steer_torque_held(void **state) {
  (void)state;
  bike_bicycle bicycle = read_shipped("roadster");
  check_bicycle(&bicycle, "roadster, 1 N m", 1);
}

static void random_bicycles(void **state) {
  (void)state;
  random_source source = random_begin("turns of random bicycles", 303);
  for (int i = 0; i < 16; i++) {
    bike_bicycle bicycle = random_bicycle(&source, i % 2 == 0);
    bike_model model;
    assert_int_equal(bike_model_init(&model, &bicycle), BIKE_OK);
    tally sum = {0};
    double offset = random_between(&source, -0.02, 0.02), speed = random_between(&source, 2, 8);
    bike_turn_def def = turn_def(BIKE_TURN_SPEED, speed, BIKE_TURN_OFFSET, offset);
    judge_all(&sum, &bicycle, &model, &def);
    def = turn_def(BIKE_TURN_SPEED, speed, BIKE_TURN_LEAN, 0.2);
    judge_all(&sum, &bicycle, &model, &def);
    def = turn_def(BIKE_TURN_STEER, -0.15, BIKE_TURN_LEAN, 0.2);
    judge_all(&sum, &bicycle, &model, &def);
    report(&sum, i % 2 ? "random, crooked" : "random, symmetric");
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_shipped_bicycle),
      cmocka_unit_test(steer_torque_held),
      cmocka_unit_test(random_bicycles),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
