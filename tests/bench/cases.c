// SPDX-License-Identifier: Apache-2.0
#include "cases.h"

#include "point.h"
#include "rolling.h"
#include "runner.h"
#include "terminal/message.h"

#include <math.h>
#include <stdlib.h>

struct bench_cases {
  bike_model model;
  bike_state state;
  runner *ride;         // its model and data are MuJoCo's contestants
  mjData *start;        // a copy of the state to go back to
  bench_row row;        // of a map, where the bicycle has a rider
  volatile double sink; // keeps results alive
};

bench_cases *bench_cases_create(const bike_bicycle *bicycle, const bike_state *state) {
  bench_cases *c = calloc(1, sizeof *c);
  if (!c) return NULL;
  mjcf_options options = mjcf_default_options();
  options.visible = false;
  mjcf_error error;
  runner_status status;
  c->state = *state;
  int code = bike_model_init(&c->model, bicycle);
  if (code) {
    term_fail_bike(code, bicycle->name);
    free(c);
    return NULL;
  }
  c->ride = runner_create(bicycle, &options, &status, &error);
  if (!c->ride || runner_start(c->ride, state, &error)) {
    term_message("%s", error.text);
    bench_cases_free(c);
    return NULL;
  }
  if (!bench_row_begin(&c->row, &c->model)) {
    term_message("%s: no stationary turn to start from: a rider is needed", bicycle->name);
    bench_cases_free(c);
    return NULL;
  }
  c->start = mj_copyData(NULL, runner_model(c->ride), runner_data(c->ride));
  return c;
}

void bench_cases_free(bench_cases *c) {
  if (!c) return;
  if (c->start) mj_deleteData(c->start);
  runner_free(c->ride);
  free(c);
}

// The state moves a little, so that nothing can be kept from one call to the next.
static void right_hand_side(void *context, int repeats) {
  bench_cases *c = context;
  bike_state state = c->state;
  bike_rates rates;
  double sum = 0;
  for (int i = 0; i < repeats; i++) {
    state.lean = c->state.lean + 1e-9 * i;
    if (!bike_rates_of(&rates, &c->model, &state, NULL)) sum += rates.acceleration.lean;
  }
  c->sink = sum;
}

// Without callback, sensors and contacts: what MuJoCo needs for the accelerations alone.
static void mujoco_forward(void *context, int repeats) {
  bench_cases *c = context;
  mjModel *m = runner_model(c->ride);
  mjData *d = runner_data(c->ride);
  int flags = m->opt.disableflags;
  m->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_SENSOR;
  roll_uninstall();
  for (int i = 0; i < repeats; i++) {
    d->qpos[0] = 1e-9 * i;
    mj_forward(m, d);
  }
  roll_install();
  m->opt.disableflags = flags;
}

static void steps(bench_cases *c, int repeats) {
  mjModel *m = runner_model(c->ride);
  mjData *d = runner_data(c->ride);
  mj_copyData(d, m, c->start);
  for (int i = 0; i < repeats; i++) mj_step(m, d);
}

static void rolling_steps(void *context, int repeats) {
  steps(context, repeats);
}

static void free_steps(void *context, int repeats) {
  roll_uninstall();
  steps(context, repeats);
  roll_install();
}

// What mj_forward calls between the passive forces and the solver: inertia, velocities and all
// forces but those of the discs stand in mjData.
static void callback(void *context, int repeats) {
  bench_cases *c = context;
  mjModel *m = runner_model(c->ride);
  mjData *d = runner_data(c->ride);
  mj_copyData(d, m, c->start);
  mj_fwdPosition(m, d);
  mj_fwdVelocity(m, d);
  for (int i = 0; i < repeats; i++) {
    // Its forces are added: without this they would pile up.
    mju_zero(d->qfrc_passive, m->nv);
    roll_control(m, d);
  }
  c->sink = d->qfrc_passive[0];
}

void bench_contests(bench_contest out[BENCH_CONTESTS], bench_cases *c) {
  out[0] = (bench_contest){.question = "right-hand side / mj_forward",
                           .ours = {"bike_rates_of", right_hand_side, c},
                           .theirs = {"mj_forward", mujoco_forward, c},
                           .repeats = 2000,
                           .at_most = 0.2};
  out[1] = (bench_contest){.question = "mj_step with rolling / without (RK4)",
                           .ours = {"mj_step, callback", rolling_steps, c},
                           .theirs = {"mj_step", free_steps, c},
                           .repeats = 200,
                           .at_most = 1.8};
  out[2] = (bench_contest){.question = "full (speed, lean) point / right-hand side",
                           .ours = {"bike_turn_near", bench_exact_points, &c->row},
                           .theirs = {"bike_rates_of", right_hand_side, c},
                           .repeats = 200,
                           .at_most = 70};
  out[3] = (bench_contest){.question = "full point / by finite differences and dgeev",
                           .ours = {"bike_turn_near", bench_exact_points, &c->row},
                           .theirs = {"finite differences", bench_difference_points, &c->row},
                           .repeats = 200,
                           .at_most = INFINITY};
  out[4] = (bench_contest){.question = "rolling of two discs / mj_forward",
                           .ours = {"roll_control", callback, c},
                           .theirs = {"mj_forward", mujoco_forward, c},
                           .repeats = 2000,
                           .at_most = 0.8};
}
