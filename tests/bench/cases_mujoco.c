// SPDX-License-Identifier: Apache-2.0
// What exact rolling costs MuJoCo.
#include "rolling.h"
#include "work.h"

typedef struct mujoco_cases {
  bench_subject *subject;
  bench_twin twin;
} mujoco_cases;

static volatile double sink; // keeps results alive

static void steps(const bench_twin *twin, long repeats) {
  mjModel *m = runner_model(twin->runner);
  mjData *d = runner_data(twin->runner);
  mj_copyData(d, m, twin->start);
  for (long i = 0; i < repeats; i++) mj_step(m, d);
}

static void rolling_steps(void *twin, long repeats) {
  steps(twin, repeats);
}

static void free_steps(void *twin, long repeats) {
  roll_uninstall();
  steps(twin, repeats);
  roll_install();
}

// What mj_forward calls between the passive forces and the solver: inertia, velocities and all
// forces but those of the discs stand in mjData.
static void callback(void *context, long repeats) {
  const bench_twin *twin = context;
  mjModel *m = runner_model(twin->runner);
  mjData *d = runner_data(twin->runner);
  mj_copyData(d, m, twin->start);
  mj_fwdPosition(m, d);
  mj_fwdVelocity(m, d);
  for (long i = 0; i < repeats; i++) {
    // Its forces are added: without this they would pile up.
    mju_zero(d->qfrc_passive, m->nv);
    roll_control(m, d);
  }
  sink = d->qfrc_passive[0];
}

static bool prepare(void *context, bench_notes *notes) {
  mujoco_cases *c = context;
  if (c->twin.runner || bench_twin_open(&c->twin, &c->subject->bicycle, &c->subject->state))
    return true;
  return bench_note_reason(notes, "the bicycle could not be set up in MuJoCo");
}

static void end(void *context) {
  mujoco_cases *c = context;
  bench_twin_close(&c->twin);
}

bool bench_mujoco_cases(bench_list *list) {
  mujoco_cases *c = bench_new(list, sizeof *c, end);
  c->subject = list->subject;
  const bench_contest contests[] = {
      {.name = "mujoco-step",
       .question = "mj_step (RK4) with rolling / without",
       .ours = {"mj_step, callback", rolling_steps, .context = &c->twin},
       .theirs = {"mj_step", free_steps, .context = &c->twin},
       .sense = BENCH_AT_MOST,
       .asked = 1.8,
       .prepare = prepare},
      {.name = "mujoco-callback",
       .question = "rolling of two discs / mj_forward",
       .ours = {"roll_control", callback, .context = &c->twin},
       .theirs = {"mj_forward", bench_mujoco_forward, .context = &c->twin},
       .sense = BENCH_AT_MOST,
       .asked = 0.8,
       .prepare = prepare}};
  bench_add_all(list, contests, sizeof contests / sizeof contests[0], c);
  return true;
}
