// SPDX-License-Identifier: Apache-2.0
// Where the model ends: an error code, never a NaN; and where it does not end, an answer.
#include "bicycles.h"
#include "nine_equations.h"
#include "support/near.h"
#include <bicycle/error.h>
#include <bicycle/linear.h>
#include <bicycle/variant.h>
#include <float.h>
#include <string.h>

#define DEGREE 0.017453292519943295

static bike_model shipped_model(const char *name) {
  const bike_bicycle bicycle = read_shipped(name);
  bike_model model;
  assert_int_equal(bike_model_init(&model, &bicycle), 0);
  return model;
}

// The roadster's masses on other lengths, as on small wheels far apart, where the lengths of (4)
// are many wheel radii.
static bike_bicycle roadster_on(bike_geometry geometry) {
  bike_bicycle b = read_shipped("roadster");
  bike_upright upright;
  b.geometry = geometry;
  assert_int_equal(bike_upright_position(&upright, &b.geometry), 0);
  for (int i = 0; i < b.part_count; i++) {
    bike_part *p = &b.parts[i];
    if (p->assembly == BIKE_REAR_WHEEL) memcpy(p->position, upright.rear_hub, sizeof p->position);
    if (p->assembly == BIKE_FRONT_WHEEL) memcpy(p->position, upright.front_hub, sizeof p->position);
  }
  return b;
}

// Exactly straight riding has exactly zero accelerations, at any speed, standstill included.
static void straight_stays_straight(void **unused) {
  (void)unused;
  const double speeds[] = {0, -0.0, 1e-300, 1e-9, 0.3, 4, 6.024262015388, 100, -5};
  const bike_input none = {0};
  for (int b = 0; b < SHIPPED_COUNT; b++) {
    const bike_model model = shipped_model(shipped_bicycles[b].name);
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
      const bike_state state = {.speed = speeds[i]};
      bike_snapshot is;
      assert_int_equal(bike_evaluate(&is, &model, &state, &none), 0);
      assert_true(is.acceleration.lean == 0);
      assert_true(is.acceleration.steer == 0);
      assert_true(is.acceleration.speed == 0);
      assert_true(is.yaw_rate == 0 && is.pitch_rate == 0 && is.phi_tilde == 0 && is.psi == 0);
      bike_acceleration a;
      assert_int_equal(bike_accelerate(&a, &model, &state, &none), 0);
      assert_true(a.lean == 0 && a.steer == 0 && a.speed == 0);
    }
  }
}

// The speed is that of the rear contact point: neither the hub's, nor radius times hinge rate.
static void speed_is_that_of_the_contact_point(void **unused) {
  (void)unused;
  const bike_model model = shipped_model("benchmark");
  const double R = model.geometry.R_r;
  const bike_state state = {.lean = 0.3, .steer = 0.2, .speed = 4, .steer_rate = 0.5};
  const bike_input none = {0};
  bike_snapshot is;
  assert_int_equal(bike_evaluate(&is, &model, &state, &none), 0);
  assert_true(fabs(is.pitch_rate) > 1e-3);
  assert_near(R * (is.pitch_rate + is.rear_wheel_rate), 4, 1e-14);
  // The hub goes sideways with the lean rate (here zero) and faster by R sin(lean) yaw rate.
  assert_true(fabs(4 + R * sin(0.3) * is.yaw_rate - 4) > 0.01);
  assert_true(fabs(R * is.rear_wheel_rate - 4) > 1e-4);
}

static void numbers_that_are_none(void **unused) {
  (void)unused;
  const bike_model model = shipped_model("roadster");
  const double bad[] = {NAN, INFINITY, -INFINITY};
  for (int i = 0; i < 10; i++) {
    for (int k = 0; k < 3; k++) {
      bike_state s = {.lean = 0.1, .steer = 0.1, .speed = 5};
      bike_input in = {0};
      double *const place[10] = {&s.lean,
                                 &s.steer,
                                 &s.lean_rate,
                                 &s.steer_rate,
                                 &s.speed,
                                 &in.steer_torque,
                                 &in.roll_torque,
                                 &in.rider_offset,
                                 &in.rider_velocity,
                                 &in.rider_acceleration};
      *place[i] = bad[k];
      bike_acceleration a = {1, 2, 3};
      assert_int_equal(bike_accelerate(&a, &model, &s, &in), BIKE_ERROR_NOT_FINITE);
      assert_true(a.lean == 1 && a.steer == 2 && a.speed == 3); // untouched
      bike_snapshot is;
      bike_rates rates;
      assert_int_equal(bike_evaluate(&is, &model, &s, &in), BIKE_ERROR_NOT_FINITE);
      assert_int_equal(bike_rates_of(&rates, &model, &s, &in), BIKE_ERROR_NOT_FINITE);
    }
  }
}

static bool snapshot_is_finite(const bike_snapshot *is) {
  double all[sizeof *is / sizeof(double)];
  memcpy(all, is, sizeof *is);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    if (!isfinite(all[i])) return false;
  return true;
}

// Finite arguments whose products a double cannot hold: an error, not an infinity.
static void numbers_that_overflow(void **unused) {
  (void)unused;
  const bike_model model = shipped_model("roadster");
  int refused = 0;
  for (int exponent = 0; exponent <= 308; exponent++) {
    for (int i = 0; i < 8; i++) {
      bike_state s = {0.1, 0.1, 0.1, 0.1, 5};
      bike_input in = {0};
      double *const place[8] = {&s.lean_rate,       &s.steer_rate,         &s.speed,
                                &in.steer_torque,   &in.roll_torque,       &in.rider_offset,
                                &in.rider_velocity, &in.rider_acceleration};
      *place[i] = pow(10, exponent);
      bike_snapshot is;
      bike_acceleration a;
      bike_rates r;
      if (bike_accelerate(&a, &model, &s, &in) == 0)
        assert_true(isfinite(a.lean) && isfinite(a.steer) && isfinite(a.speed));
      if (bike_rates_of(&r, &model, &s, &in) == 0)
        assert_true(isfinite(r.yaw) && isfinite(r.rear_angle) && isfinite(r.front_angle) &&
                    isfinite(r.power));
      if (bike_evaluate(&is, &model, &s, &in) != 0)
        refused++;
      else if (!snapshot_is_finite(&is))
        fail_msg("argument %d of 1e%d gives a snapshot that is not finite", i, exponent);
    }
  }
  assert_true(refused > 0);
}

// At once: an angle of 1e12 rad is nowhere followed turn by turn.
static void many_turns(void **unused) {
  (void)unused;
  const bike_model model = shipped_model("roadster");
  const double beyond[] = {BIKE_LARGEST_ANGLE * (1 + DBL_EPSILON), 1e12, 1e300};
  for (int i = 0; i < 12; i++) {
    bike_state s = {.lean = 0.1, .steer = 0.1, .speed = 5};
    *(i % 2 ? &s.lean : &s.steer) = (i % 4 < 2 ? 1 : -1) * beyond[i / 4];
    bike_acceleration a;
    bike_snapshot is;
    bike_linear linear;
    assert_int_equal(bike_accelerate(&a, &model, &s, NULL), BIKE_ERROR_NOT_FINITE);
    assert_int_equal(bike_evaluate(&is, &model, &s, NULL), BIKE_ERROR_NOT_FINITE);
    assert_int_equal(bike_linearize(&linear, &model, &s, NULL), BIKE_ERROR_NOT_FINITE);
  }
  // a steer and the same after whole turns, too far for Newton's method from upright, are one
  // posture, to the rounding of an angle, 1e-13 rad, times slopes below 1e3
  for (int turns = -100; turns <= 99; turns++) {
    bike_state s = {.lean = 0.2, .steer = 1.1, .speed = 5};
    bike_acceleration plain, turned;
    assert_int_equal(bike_accelerate(&plain, &model, &s, NULL), 0);
    s.steer += turns * 360 * DEGREE;
    assert_int_equal(bike_accelerate(&turned, &model, &s, NULL), 0);
    assert_near(turned.lean, plain.lean, 1e-9);
    assert_near(turned.steer, plain.steer, 1e-9);
  }
}

// The slowest of some 200000 random postures without a root: the way there is given up after
// REAR_ANGLE_MOST_STEPS.
static void the_way_to_an_impossible_posture_ends(void **unused) {
  (void)unused;
  bike_bicycle b =
      roadster_on((bike_geometry){0.18324554208812194, 0.32443286507124225, -0.39704218874183866,
                                  0.17943490710618126, 0.44258588034306723});
  bike_model model;
  assert_int_equal(bike_model_init(&model, &b), 0);
  const bike_state s = {.lean = 1.4804071149839615, .steer = 2.0220504493410298, .speed = 5};
  bike_acceleration a;
  assert_int_equal(bike_accelerate(&a, &model, &s, NULL), BIKE_ERROR_GEOMETRY);
}

// No bicycle is so large, and no property of one is set to what it cannot be.
static void parts_too_large(void **unused) {
  (void)unused;
  const double large[] = {1.1e20, 1e154, 1e300, DBL_MAX};
  bike_model model;
  for (int i = 0; i < 4; i++) {
    bike_bicycle b = read_shipped("roadster"), changed;
    const char *what;
    int part;
    b.parts[1].position[2] = large[i];
    assert_int_equal(bike_model_init(&model, &b), BIKE_ERROR_NOT_FINITE);
    assert_int_equal(bike_check(&b, &part, &what), BIKE_ERROR_NOT_FINITE);
    assert_int_equal(part, 1);
    b = read_shipped("roadster");
    b.parts[0].inertia[0] = large[i] * large[i];
    assert_int_equal(bike_model_init(&model, &b), BIKE_ERROR_NOT_FINITE);
    b = read_shipped("roadster");
    for (int v = 0; v < BIKE_VARIATIONS; v++)
      assert_int_equal(bike_vary(&changed, &b, v, large[i], BIKE_FRONT_ON_AXIS),
                       BIKE_ERROR_NOT_FINITE);
    const double angles[] = {-0.1, 0, 180 * DEGREE, 432 * DEGREE, 1e20};
    for (int k = 0; k < 5; k++)
      assert_int_equal(bike_vary(&changed, &b, BIKE_VARY_HEAD_ANGLE, angles[k], i % 2),
                       BIKE_ERROR_PARAMETER);
  }
}

static void rider_input_needs_a_rider(void **unused) {
  (void)unused;
  const bike_model model = shipped_model("roadster_riderless");
  const bike_state state = {.speed = 5};
  for (int i = 0; i < 3; i++) {
    bike_input in = {0};
    double *const place[3] = {&in.rider_offset, &in.rider_velocity, &in.rider_acceleration};
    *place[i] = 0.01;
    bike_acceleration a;
    assert_int_equal(bike_accelerate(&a, &model, &state, &in), BIKE_ERROR_NO_RIDER);
  }
}

typedef struct scan {
  int answered, refused, demanded;
  double worst_root;
} scan;

// One pose of the scan. An answer must stand on the root of (4) that is connected with upright.
// Where all that the equations divide by keeps at least a twentieth of its upright size on the way,
// there must be an answer.
static void scan_pose(scan *t, const bike_bicycle *bicycle, const bike_model *model, double lean,
                      double steer) {
  const bike_state s = {lean, steer, 0.3, -0.4, 5};
  const bike_input none = {0};
  bike_snapshot is;
  int error = bike_evaluate(&is, model, &s, &none);
  real root = 0, margin = 0;
  bool connected = paper_root(&root, &margin, &bicycle->geometry, steer, lean);
  bool demanded = connected && margin > 0.05L;
  t->demanded += demanded;
  if ((error != 0 && demanded) || (error == 0 && !connected))
    fail_msg("%s: lean %g deg, steer %g deg: the library says %s, the oracle beta_r = %.17Lg with "
             "margin %.3Lg",
             bicycle->name, lean / DEGREE, steer / DEGREE, bike_error_string(error), root, margin);
  if (error != 0) {
    t->refused++;
    assert_true(error == BIKE_ERROR_GEOMETRY || error == BIKE_ERROR_SINGULAR);
    return;
  }
  t->answered++;
  assert_true(snapshot_is_finite(&is));
  double gap = fabs(is.beta_r - (double)root);
  // Round-off over a slope of at least a twentieth; near the fold of (4) the root is as soft as the
  // slope is small.
  assert_below(gap, demanded ? 1e-12 : 1e-9);
  if (demanded) t->worst_root = fmax(t->worst_root, gap);
}

static scan scan_all_poses(const bike_bicycle *bicycle) {
  const double leans[] = {-89.99, -89, -85, -80, -75, -70, -65, -60, -55, -50, -45, -40, -35,
                          -30,    -25, -20, -15, -10, -5,  0,   5,   10,  15,  20,  25,  30,
                          35,     40,  45,  50,  55,  60,  65,  70,  75,  80,  85,  89,  89.99};
  bike_model model;
  assert_int_equal(bike_model_init(&model, bicycle), 0);
  scan t = {0};
  for (size_t i = 0; i < sizeof leans / sizeof *leans; i++)
    for (double steer = -179; steer <= 179; steer += 4)
      scan_pose(&t, bicycle, &model, leans[i] * DEGREE, steer * DEGREE);
  printf("%-19s %d answered, %d refused, %d demanded; root within %.1e\n", bicycle->name,
         t.answered, t.refused, t.demanded, t.worst_root);
  return t;
}

static void whole_range_of_lean_and_steer(void **unused) {
  (void)unused;
  for (int b = 0; b < SHIPPED_COUNT; b++) {
    const bike_bicycle bicycle = read_shipped(shipped_bicycles[b].name);
    const scan t = scan_all_poses(&bicycle);
    assert_true(t.refused > 0 && t.demanded > 0);
  }
}

static bike_bicycle on_small_wheels(double wheelbase, double radius) {
  bike_bicycle b = roadster_on(bike_geometry_from_wheelbase(wheelbase, 0.05, 0.4, radius, radius));
  snprintf(b.name, sizeof b.name, "wheels of %g m", radius);
  return b;
}

static void small_wheels(void **unused) {
  (void)unused;
  const double shapes[][2] = {{1.2, 0.03}, {2, 0.09}, {2.5, 0.15}, {2.5, 0.2}};
  for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
    const bike_bicycle bicycle = on_small_wheels(shapes[i][0], shapes[i][1]);
    const scan t = scan_all_poses(&bicycle);
    assert_true(t.demanded > 0);
  }
}

// A legitimate steady turn of the benchmark at walking pace: steer 76.8 degrees.
static void steep_steer_is_answered(void **unused) {
  (void)unused;
  const bike_model model = shipped_model("benchmark");
  const bike_input none = {0};
  for (double lean = -10; lean <= 10; lean += 5) {
    const bike_state s = {.lean = lean * DEGREE, .steer = 76.8 * DEGREE, .speed = 1};
    bike_snapshot is;
    assert_int_equal(bike_evaluate(&is, &model, &s, &none), 0);
    assert_true(snapshot_is_finite(&is));
  }
}

static void impossible_poses_are_refused(void **unused) {
  (void)unused;
  const bike_model model = shipped_model("benchmark");
  const bike_input none = {0};
  const double poses[][2] = {{89.99, 120}, {90, 0}, {90, 30}, {-90, 10}, {120, 0}, {180, 0}};
  for (size_t i = 0; i < sizeof poses / sizeof *poses; i++) {
    const bike_state s = {.lean = poses[i][0] * DEGREE, .steer = poses[i][1] * DEGREE, .speed = 5};
    bike_acceleration a;
    int error = bike_accelerate(&a, &model, &s, &none);
    if (error != BIKE_ERROR_GEOMETRY && error != BIKE_ERROR_SINGULAR)
      fail_msg("lean %g steer %g: %s", poses[i][0], poses[i][1], bike_error_string(error));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(straight_stays_straight),
      cmocka_unit_test(speed_is_that_of_the_contact_point),
      cmocka_unit_test(numbers_that_are_none),
      cmocka_unit_test(numbers_that_overflow),
      cmocka_unit_test(many_turns),
      cmocka_unit_test(the_way_to_an_impossible_posture_ends),
      cmocka_unit_test(parts_too_large),
      cmocka_unit_test(rider_input_needs_a_rider),
      cmocka_unit_test(whole_range_of_lean_and_steer),
      cmocka_unit_test(small_wheels),
      cmocka_unit_test(steep_steer_is_answered),
      cmocka_unit_test(impossible_poses_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
