// SPDX-License-Identifier: Apache-2.0
// Four threads and two ensembles at once, under the thread sanitizer where it is to be had: no
// race, and to the last bit what one thread alone computes.
#include "support/near.h"
#include <bicycle/ensemble.h>
#include <bicycle/error.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

enum { COUNT = 60 };

// The benchmark's lengths with a plain frame, rider and fork; no file need be read.
static bike_model make_model(void) {
  bike_bicycle b = bike_default_bicycle();
  b.geometry = bike_geometry_from_wheelbase(1.02, 0.08, 0.3, 0.3, 0.35);
  const bike_part parts[] = {
      {.assembly = BIKE_REAR_WHEEL,
       .mass = 2,
       .position = {0, 0, 0.3},
       .inertia = {0.06, 0.12, 0.06}},
      {.assembly = BIKE_FRONT_WHEEL,
       .mass = 3,
       .position = {1.02, 0, 0.35},
       .inertia = {0.14, 0.28, 0.14}},
      {.assembly = BIKE_REAR_FRAME,
       .rider = true,
       .mass = 85,
       .position = {0.3, 0, 0.9},
       .inertia = {9.2, 11, 2.8, 0, 2.4, 0}},
      {.assembly = BIKE_FRONT_FRAME,
       .mass = 4,
       .position = {0.9, 0, 0.7},
       .inertia = {0.059, 0.06, 0.008, 0, -0.0076, 0}},
  };
  for (int i = 0; i < 4; i++) {
    b.parts[i] = parts[i];
    snprintf(b.parts[i].name, sizeof b.parts[i].name, "part %d", i);
  }
  b.part_count = 4;
  bike_model model;
  assert_int_equal(bike_model_init(&model, &b), BIKE_OK);
  return model;
}

// Some that the lanes ride to all ends, some that the plain path does: a wheel turned round, no
// geometry.
static void make_members(bike_member members[COUNT], const bike_model *model) {
  for (int i = 0; i < COUNT; i++) {
    bike_state start = {.lean = 0.02 * (i % 12), .steer = 0.05 * (i % 7), .speed = i % 9};
    if (i % 13 == 5) start.steer = 2.5;
    if (i % 13 == 7) start.lean = NAN;
    members[i] = (bike_member){.model = model, .start = start};
    if (i % 3 == 0) members[i].input.rider_offset = 0.02;
  }
}

typedef struct run {
  const bike_member *members;
  int threads;
  int calls; // of progress
  bike_member_result results[COUNT];
} run;

static void note_progress(double done, void *user) {
  (void)done;
  ((run *)user)->calls++; // a race where another thread calls it
}

static void *take_run(void *user) {
  run *r = user;
  bike_ensemble_def def = bike_default_ensemble_def();
  def.duration = 3;
  def.threads = r->threads;
  def.progress = note_progress;
  def.user = r;
  return bike_ensemble_ride(r->results, r->members, COUNT, &def) ? NULL : r;
}

static void threads_are_bitwise_serial(void **unused) {
  (void)unused;
  static run serial, threaded[2];
  static bike_member members[COUNT];
  pthread_t thread[2];
  bike_model model = make_model();
  make_members(members, &model);
  for (int i = 0; i < 2; i++) threaded[i] = (run){.members = members, .threads = 4};
  for (int i = 0; i < 2; i++) // first, so that they also decide on the instructions at once
    assert_int_equal(pthread_create(&thread[i], NULL, take_run, &threaded[i]), 0);
  void *done[2] = {NULL};
  for (int i = 0; i < 2; i++) assert_int_equal(pthread_join(thread[i], &done[i]), 0);
  serial = (run){.members = members, .threads = 1};
  assert_non_null(take_run(&serial));
  for (int i = 0; i < 2; i++) {
    assert_non_null(done[i]);
    assert_true(threaded[i].calls >= 1);
    for (int k = 0; k < COUNT; k++) {
      const bike_member_result *a = &threaded[i].results[k], *b = &serial.results[k];
      assert_int_equal(a->outcome, b->outcome);
      assert_int_equal(a->steps, b->steps);
      assert_memory_equal(&a->time, &b->time, sizeof a->time);
      assert_memory_equal(&a->end, &b->end, sizeof a->end);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(threads_are_bitwise_serial)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
