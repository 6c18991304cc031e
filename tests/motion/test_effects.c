// SPDX-License-Identifier: Apache-2.0
// Variations and sensitivities: against differences of the kernel's own critical speeds, against
// dimensional analysis, and uncertainties against sampling.
#include "equations/bicycles.h"
#include "support/near.h"
#include "support/random.h"
#include <bicycle/effects.h>
#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <bicycle/turn.h>
#include <string.h>

static const double LOW = 0.5, HIGH = 40; // m/s

static bike_model model_of(const bike_bicycle *bicycle) {
  bike_model model;
  assert_int_equal(bike_model_init(&model, bicycle), BIKE_OK);
  return model;
}

typedef struct speeds {
  double weave, capsize;
} speeds;

static speeds speeds_of(const bike_bicycle *bicycle) {
  bike_critical_speeds found;
  bike_model model = model_of(bicycle);
  assert_int_equal(bike_upright_critical_speeds(&found, &model, LOW, HIGH), BIKE_OK);
  return (speeds){found.weave_count ? found.weave[0] : NAN,
                  found.capsize_count ? found.capsize[0] : NAN};
}

static bike_effects effects_of(const bike_bicycle *bicycle, const bike_meijaard *literature) {
  bike_effects effects;
  assert_int_equal(bike_effects_find(&effects, bicycle, literature, LOW, HIGH), BIKE_OK);
  return effects;
}

static bike_meijaard benchmark_symbols(void) {
  bike_file file;
  char path[512];
  snprintf(path, sizeof path, "%s/model/benchmark/benchmark.yml", BICYCLE_SOURCE_DIR);
  assert_int_equal(bike_file_read(&file, path, NULL), BIKE_OK);
  assert_true(file.has_meijaard);
  return file.meijaard;
}

static speeds speeds_of_symbols(const double value[BIKE_MEIJAARD_COUNT]) {
  bike_bicycle bicycle;
  assert_int_equal(bike_from_meijaard(&bicycle, value), BIKE_OK);
  return speeds_of(&bicycle);
}

// Five-point differences of the kernel's speeds: their error is some 1e-10 of the speed over the
// step.
static void symbols_match_differences(void **state) {
  (void)state;
  bike_meijaard symbols = benchmark_symbols();
  bike_bicycle benchmark = read_shipped("benchmark");
  bike_effects effects = effects_of(&benchmark, &symbols);
  assert_int_equal(effects.count, BIKE_MEIJAARD_COUNT + 1); // the damper too
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; i++) {
    double h = 1e-3 * fmax(fabs(symbols.value[i]), 0.01);
    speeds at[5];
    for (int k = -2; k <= 2; k++) {
      double moved[BIKE_MEIJAARD_COUNT];
      memcpy(moved, symbols.value, sizeof moved);
      moved[i] += k * h;
      at[k + 2] = speeds_of_symbols(moved);
    }
    const bike_parameter *p = &effects.parameters[i];
    double weave = (at[0].weave - 8 * at[1].weave + 8 * at[3].weave - at[4].weave) / (12 * h);
    double capsize =
        (at[0].capsize - 8 * at[1].capsize + 8 * at[3].capsize - at[4].capsize) / (12 * h);
    assert_string_equal(p->name, bike_meijaard_symbols()[i]);
    assert_near(p->weave, weave, 1e-7 * (1 + fabs(weave)));
    assert_near(p->capsize, capsize, 1e-7 * (1 + fabs(capsize)));
  }
}

// What a change of units does to a speed, by the unit of a parameter: powers of length, mass, time.
typedef struct dimension {
  const char *unit;
  int length, mass, time;
} dimension;

static dimension dimension_of(const char *unit) {
  static const dimension all[] = {{"m", 1, 0, 0},          {"rad", 0, 0, 0}, {"m/s^2", 1, 0, -2},
                                  {"N m s/rad", 2, 1, -1}, {"kg", 0, 1, 0},  {"kg m^2", 2, 1, 0}};
  for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
    if (strcmp(unit, all[i].unit) == 0) return all[i];
  fail_msg("unit '%s'", unit);
  return all[0];
}

// A speed is a length over a time: by Euler's theorem the sums of power * value * derivative are v,
// 0 and -v. Exact, so only rounding is allowed.
static void check_dimensions(const bike_bicycle *bicycle, double tolerance) {
  bike_effects e = effects_of(bicycle, NULL);
  double weave[3] = {0}, capsize[3] = {0};
  for (int i = 0; i < e.count; i++) {
    const bike_parameter *p = &e.parameters[i];
    dimension d = dimension_of(p->unit);
    const int power[3] = {d.length, d.mass, d.time};
    for (int k = 0; k < 3; k++) {
      weave[k] += power[k] * p->value * p->weave;
      capsize[k] += power[k] * p->value * p->capsize;
    }
  }
  const int of_speed[3] = {1, 0, -1};
  for (int k = 0; k < 3; k++) {
    if (!isnan(e.weave)) assert_near(weave[k], of_speed[k] * e.weave, tolerance * e.weave);
    if (!isnan(e.capsize)) assert_near(capsize[k], of_speed[k] * e.capsize, tolerance * e.capsize);
  }
}

static void dimensions_agree(void **state) {
  (void)state;
  // cancelling sums of some twenty terms up to a hundred times the speed
  for (int i = 0; i < SHIPPED_COUNT; i++) {
    bike_bicycle bicycle = read_shipped(shipped_bicycles[i].name);
    check_dimensions(&bicycle, 1e-10);
  }
  random_source source = random_begin("dimensions", 77);
  for (int i = 0; i < 20; i++) {
    bike_bicycle bicycle = random_bicycle(&source, true);
    bicycle.steer_damping = i % 2 ? random_between(&source, 0, 2) : 0;
    check_dimensions(&bicycle, 1e-8); // near double roots speeds are steep
  }
}

static bike_bicycle varied(const bike_bicycle *from, bike_variation variation, double value,
                           bike_front_hold hold) {
  bike_bicycle out;
  assert_int_equal(bike_vary(&out, from, variation, value, hold), BIKE_OK);
  return out;
}

static double present(const bike_bicycle *bicycle, bike_variation variation) {
  double value;
  assert_int_equal(bike_variation_value(&value, bicycle, variation), BIKE_OK);
  return value;
}

static void variation_slopes_match_differences(void **state) {
  (void)state;
  bike_bicycle roadster = read_shipped("roadster");
  roadster.steer_damping = 0.3; // so that it can be varied both ways
  speeds now = speeds_of(&roadster);
  for (int v = 0; v < BIKE_VARIATIONS; v++) {
    for (int hold = 0; hold < 2; hold++) {
      double weave, capsize, h = 1e-4, value = present(&roadster, (bike_variation)v);
      assert_int_equal(bike_variation_slope(&weave, &capsize, &roadster, (bike_variation)v,
                                            (bike_front_hold)hold, now.weave, now.capsize),
                       BIKE_OK);
      bike_bicycle up = varied(&roadster, (bike_variation)v, value + h, (bike_front_hold)hold);
      bike_bicycle down = varied(&roadster, (bike_variation)v, value - h, (bike_front_hold)hold);
      speeds above = speeds_of(&up), below = speeds_of(&down);
      // the differences err by h^2 times a third derivative of some hundred
      assert_near(weave, (above.weave - below.weave) / (2 * h), 2e-5);
      assert_near(capsize, (above.capsize - below.capsize) / (2 * h), 2e-5);
      assert_near(present(&up, (bike_variation)v), v == BIKE_VARY_RIDER_FORWARD ? 0 : value + h,
                  1e-14);
    }
  }
}

// Where a part of the front frame is relative to the steering axis: before it, and along it from
// the foot of the perpendicular from the front hub; and its inertia about the axis' direction.
typedef struct on_axis {
  double across, along, theta;
} on_axis;

static on_axis place_on_axis(const bike_bicycle *b, const char *name) {
  bike_upright u;
  assert_int_equal(bike_upright_position(&u, &b->geometry), BIKE_OK);
  for (int i = 0; i < b->part_count; i++) {
    const bike_part *p = &b->parts[i];
    if (strcmp(p->name, name) != 0) continue;
    double s = sin(u.tilt), c = cos(u.tilt);
    double x = p->position[0] - u.front_hub[0], z = p->position[2] - u.front_hub[2];
    return (on_axis){x * c + z * s + b->geometry.L_f, -x * s + z * c,
                     s * s * p->inertia[0] + c * c * p->inertia[2] - 2 * s * c * p->inertia[4]};
  }
  fail_msg("no part '%s'", name);
  return (on_axis){0};
}

static void what_is_held_is_held(void **state) {
  (void)state;
  static const char bar[] = "handlebar and fork";
  bike_bicycle roadster = read_shipped("roadster");
  on_axis before = place_on_axis(&roadster, bar);
  const struct {
    bike_variation variation;
    double value;
  } changes[] = {{BIKE_VARY_TRAIL, 0.03}, {BIKE_VARY_HEAD_ANGLE, 60 * M_PI / 180}};
  for (int i = 0; i < 2; i++) {
    bike_bicycle moved =
        varied(&roadster, changes[i].variation, changes[i].value, BIKE_FRONT_ON_AXIS);
    bike_bicycle still =
        varied(&roadster, changes[i].variation, changes[i].value, BIKE_FRONT_IN_SPACE);
    bike_upright u;
    assert_int_equal(bike_upright_position(&u, &moved.geometry), BIKE_OK);
    assert_near(u.wheelbase, 1.11, 1e-14);
    assert_near(u.trail, i == 0 ? 0.03 : 0.07, 1e-14);
    assert_near(u.tilt, i == 0 ? 22 * M_PI / 180 : 30 * M_PI / 180, 1e-14);
    on_axis after = place_on_axis(&moved, bar);
    assert_near(after.across, before.across, 1e-14);
    assert_near(after.along, before.along, 1e-14);
    assert_near(after.theta, before.theta, 1e-14);
    for (int k = 0; k < roadster.part_count; k++) {
      assert_memory_equal(still.parts[k].position, roadster.parts[k].position,
                          sizeof still.parts[k].position);
      assert_memory_equal(still.parts[k].inertia, roadster.parts[k].inertia,
                          sizeof still.parts[k].inertia);
    }
    assert_true(fabs(place_on_axis(&still, bar).across - before.across) > 1e-3);
  }
}

// Sentences of the paper's section 4, on this project's roadster.
static void sentences_of_section_4(void **state) {
  (void)state;
  bike_bicycle roadster = read_shipped("roadster");
  speeds now = speeds_of(&roadster);
  bike_bicycle b = varied(&roadster, BIKE_VARY_STEERING_INERTIA, 0.15, BIKE_FRONT_IN_SPACE);
  assert_true(speeds_of(&b).weave > now.weave + 0.1); // the lower limit alone is raised
  assert_near(speeds_of(&b).capsize, now.capsize, 1e-11);
  b = varied(&roadster, BIKE_VARY_RIDER_FORWARD, 0.05, BIKE_FRONT_IN_SPACE);
  assert_true(speeds_of(&b).weave > now.weave && speeds_of(&b).capsize > now.capsize);
  // without the front wheel's spin it is stable from 12.84 m/s on
  b = varied(&roadster, BIKE_VARY_FRONT_WHEEL_INERTIA, 0, BIKE_FRONT_IN_SPACE);
  assert_near(speeds_of(&b).weave, 12.84, 0.005);
  assert_true(isnan(speeds_of(&b).capsize));
  // upper limit ~ Theta^-1/2 for small Theta
  b = varied(&roadster, BIKE_VARY_WHEEL_INERTIA, 0.2e-2, BIKE_FRONT_IN_SPACE);
  bike_critical_speeds found;
  bike_model model = model_of(&b);
  assert_int_equal(bike_upright_critical_speeds(&found, &model, 0, 200), BIKE_OK);
  double small = found.capsize[0];
  b = varied(&roadster, BIKE_VARY_WHEEL_INERTIA, 0.8e-2, BIKE_FRONT_IN_SPACE);
  model = model_of(&b);
  assert_int_equal(bike_upright_critical_speeds(&found, &model, 0, 200), BIKE_OK);
  printf("limits at a quarter of the inertia: %.4f times as fast\n", small / found.capsize[0]);
  assert_relative(small / found.capsize[0], 2.0, 0.02);
}

// A normal deviate (Box, Muller).
static double normal(random_source *source) {
  return sqrt(-2 * log(1 - random_between(source, 0, 1))) *
         cos(2 * M_PI * random_between(source, 0, 1));
}

static void uncertainty_matches_sampling(void **state) {
  (void)state;
  enum { SAMPLES = 4000 };
  bike_meijaard symbols = benchmark_symbols();
  bike_bicycle benchmark = read_shipped("benchmark");
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; i++) symbols.sigma[i] = 2e-3 * fabs(symbols.value[i]);
  bike_effects effects = effects_of(&benchmark, &symbols);
  random_source source = random_begin("uncertainty", 2013);
  double sum[2] = {0}, squares[2] = {0};
  for (int n = 0; n < SAMPLES; n++) {
    double drawn[BIKE_MEIJAARD_COUNT];
    for (int i = 0; i < BIKE_MEIJAARD_COUNT; i++)
      drawn[i] = symbols.value[i] + symbols.sigma[i] * normal(&source);
    speeds v = speeds_of_symbols(drawn);
    const double off[2] = {v.weave - effects.weave, v.capsize - effects.capsize};
    for (int k = 0; k < 2; k++) {
      sum[k] += off[k];
      squares[k] += off[k] * off[k];
    }
  }
  const double sigma[2] = {effects.weave_sigma, effects.capsize_sigma};
  for (int k = 0; k < 2; k++) {
    double mean = sum[k] / SAMPLES, spread = sqrt(squares[k] / SAMPLES - mean * mean);
    printf("uncertainty: first order %.5f m/s, sampled %.5f\n", sigma[k], spread);
    // four standard errors of a sampled spread, 1/sqrt(2 N) each
    assert_relative(spread, sigma[k], 4 / sqrt(2.0 * SAMPLES));
  }
}

static void lean_per_offset_matches_turns(void **state) {
  (void)state;
  bike_bicycle roadster = read_shipped("roadster");
  bike_model model = model_of(&roadster);
  const double offset = 1e-6; // the next term is of the order of its square
  double slope;
  assert_int_equal(bike_lean_per_offset(&slope, &model, 5.5), BIKE_OK);
  bike_turn_def def = bike_default_turn_def();
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_OFFSET] = true;
  def.value[BIKE_TURN_SPEED] = 5.5;
  def.value[BIKE_TURN_OFFSET] = offset;
  bike_turn straight = {.speed = 5.5}, turn;
  assert_int_equal(bike_turn_near(&turn, &model, &def, &straight), BIKE_OK);
  assert_relative(turn.lean / offset, slope, 1e-7);
}

static void impossible_questions_are_refused(void **state) {
  (void)state;
  bike_bicycle roadster = read_shipped("roadster"), benchmark = read_shipped("benchmark"), out;
  bike_effects effects;
  double value, other;
  assert_int_equal(bike_vary(&out, &benchmark, BIKE_VARY_RIDER_FORWARD, 0.1, BIKE_FRONT_IN_SPACE),
                   BIKE_ERROR_NO_RIDER);
  assert_int_equal(bike_vary(&out, &roadster, BIKE_VARY_STEER_DAMPING, -1, BIKE_FRONT_IN_SPACE),
                   BIKE_ERROR_PARAMETER);
  assert_int_equal(bike_vary(&out, &roadster, BIKE_VARY_TRAIL, NAN, BIKE_FRONT_IN_SPACE),
                   BIKE_ERROR_NOT_FINITE);
  assert_int_equal(bike_vary(&out, &roadster, BIKE_VARIATIONS, 1, BIKE_FRONT_IN_SPACE),
                   BIKE_ERROR_ARGUMENT);
  assert_int_equal(
      bike_vary(&out, &roadster, BIKE_VARY_STEERING_INERTIA, -0.1, BIKE_FRONT_IN_SPACE),
      BIKE_ERROR_PARAMETER);
  assert_int_equal(bike_variation_value(NULL, &roadster, BIKE_VARY_TRAIL), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_effects_find(&effects, &roadster, NULL, 5, 5), BIKE_ERROR_ARGUMENT);
  bike_model model = model_of(&benchmark);
  assert_int_equal(bike_lean_per_offset(&value, &model, 5), BIKE_ERROR_NO_RIDER);
  // no such speed: no slope
  assert_int_equal(bike_variation_slope(&value, &other, &roadster, BIKE_VARY_TRAIL,
                                        BIKE_FRONT_IN_SPACE, NAN, 6.985),
                   BIKE_OK);
  assert_true(isnan(value) && !isnan(other));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(symbols_match_differences),
      cmocka_unit_test(dimensions_agree),
      cmocka_unit_test(variation_slopes_match_differences),
      cmocka_unit_test(what_is_held_is_held),
      cmocka_unit_test(sentences_of_section_4),
      cmocka_unit_test(uncertainty_matches_sampling),
      cmocka_unit_test(lean_per_offset_matches_turns),
      cmocka_unit_test(impossible_questions_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
