// SPDX-License-Identifier: Apache-2.0
// How exact rides in lanes are: energy over long rides, the order of the method, basins.
#include "batch/lanes_support.h"
#include "support/near.h"
#include <bicycle/basin.h>
#include <bicycle/cycle.h>
#include <bicycle/error.h>

static const double DEGREE = M_PI / 180;

static double energy(const bike_model *model, const bike_state *state) {
  bike_snapshot now;
  assert_int_equal(bike_evaluate(&now, model, state, NULL), BIKE_OK);
  return now.kinetic + now.potential;
}

// Hands off and undamped: by less than 1e-13 a second, as a single ride at this tolerance is meant
// to keep it.
static void energy_is_kept(void **unused) {
  (void)unused;
  enum { COUNT = 12 };
  const char *const names[] = {"roadster", "benchmark"};
  const double speeds[] = {5.8, 4.8, 5, 4.2}; // to rest on the straight; around a limit cycle
  bike_model models[2];
  bike_member members[COUNT];
  bike_member_result results[COUNT];
  for (int k = 0; k < 2; k++) models[k] = named_model(names[k]);
  for (int i = 0; i < COUNT; i++) {
    bike_state start = {.lean = (1 + i / 4) * DEGREE, .speed = speeds[i % 4]};
    members[i] = (bike_member){.model = &models[i % 4 / 2], .start = start};
  }
  bike_ensemble_def def = bike_default_ensemble_def();
  def.duration = 60;
  def.rtol = def.atol = 1e-13;
  def.settled = 0;
  ride_members(results, members, COUNT, &def);
  int complete = 0;
  double worst = 0;
  for (int i = 0; i < COUNT; i++) {
    const bike_member_result *r = &results[i];
    double before = energy(members[i].model, &members[i].start);
    double drift = fabs(energy(members[i].model, &r->end) / before - 1);
    assert_below(drift, 1e-13 * fmax(1, r->time));
    complete += r->outcome == BIKE_OUTCOME_COMPLETE;
    worst = fmax(worst, drift);
  }
  print_message("%d of %d ride for 60 s; energy drifts by %.2g at most\n", complete, COUNT, worst);
  assert_true(complete >= 6);
}

enum { RIDES = 40 };

// The mean of the logarithms of the errors at the end, against single rides at 1e-14; steps of all.
static double mean_error(long *steps, const bike_member *members, const bike_member_result *exact,
                         double rtol) {
  bike_member_result results[RIDES];
  bike_ensemble_def def = bike_default_ensemble_def();
  double sum = 0;
  def.duration = 2;
  def.rtol = def.atol = rtol;
  def.settled = 0;
  ride_members(results, members, RIDES, &def);
  *steps = 0;
  for (int i = 0; i < RIDES; i++) {
    const bike_state *a = &results[i].end, *b = &exact[i].end;
    assert_int_equal(results[i].outcome, BIKE_OUTCOME_COMPLETE);
    sum += log10(fabs(a->lean - b->lean) + fabs(a->steer - b->steer) +
                 fabs(a->lean_rate - b->lean_rate) + fabs(a->steer_rate - b->steer_rate) + 1e-16);
    *steps += results[i].steps;
  }
  return sum / RIDES;
}

// Errors at the end go with the error allowed per step, and steps with its eighth root: order 8(7).
static void errors_fall_with_the_tolerance(void **unused) {
  (void)unused;
  bike_model model = named_model("roadster");
  bike_member members[RIDES];
  bike_member_result exact[RIDES];
  random_source source = random_begin("tolerances", 90031);
  const random_range range = {5 * DEGREE, 5 * DEGREE, 0.3, 5, 6};
  for (int i = 0; i < RIDES; i++)
    members[i] = (bike_member){.model = &model, .start = random_state(&source, &range)};
  bike_ensemble_def def = bike_default_ensemble_def();
  def.duration = 2;
  def.rtol = def.atol = 1e-14;
  def.settled = 0;
  def.plain = true;
  ride_members(exact, members, RIDES, &def);
  long steps[4];
  double errors[4];
  for (int k = 0; k < 4; k++) {
    double rtol = pow(10, -5 - 2 * k);
    errors[k] = mean_error(&steps[k], members, exact, rtol);
    print_message("rtol %.0e: error 1e%.2f, %ld steps\n", rtol, errors[k], steps[k]);
    // riding is stable, so that errors die out: at the end a tenth of what one step may err by;
    // half of it where the error of the steering rate goes unseen
    assert_true(errors[k] < log10(rtol) - 0.5);
    if (k == 0) continue;
    assert_near(errors[k - 1] - errors[k], 2, 0.5);
    // 100^(1/8) = 1.78, less where the search for the first steps counts; of order 4: 2.5
    double more = (double)steps[k] / (double)steps[k - 1];
    assert_true(more > 1.3 && more < 1.9);
  }
}

enum { SIDE = 13 };

// The fates of a grid by the plain path, as basin.h describes them.
static bike_fate plain_fate(const bike_model *model, const bike_basin_def *def, double lean,
                            double steer) {
  bike_member member = {.model = model, .start = {.lean = lean, .steer = steer}};
  if (bike_speed_of_equal_energy(&member.start.speed, model, &member.start, def->speed))
    return BIKE_FATE_NO_START;
  bike_ensemble_def ride = bike_default_ensemble_def();
  bike_member_result r;
  ride.duration = def->duration;
  ride.settled = def->settled;
  ride.plain = true;
  ride_members(&r, &member, 1, &ride);
  assert_int_equal(r.error, BIKE_OK);
  if (r.outcome == BIKE_OUTCOME_SETTLED) return r.lifted ? BIKE_FATE_LIFTED : BIKE_FATE_STRAIGHT;
  return r.outcome == BIKE_OUTCOME_COMPLETE ? BIKE_FATE_RIDING : BIKE_FATE_FALLEN;
}

// At speeds at which riding straight is stable. A start next to the edge between two fates may fall
// on either side: one in a hundred.
static void basins_are_those_of_single_rides(void **unused) {
  (void)unused;
  const char *const names[] = {"roadster", "benchmark", "roadster_riderless"};
  const double speeds[] = {5.8, 5, 5.8};
  int seen[BIKE_FATES] = {0}, differ = 0;
  for (int n = 0; n < 3; n++) {
    bike_model model = named_model(names[n]);
    double leans[SIDE], steers[SIDE];
    bike_fate fates[SIDE * SIDE];
    for (int i = 0; i < SIDE; i++) {
      leans[i] = (i - 5.5) * 13 * DEGREE;
      steers[i] = (i - 6.5) * 13 * DEGREE;
    }
    bike_basin_def def = bike_default_basin_def();
    def.speed = speeds[n];
    def.leans = leans;
    def.steers = steers;
    def.lean_count = def.steer_count = SIDE;
    def.duration = 20;
    def.threads = 2;
    assert_int_equal(bike_basin(fates, &model, &def), BIKE_OK);
    for (int k = 0; k < SIDE * SIDE; k++) {
      double lean = leans[k % SIDE], steer = steers[k / SIDE];
      bike_fate want = plain_fate(&model, &def, lean, steer), alone;
      assert_int_equal(bike_fate_of(&alone, NULL, &model, &def, lean, steer), BIKE_OK);
      assert_int_equal(alone, fates[k]);
      seen[want]++;
      if (fates[k] == want) continue;
      print_message("%s, lean %g deg, steer %g deg: %s, alone %s\n", names[n], lean / DEGREE,
                    steer / DEGREE, bike_fate_string(fates[k]), bike_fate_string(want));
      differ++;
    }
  }
  for (int k = 0; k < BIKE_FATES; k++) print_message("%d %s ", seen[k], bike_fate_string(k));
  print_message("\n");
  assert_true(differ <= 5);
  assert_true(seen[BIKE_FATE_STRAIGHT] > 10 && seen[BIKE_FATE_FALLEN] > 10 &&
              seen[BIKE_FATE_NO_START] > 10);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(energy_is_kept),
      cmocka_unit_test(errors_fall_with_the_tolerance),
      cmocka_unit_test(basins_are_those_of_single_rides),
  };
  return cmocka_run_group_tests(tests, print_instructions, NULL);
}
