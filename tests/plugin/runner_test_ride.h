// SPDX-License-Identifier: Apache-2.0
// Rides of both engines with their samples kept, for the tests of the runner.
#ifndef BICYCLE_TESTS_RUNNER_TEST_RIDE_H
#define BICYCLE_TESTS_RUNNER_TEST_RIDE_H

#include "runner.h"
#include "support/near.h"

#include <string.h>

enum { TRACE_SIZE = 1101 };

typedef struct trace {
  int count;
  bike_sample row[TRACE_SIZE];
  double work[TRACE_SIZE];
  double force[TRACE_SIZE][2]; // N  on the rear wheel: along its heading, to the left
  double slip, height;         // largest
} trace;

static inline int keep_mujoco(const runner_sample *s, void *user) {
  trace *t = (trace *)user;
  assert_in_range(t->count, 0, TRACE_SIZE - 1);
  t->row[t->count] = s->row;
  memcpy(t->force[t->count], s->more.rear_force, sizeof t->force[0]);
  t->work[t->count++] = s->more.work;
  for (int i = 0; i < 2; i++) {
    t->slip = fmax(t->slip, s->slip[i]);
    t->height = fmax(t->height, fabs(s->height[i]));
  }
  return 0;
}

static inline int keep_analytic(const bike_sample *s, const bike_sample_more *more, void *user) {
  trace *t = (trace *)user;
  assert_in_range(t->count, 0, TRACE_SIZE - 1);
  t->row[t->count] = *s;
  memcpy(t->force[t->count], more->rear_force, sizeof t->force[0]);
  t->work[t->count++] = more->work;
  return 0;
}

static inline runner *make_runner(const bike_bicycle *bicycle, const mjcf_options *options) {
  runner_status status;
  mjcf_error error = {.text = ""};
  runner *r = runner_create(bicycle, options, &status, &error);
  if (!r) fail_msg("%s", error.text);
  return r;
}

static inline void start_runner(runner *r, const bike_state *state) {
  mjcf_error error = {.text = ""};
  if (runner_start(r, state, &error) != RUNNER_OK) fail_msg("%s", error.text);
}

#endif
