// SPDX-License-Identifier: Apache-2.0
// Several threads, models and mjData at once, under the thread sanitizer where it is to be had:
// no race, and bitwise what one thread alone computes.
#include "rolling_support.h"

#include <pthread.h>

enum { MODELS = 4, RUNS = 2 * MODELS, STEPS = 200, MOST_STATE = 32 };

typedef struct run {
  const mjModel *m;
  mjtNum lean_rate;
  mjtNum state[MOST_STATE];
} run;

// A ride that asks for its discs and sensors on the way. NULL where something is refused.
static void *take_run(void *argument) {
  run *r = argument;
  roll_disc disc[MOST_DISCS];
  mjData *d = mj_makeData(r->m);
  mj_resetDataKeyframe(r->m, d, 0);
  d->qvel[4] = r->lean_rate;
  int fine = roll_project(r->m, d) == ROLL_OK;
  for (int i = 0; fine && i < STEPS; i++) {
    mj_step(r->m, d);
    if (i % 10 == 0) mj_forward(r->m, d);
    if (i % 10 == 0) fine = roll_discs(disc, roll_disc_count(r->m), r->m, d) == ROLL_OK;
  }
  mju_copy(r->state, d->qpos, r->m->nq);
  mju_copy(r->state + r->m->nq, d->qvel, r->m->nv);
  mj_deleteData(d);
  return fine ? r : NULL;
}

static void test_threads_are_bitwise_serial(void **unused) {
  (void)unused;
  static const char *const name[MODELS] = {"bicycle.xml", "bicycle_stops.xml", "tricycle.xml",
                                           "sway.xml"};
  mjModel *m[MODELS];
  for (int i = 0; i < MODELS; i++) m[i] = load(name[i]);
  run serial[RUNS] = {0}, threaded[RUNS] = {0};
  pthread_t thread[RUNS];
  for (int i = 0; i < RUNS; i++) {
    serial[i] = threaded[i] = (run){.m = m[i % MODELS], .lean_rate = 0.1 * i};
    assert_true(m[i % MODELS]->nq + m[i % MODELS]->nv <= MOST_STATE);
    assert_non_null(take_run(&serial[i]));
  }
  for (int i = 0; i < RUNS; i++)
    assert_int_equal(pthread_create(&thread[i], NULL, take_run, &threaded[i]), 0);
  for (int i = 0; i < RUNS; i++) {
    void *done = NULL;
    assert_int_equal(pthread_join(thread[i], &done), 0);
    assert_non_null(done);
    assert_memory_equal(serial[i].state, threaded[i].state, sizeof serial[i].state);
  }
  for (int i = 0; i < MODELS; i++) mj_deleteModel(m[i]);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_threads_are_bitwise_serial)};
  return cmocka_run_group_tests(tests, install_rolling, uninstall_rolling);
}
