// SPDX-License-Identifier: Apache-2.0
// Rides in lanes against rides one after the other: what becomes of them, when, and where.
#include "batch/lanes_support.h"
#include "batch/plain_ride.h"
#include "support/near.h"
#include <bicycle/error.h>
#include <float.h>

static const double DEGREE = M_PI / 180;

enum { MOST = 1024 };

typedef struct crowd {
  int count;
  bike_model models[SHIPPED_COUNT];
  bike_member members[MOST];
} crowd;

static crowd all;

static void add(const bike_model *model, bike_state start, bike_input input) {
  assert_true(all.count < MOST);
  all.members[all.count++] = (bike_member){.model = model, .start = start, .input = input};
}

static void begin(void) {
  all.count = 0;
  for (int k = 0; k < SHIPPED_COUNT; k++) all.models[k] = shipped_model(k);
}

static bike_ensemble_def definition(double duration) {
  bike_ensemble_def def = bike_default_ensemble_def();
  def.duration = duration;
  def.rtol = def.atol = 1e-12; // so that little more than the steps' errors tells the paths apart
  def.settled = 0.02;
  return def;
}

// The members in lanes and one by one; how many ended in which manner. Next to none may lie where a
// nudge changes the manner.
static void compare(const bike_ensemble_def *def, int seen[BIKE_OUTCOMES]) {
  static bike_member_result results[MOST];
  int blurred = 0;
  long steps = 0, steps_plain = 0;
  ride_members(results, all.members, (size_t)all.count, def);
  for (int i = 0; i < all.count; i++) {
    plain_ride plain = ride_plain(&all.members[i], def);
    seen[plain.result.outcome]++;
    steps += results[i].steps;
    steps_plain += plain.result.steps;
    if (plain.sharp)
      assert_like_plain(&results[i], &plain);
    else
      blurred++;
  }
  print_message("%d rides, %d blurred, %ld steps (plain %ld):", all.count, blurred, steps,
                steps_plain);
  for (int k = 0; k < BIKE_OUTCOMES; k++) print_message(" %d %s", seen[k], bike_outcome_string(k));
  print_message("\n");
  assert_true(blurred * 50 <= all.count);
  // the same method to the same tolerance; looking for ends costs a few dozen short steps
  assert_true(steps <= 3 * steps_plain);
}

static const double leans[] = {-30 * DEGREE, 0.5 * DEGREE, 13 * DEGREE, 44 * DEGREE};
static const double steers[] = {-40 * DEGREE, -2 * DEGREE, 21 * DEGREE};

static void add_grid(int which, double speed, bike_input input) {
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 3; j++)
      add(&all.models[which], (bike_state){.lean = leans[i], .steer = steers[j], .speed = speed},
          input);
}

// From backwards to fast: the roadster rides straight by itself at 5.8 m/s, the benchmark at 5.
static void hands_off(void **unused) {
  (void)unused;
  const double speeds[] = {-3, 0.05, 2, 5, 5.8, 9};
  int seen[BIKE_OUTCOMES] = {0};
  begin();
  for (int which = 0; which < SHIPPED_COUNT; which++)
    for (int k = 0; k < 6; k++) add_grid(which, speeds[k], (bike_input){0});
  bike_ensemble_def def = definition(2.5);
  compare(&def, seen);
  for (int k = 0; k < BIKE_OUTCOME_ERROR; k++) assert_true(seen[k] > 3);
}

// A start at rest has no standstill: the wheels roll to and fro while it falls.
static void starts_at_rest(void **unused) {
  (void)unused;
  int seen[BIKE_OUTCOMES] = {0};
  begin();
  for (int which = 0; which < SHIPPED_COUNT; which++) add_grid(which, 0, (bike_input){0});
  bike_ensemble_def def = definition(4);
  compare(&def, seen);
  assert_int_equal(seen[BIKE_OUTCOME_STANDSTILL], 0);
  assert_true(seen[BIKE_OUTCOME_LEAN_LIMIT] > 10);
}

// Long enough that some come to rest on the straight, where looks, their number in a row, and time
// must be counted alike.
static void rides_that_settle(void **unused) {
  (void)unused;
  int seen[BIKE_OUTCOMES] = {0};
  begin();
  for (int i = 0; i < 30; i++) {
    bike_state start = {.lean = i * 0.4 * DEGREE, .steer_rate = 0.01 * i, .speed = 5.75};
    add(&all.models[0], start, (bike_input){0});
    start.speed = 5;
    add(&all.models[2], start, (bike_input){0});
  }
  bike_ensemble_def def = definition(15);
  compare(&def, seen);
  assert_true(seen[BIKE_OUTCOME_SETTLED] > 20);
}

// The 21st look, at 1 s, is the end of the ride too.
static void settled_at_the_very_end(void **unused) {
  (void)unused;
  const double durations[] = {0.95, 1, 1.01, 1.05};
  for (int k = 0; k < 4; k++) {
    begin();
    add(&all.models[0], (bike_state){.lean = 1e-3, .speed = 5.8}, (bike_input){0});
    bike_ensemble_def def = definition(durations[k]);
    int seen[BIKE_OUTCOMES] = {0};
    compare(&def, seen);
    assert_int_equal(seen[k == 0 ? BIKE_OUTCOME_COMPLETE : BIKE_OUTCOME_SETTLED], 1);
  }
}

static void constant_inputs(void **unused) {
  (void)unused;
  const bike_input inputs[] = {{.steer_torque = 0.3},
                               {.steer_torque = -2},
                               {.roll_torque = 4},
                               {.roll_torque = -25},
                               {.rider_offset = 0.02},
                               {.rider_offset = -0.08},
                               {.steer_torque = 0.5, .roll_torque = -3, .rider_offset = 0.03}};
  int seen[BIKE_OUTCOMES] = {0};
  begin();
  for (int k = 0; k < 7; k++)
    for (int which = 0; which < SHIPPED_COUNT; which++)
      for (int i = 0; i < 4; i++) {
        if (inputs[k].rider_offset != 0 && all.models[which].rider_mass == 0) continue;
        bike_state start = {.lean = 0.02 * i, .steer = -0.01 * i, .speed = 2.0 * i + 0.5};
        add(&all.models[which], start, inputs[k]);
      }
  bike_ensemble_def def = definition(4);
  compare(&def, seen);
}

// A narrow lean limit, an odd duration, no looks: every stop by itself.
static void other_definitions(void **unused) {
  (void)unused;
  int seen[BIKE_OUTCOMES] = {0};
  begin();
  for (int which = 0; which < SHIPPED_COUNT; which++) add_grid(which, 4, (bike_input){0});
  bike_ensemble_def def = definition(1.2345);
  def.lean_limit = 31 * DEGREE;
  compare(&def, seen);
  def.settled = 0;
  def.watch_lift = false;
  compare(&def, seen);
  def.duration = 0.01; // one step
  compare(&def, seen);
  def.duration = 2; // down to lying flat, where the equations end
  def.lean_limit = M_PI / 2;
  compare(&def, seen);
  assert_true(seen[BIKE_OUTCOME_LEAN_LIMIT] > 20 && seen[BIKE_OUTCOME_COMPLETE] > 20);
}

// Speeds whose squares are still numbers, and those whose are not.
static void extreme_starts(void **unused) {
  (void)unused;
  const double speeds[] = {1e-300, 1e-12, 300, 1e5};
  int seen[BIKE_OUTCOMES] = {0};
  begin();
  for (int k = 0; k < 4; k++) add_grid(0, speeds[k], (bike_input){0});
  bike_ensemble_def def = definition(0.1);
  compare(&def, seen);
}

// No step can be as accurate as is asked here: lanes hand over in mid-ride, and the plain path says
// so. Time and state are those at which it was.
static void handed_over_in_mid_ride(void **unused) {
  (void)unused;
  static bike_member_result results[MOST];
  int late = 0;
  begin();
  for (int i = 0; i < 24; i++) {
    bike_state start = {.lean = 0.01 * i, .lean_rate = 0.2, .speed = 5.8};
    add(&all.models[0], start, (bike_input){0});
  }
  bike_ensemble_def def = definition(0.5);
  def.rtol = 4 * DBL_EPSILON;
  def.atol = 1e-300;
  ride_members(results, all.members, (size_t)all.count, &def);
  for (int i = 0; i < all.count; i++) {
    const bike_member_result *r = &results[i];
    if (r->outcome != BIKE_OUTCOME_ERROR) continue;
    assert_int_equal(r->error, BIKE_ERROR_SOLVER);
    if (!(r->time > 0)) continue;
    bike_ensemble_def usual = definition(r->time);
    plain_ride there = ride_plain(&all.members[i], &usual);
    there.result.outcome = BIKE_OUTCOME_ERROR;
    there.result.error = BIKE_ERROR_SOLVER;
    assert_like_plain(r, &there);
    late++;
  }
  print_message("%d of %d break off in mid-ride\n", late, all.count);
  assert_true(late > 0);
}

// A damper so stiff that steps get nowhere: lanes give it up, and the plain path says so.
static void rides_that_get_nowhere_end(void **unused) {
  (void)unused;
  bike_member_result results[2];
  begin();
  all.models[0].steer_damping = 1e7;
  for (int i = 0; i < 2; i++)
    add(&all.models[i], (bike_state){.lean_rate = 0.2, .speed = 5.8}, (bike_input){0});
  bike_ensemble_def def = definition(60);
  ride_members(results, all.members, 2, &def);
  assert_int_equal(results[0].outcome, BIKE_OUTCOME_ERROR);
  assert_int_equal(results[0].error, BIKE_ERROR_SOLVER);
  assert_true(results[0].steps < 100000 && results[0].time < 1);
  assert_int_equal(results[1].error, 0); // the neighbour
}

typedef struct lowest {
  double force; // N  on either wheel
  double since; // s  the last time both were on the ground
  double aloft; // s  the longest time that one was not
} lowest;

static int note_force(const bike_sample *s, const bike_sample_more *more, void *user) {
  (void)more;
  lowest *low = user;
  double force = fmin(s->rear_normal, s->front_normal);
  low->force = fmin(low->force, force);
  if (force >= 0) low->since = s->time;
  low->aloft = fmax(low->aloft, s->time - low->since);
  return 0;
}

static lowest trace_lifts(const bike_member *member, double duration) {
  lowest low = {.force = INFINITY};
  bike_ride_def def = bike_default_ride_def();
  bike_ride_result result;
  def.start = member->start;
  def.duration = duration;
  def.sample = 1e-3;
  def.on_sample = note_force;
  def.user = &low;
  assert_int_equal(bike_ride(&result, member->model, &def), BIKE_OK);
  low.force = fmin(low.force, fmin(result.end.rear_normal, result.end.front_normal));
  return low;
}

// Both at the same steps' ends: a wheel that is off the ground for longer than a step is seen, one
// that never is is not.
static void lifts(void **unused) {
  (void)unused;
  static bike_member_result results[MOST];
  const double longest_step = 0.1; // s; below half of it at these tolerances
  int lifted = 0, grounded = 0;
  begin();
  for (int which = 0; which < SHIPPED_COUNT; which++)
    for (int k = 0; k < 3; k++) add_grid(which, 3.0 * k + 1, (bike_input){0});
  bike_ensemble_def def = definition(1.5);
  def.settled = 0;
  ride_members(results, all.members, (size_t)all.count, &def);
  for (int i = 0; i < all.count; i++) {
    lowest low = trace_lifts(&all.members[i], def.duration);
    if (low.force > 0) assert_false(results[i].lifted);
    if (low.aloft > longest_step) assert_true(results[i].lifted);
    grounded += low.force > 0;
    lifted += low.aloft > longest_step;
  }
  print_message("%d rides, %d lift, %d never do\n", all.count, lifted, grounded);
  assert_true(lifted > 10 && grounded > 50);
  def.watch_lift = false;
  ride_members(results, all.members, (size_t)all.count, &def);
  for (int i = 0; i < all.count; i++) assert_false(results[i].lifted);
}

// Either wheel by itself, at the start of a ride of one step.
static void each_wheel_is_watched(void **unused) {
  (void)unused;
  static bike_member_result results[MOST];
  random_source source = random_begin("wheels", 90023);
  begin();
  for (int i = 0; i < MOST; i++) {
    random_range range = shipped_bicycles[i % SHIPPED_COUNT].range;
    range.rate = 8;
    add(&all.models[i % SHIPPED_COUNT], random_state(&source, &range), (bike_input){0});
  }
  bike_ensemble_def def = definition(1e-5);
  ride_members(results, all.members, MOST, &def);
  int rear_alone = 0, front_alone = 0, neither = 0;
  for (int i = 0; i < MOST; i++) {
    bike_snapshot now;
    const bike_member *m = &all.members[i];
    assert_int_equal(bike_evaluate(&now, m->model, &m->start, NULL), BIKE_OK);
    bool rear = now.rear_force[2] < 0, front = now.front_force[2] < 0;
    assert_int_equal(results[i].lifted, rear || front);
    rear_alone += rear && !front;
    front_alone += front && !rear;
    neither += !rear && !front;
  }
  print_message("%d lift the rear wheel alone, %d the front wheel alone, %d none\n", rear_alone,
                front_alone, neither);
  assert_true(rear_alone > 20 && front_alone > 20 && neither > 20);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hands_off),
      cmocka_unit_test(starts_at_rest),
      cmocka_unit_test(rides_that_settle),
      cmocka_unit_test(settled_at_the_very_end),
      cmocka_unit_test(constant_inputs),
      cmocka_unit_test(other_definitions),
      cmocka_unit_test(extreme_starts),
      cmocka_unit_test(lifts),
      cmocka_unit_test(handed_over_in_mid_ride),
      cmocka_unit_test(rides_that_get_nowhere_end),
      cmocka_unit_test(each_wheel_is_watched),
  };
  return cmocka_run_group_tests(tests, print_instructions, NULL);
}
