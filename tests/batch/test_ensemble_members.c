// SPDX-License-Identifier: Apache-2.0
// A member's result depends on the member alone; errors of members, counts, progress, definitions.
#include "batch/lanes_support.h"
#include "support/near.h"
#include <bicycle/error.h>
#include <pthread.h>
#include <string.h>

static const double DEGREE = M_PI / 180;

enum { COUNT = 100 };

typedef struct crowd {
  bike_model models[SHIPPED_COUNT];
  bike_model lopsided[COUNT];
  bike_member members[COUNT];
} crowd;

static crowd all;

// Bicycles, starts and inputs of all kinds, wrong ones among them. Large angles show a sine that is
// computed in another manner because of a neighbour.
static void make_crowd(void) {
  random_source source = random_begin("crowd", 90021);
  for (int k = 0; k < SHIPPED_COUNT; k++) all.models[k] = shipped_model(k);
  for (int i = 0; i < COUNT; i++) {
    int which = i % SHIPPED_COUNT;
    random_range range = shipped_bicycles[which].range;
    bike_member *m = &all.members[i];
    *m = (bike_member){.model = &all.models[which]};
    if (i % 9 == 4) {
      all.lopsided[i] = random_model(&source);
      m->model = &all.lopsided[i];
      range.lean = range.steer = 20 * DEGREE;
    }
    m->start = random_state(&source, &range);
    if (i % 4 == 1) m->input.steer_torque = random_between(&source, -3, 3);
    if (i % 4 == 2) m->input.roll_torque = random_between(&source, -9, 9);
    if (m->model->rider_mass > 0) m->input.rider_offset = random_between(&source, -0.1, 0.1);
    if (i % 10 == 7) m->start.speed = 0;
    if (i == 30) m->start.steer = NAN;
    if (i == 41) m->start.lean = 1e300;
    if (i == 52) m->start.steer = 150 * DEGREE;
  }
}

static bike_ensemble_def definition(void) {
  bike_ensemble_def def = bike_default_ensemble_def();
  def.duration = 2;
  return def;
}

static void order_and_company_mean_nothing(void **unused) {
  (void)unused;
  static bike_member_result together[COUNT], other[COUNT];
  static bike_member members[COUNT];
  make_crowd();
  bike_ensemble_def def = definition();
  ride_members(together, all.members, COUNT, &def);
  for (size_t i = 0; i < COUNT; i++) { // alone
    ride_members(other, &all.members[i], 1, &def);
    assert_same_result(&other[0], &together[i], "alone");
  }
  for (size_t by = 3; by < COUNT; by += 30) { // another order: 7 has no divisor in common with 100
    for (size_t i = 0; i < COUNT; i++) members[(7 * i + by) % COUNT] = all.members[i];
    ride_members(other, members, COUNT, &def);
    for (size_t i = 0; i < COUNT; i++)
      assert_same_result(&other[(7 * i + by) % COUNT], &together[i], "another order");
  }
}

static void counts_and_threads_mean_nothing(void **unused) {
  (void)unused;
  static bike_member_result together[COUNT], other[COUNT + 1];
  const size_t counts[] = {0, 1, 7, 9, COUNT};
  const int threads[] = {1, 2, 5};
  make_crowd();
  bike_ensemble_def def = definition();
  ride_members(together, all.members, COUNT, &def);
  for (int k = 0; k < 5; k++)
    for (int t = 0; t < 3; t++) {
      def.threads = threads[t];
      memset(other, 0x5a, sizeof other);
      ride_members(other, all.members, counts[k], &def);
      for (size_t i = 0; i < counts[k]; i++) assert_same_result(&other[i], &together[i], "threads");
      bike_member_result untouched;
      memset(&untouched, 0x5a, sizeof untouched);
      assert_memory_equal(&other[counts[k]], &untouched, sizeof untouched);
    }
}

// What goes wrong with a member is told in its result, as bike_ride says it.
static void errors_of_members(void **unused) {
  (void)unused;
  bike_model roadster = named_model("roadster"), benchmark = named_model("benchmark");
  assert_true(benchmark.rider_mass == 0);
  bike_model penny_farthing = named_model("penny_farthing");
  const bike_member members[] = {
      {.model = &roadster, .start = {.lean = 0.1, .speed = 5}},
      {.model = &roadster, .start = {.lean = NAN, .speed = 5}},
      {.model = &penny_farthing, .start = {.lean = 1.3, .steer = 1.5, .speed = 2}},
      {.model = &benchmark, .start = {.lean = 0.1, .speed = 5}, .input = {.rider_offset = 0.1}},
      {.model = &roadster, .start = {.speed = INFINITY}},
      {.model = &roadster, .start = {.speed = 5}, .input = {.steer_torque = NAN}},
      {.model = &roadster, .start = {.lean = 81 * DEGREE, .speed = 5}},
      {.model = &benchmark, .start = {.lean = 0.1, .speed = 5}},
  };
  enum { COUNT_HERE = sizeof members / sizeof *members };
  const int errors[COUNT_HERE] = {[1] = BIKE_ERROR_NOT_FINITE,
                                  [2] = BIKE_ERROR_GEOMETRY,
                                  [3] = BIKE_ERROR_NO_RIDER,
                                  [4] = BIKE_ERROR_NOT_FINITE,
                                  [5] = BIKE_ERROR_NOT_FINITE};
  for (int plain = 0; plain < 2; plain++) {
    bike_member_result results[COUNT_HERE];
    bike_ensemble_def def = definition();
    def.plain = plain;
    ride_members(results, members, COUNT_HERE, &def);
    for (int i = 0; i < COUNT_HERE; i++) {
      assert_int_equal(results[i].error, errors[i]);
      assert_int_equal(results[i].outcome == BIKE_OUTCOME_ERROR, errors[i] != 0);
    }
    assert_int_equal(results[6].outcome, BIKE_OUTCOME_LEAN_LIMIT); // has fallen already
    assert_true(results[6].time == 0);
  }
}

typedef struct told {
  pthread_t caller;
  int calls, strangers;
  double last;
  bool falls;
} told;

static void note_progress(double done, void *user) {
  told *t = user;
  t->strangers += !pthread_equal(t->caller, pthread_self());
  t->falls |= !(done > t->last && done <= 1);
  t->last = done;
  t->calls++;
}

// Many times: which thread takes the first member and does the last is chance.
static void progress_rises_to_one(void **unused) {
  (void)unused;
  static bike_member_result results[COUNT];
  const size_t counts[] = {0, 1, 9, COUNT};
  make_crowd();
  bike_ensemble_def def = definition();
  def.duration = 0.1;
  def.progress = note_progress;
  for (int k = 0; k < 200; k++) {
    told t = {.caller = pthread_self()};
    def.plain = k % 8 == 0;
    def.threads = 1 + k % 5;
    def.user = &t;
    ride_members(results, all.members, counts[k % 4], &def);
    assert_int_equal(t.strangers, 0);
    assert_false(t.falls);
    assert_true(t.last == 1);
    if (def.threads == 1) assert_true(t.calls >= (int)counts[k % 4]);
  }
}

static void definitions_out_of_range(void **unused) {
  (void)unused;
  bike_model model = named_model("roadster");
  bike_member member = {.model = &model, .start = {.speed = 5}};
  bike_member_result result;
  const bike_ensemble_def good = definition();
  enum { WRONG = 23 };
  bike_ensemble_def wrong[WRONG];
  for (int i = 0; i < WRONG; i++) wrong[i] = good;
  double durations[] = {0, -1, NAN, INFINITY, 1e9};
  double tolerances[] = {0, 1e-16, NAN, INFINITY};
  double limits[] = {0, -1, NAN, 1.5708};
  int n = 0;
  for (int i = 0; i < 5; i++) wrong[n++].duration = durations[i];
  for (int i = 0; i < 4; i++) wrong[n++].rtol = tolerances[i];
  for (int i = 0; i < 4; i++) wrong[n++].lean_limit = limits[i];
  wrong[n++].atol = 0;
  wrong[n++].atol = -1e-9;
  wrong[n++].atol = NAN;
  wrong[n++].atol = INFINITY;
  wrong[n++].settled = -1e-9;
  wrong[n++].settled = NAN;
  wrong[n++].settled = INFINITY;
  wrong[n++].threads = 0;
  wrong[n++].threads = -1;
  wrong[n++].threads = 257;
  assert_int_equal(n, WRONG);
  assert_int_equal(bike_ensemble_ride(&result, &member, 1, &good), BIKE_OK);
  for (int i = 0; i < WRONG; i++)
    if (bike_ensemble_ride(&result, &member, 1, &wrong[i]) != BIKE_ERROR_ARGUMENT)
      fail_msg("definition %d is taken", i);
  assert_int_equal(bike_ensemble_ride(NULL, &member, 1, &good), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_ensemble_ride(&result, NULL, 1, &good), BIKE_ERROR_ARGUMENT);
  assert_int_equal(bike_ensemble_ride(&result, &member, 1, NULL), BIKE_ERROR_ARGUMENT);
  bike_member bad = member;
  bad.model = NULL;
  assert_int_equal(bike_ensemble_ride(&result, &bad, 1, &good), BIKE_ERROR_ARGUMENT);
  bad = member;
  bad.input.rider_velocity = 0.1;
  assert_int_equal(bike_ensemble_ride(&result, &bad, 1, &good), BIKE_ERROR_ARGUMENT);
  bad = member;
  bad.input.rider_acceleration = NAN;
  assert_int_equal(bike_ensemble_ride(&result, &bad, 1, &good), BIKE_ERROR_ARGUMENT);
}

static void outcomes_have_names(void **unused) {
  (void)unused;
  for (int i = 0; i < BIKE_OUTCOMES; i++)
    for (int j = 0; j < i; j++)
      assert_string_not_equal(bike_outcome_string(i), bike_outcome_string(j));
  assert_string_equal(bike_outcome_string(BIKE_OUTCOME_LEAN_LIMIT), "lean limit");
  assert_string_equal(bike_outcome_string(BIKE_OUTCOMES), "unknown");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(order_and_company_mean_nothing),
      cmocka_unit_test(counts_and_threads_mean_nothing),
      cmocka_unit_test(errors_of_members),
      cmocka_unit_test(progress_rises_to_one),
      cmocka_unit_test(definitions_out_of_range),
      cmocka_unit_test(outcomes_have_names),
  };
  return cmocka_run_group_tests(tests, print_instructions, NULL);
}
