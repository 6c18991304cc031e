// SPDX-License-Identifier: Apache-2.0
// The library's Kane equations against the paper's nine equations (18)-(22) and its (23),
// corrected.
#include "bicycles.h"
#include "nine_equations.h"
#include "oracle_gap.h"
#include "support/near.h"

enum { STATES = 1000 };

static bool has_rider(const bike_bicycle *bicycle) {
  for (int i = 0; i < bicycle->part_count; i++)
    if (bicycle->parts[i].rider) return true;
  return false;
}

static bike_input random_torques(random_source *source) {
  return (bike_input){.steer_torque = random_between(source, -5, 5),
                      .roll_torque = random_between(source, -50, 50)};
}

static void add_sway(bike_input *input, random_source *source) {
  input->rider_offset = random_between(source, -0.1, 0.1);
  input->rider_velocity = random_between(source, -1, 1);
  input->rider_acceleration = random_between(source, -5, 5);
}

static void check_shipped(const char *test, bool torques, bool sway) {
  random_source source = random_begin(test, 19900116);
  for (int b = 0; b < SHIPPED_COUNT; b++) {
    const bike_bicycle bicycle = read_shipped(shipped_bicycles[b].name);
    bike_model model;
    assert_int_equal(bike_model_init(&model, &bicycle), 0);
    if (sway && !has_rider(&bicycle)) continue;
    oracle_gap gap = {0};
    while (gap.states < STATES) {
      bike_state state = random_state(&source, &shipped_bicycles[b].range);
      bike_input input = torques ? random_torques(&source) : (bike_input){0};
      if (sway) add_sway(&input, &source);
      oracle_gap_add(&gap, &bicycle, &model, &state, &input);
      assert_true(gap.no_geometry < STATES);
    }
    oracle_gap_judge(&gap, shipped_bicycles[b].name);
  }
}

static void hands_off(void **unused) {
  (void)unused;
  check_shipped(__func__, false, false);
}

static void with_torques(void **unused) {
  (void)unused;
  check_shipped(__func__, true, false);
}

static void with_swaying_rider(void **unused) {
  (void)unused;
  check_shipped(__func__, true, true);
}

static void check_random(const char *test, bool symmetric) {
  enum { BICYCLES = 300, EACH = 5 };
  // Drawn with less lean and steer than shipped ones: an arbitrary geometry may end earlier.
  const random_range range = {0.6, 0.6, 2, 1, 10};
  random_source source = random_begin(test, 20070808);
  oracle_gap gap = {0};
  for (int b = 0; b < BICYCLES; b++) {
    const bike_bicycle bicycle = random_bicycle(&source, symmetric);
    bike_model model;
    assert_int_equal(bike_model_init(&model, &bicycle), 0);
    for (int s = 0; s < EACH; s++) {
      bike_state state = random_state(&source, &range);
      bike_input input = random_torques(&source);
      add_sway(&input, &source);
      oracle_gap_add(&gap, &bicycle, &model, &state, &input);
    }
  }
  assert_true(gap.states > BICYCLES * EACH * 9 / 10);
  oracle_gap_judge(&gap, symmetric ? "random symmetric" : "random asymmetric");
}

static void random_symmetric_bicycles(void **unused) {
  (void)unused;
  check_random(__func__, true);
}

static void random_asymmetric_bicycles(void **unused) {
  (void)unused;
  check_random(__func__, false);
}

// (10) is the derivative of (9), and (12) is rolling without slip.
static void check_kinematics(const paper_motion *m, double speed) {
  for (int k = 0; k < m->part_count; k++) {
    real gap = vec_norm(vec_sub(m->part[k].derived, m->part[k].acceleration));
    assert_below((double)gap, 1e-15 * (1 + (double)vec_norm(m->part[k].acceleration)));
  }
  vec rolling = vec_scale(m->e_R_front, m->front_speed.v);
  rolling.c[1] -= speed;
  real slip = vec_norm(vec_sub(rolling, m->front_contact_rate));
  assert_below((double)slip, 1e-15 * (1 + speed)); // long double: round-off is 1e-19
}

// What the oracle rests on: its equations fit together, and (23) holds with p' - G but not as
// printed with p' + G.
static void corrections_hold_together(void **unused) {
  (void)unused;
  random_source source = random_begin(__func__, 1990);
  const bike_bicycle bicycle = read_shipped("roadster");
  double corrected = 0, printed = INFINITY;
  for (int i = 0; i < STATES; i++) {
    bike_state state = random_state(&source, &shipped_bicycles[0].range);
    bike_input input = random_torques(&source);
    add_sway(&input, &source);
    nine_solution n;
    assert_true(nine_solve(&n, &bicycle, &state, &input));
    check_kinematics(&n.motion, state.speed);
    double right = (double)equation_23(&bicycle, &state, &input, &n.motion, -1);
    assert_below(right, 1e-13); // long double: no more than 1e-15 was seen
    corrected = fmax(corrected, right);
    printed = fmin(printed, (double)equation_23(&bicycle, &state, &input, &n.motion, 1));
  }
  printf("(23), of its terms: corrected at most %.1e, as printed at least %.1e\n", corrected,
         printed);
  assert_true(printed > 1e-6);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(corrections_hold_together),
      cmocka_unit_test(hands_off),
      cmocka_unit_test(with_torques),
      cmocka_unit_test(with_swaying_rider),
      cmocka_unit_test(random_symmetric_bicycles),
      cmocka_unit_test(random_asymmetric_bicycles),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
