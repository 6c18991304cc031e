// SPDX-License-Identifier: Apache-2.0
// One right-hand side: against sympy's C, and against MuJoCo.
#include "peers/agreement.h"
#include "work.h"

typedef struct rhs_cases {
  bench_subject *subject;
  sympy_bicycle sympy;
  bool symmetric;
  bench_twin twin;
} rhs_cases;

static volatile double sink; // keeps results alive

//---------------------------------- sympy's -------------------------------------------------------

static void sympy_accelerations(const rhs_cases *c, sympy_accelerator *accelerate, long repeats) {
  bike_state state = c->subject->state;
  bike_acceleration a;
  double sum = 0;
  for (long i = 0; i < repeats; i++) {
    state.lean = c->subject->state.lean + 1e-9 * (double)i;
    if (accelerate(&a, &c->sympy, &state)) sum += a.lean;
  }
  sink = sum;
}

static void full(void *context, long repeats) {
  sympy_accelerations(context, sympy_accelerate, repeats);
}

static void paired(void *context, long repeats) {
  sympy_accelerations(context, sympy_accelerate_paired, repeats);
}

static void reduced(void *context, long repeats) {
  sympy_accelerations(context, sympy_accelerate_reduced, repeats);
}

static bool prepare_sympy(rhs_cases *c, sympy_accelerator *accelerate, bench_notes *notes) {
  if (!c->symmetric) return bench_note_reason(notes, "the bicycle is not laterally symmetric");
  return sympy_agreement(notes, accelerate, &c->sympy, c->subject);
}

static bool prepare_full(void *context, bench_notes *notes) {
  return prepare_sympy(context, sympy_accelerate, notes);
}

static bool prepare_paired(void *context, bench_notes *notes) {
  return prepare_sympy(context, sympy_accelerate_paired, notes);
}

static bool prepare_reduced(void *context, bench_notes *notes) {
  return prepare_sympy(context, sympy_accelerate_reduced, notes);
}

//---------------------------------- MuJoCo's ------------------------------------------------------

// The comparator's own gate of accelerations (validate/scenarios/gates), relative to the largest.
static const double MUJOCO_AGREES = 1e-10;

// Rolling is exact only with the callback; mj_forward is timed without.
static bool prepare_mujoco(void *context, bench_notes *notes) {
  rhs_cases *c = context;
  const bench_subject *s = c->subject;
  if (!c->twin.runner && !bench_twin_open(&c->twin, &s->bicycle, &s->state))
    return bench_note_reason(notes, "the bicycle could not be set up in MuJoCo");
  runner_instant theirs;
  bike_acceleration ours;
  mjcf_error error;
  if (runner_evaluate(&theirs, c->twin.runner, &s->state, NULL, &error))
    return bench_note_reason(notes, "%s", error.text);
  if (bike_accelerate(&ours, &s->model, &s->state, NULL))
    return bench_note_reason(notes, "the equations have no answer");
  bike_acceleration other = {theirs.lean_acceleration, theirs.steer_acceleration,
                             theirs.speed_rate};
  bench_note_check(notes, "disagreement", acceleration_difference(&other, &ours), MUJOCO_AGREES);
  return true;
}

static void end(void *context) {
  rhs_cases *c = context;
  bench_twin_close(&c->twin);
}

bool bench_rhs_cases(bench_list *list) {
  rhs_cases *c = bench_new(list, sizeof *c, end);
  bench_subject *s = c->subject = list->subject;
  c->symmetric = sympy_bicycle_init(&c->sympy, &s->bicycle, &s->model);
  const bench_runner accelerations = {"equations, native", bench_native_accelerations,
                                      .context = s};
  const bench_runner ours = {"bike_rates_of", bench_right_hand_sides, .context = s};
  const bench_runner forward = {"mj_forward", bench_mujoco_forward, .context = &c->twin};
  const bench_contest contests[] = {
      {.name = "rhs-sympy",
       .question = "right-hand side, same flags: sympy's C (6 x 6) / ours",
       .ours = accelerations,
       .theirs = {"KanesMethod, 6 x 6", full, .context = c},
       .asked = 3,
       .possible = 3.4,
       .prepare = prepare_full},
      {.name = "rhs-sympy-paired",
       .question = "right-hand side: sympy's C (6 x 6) with paired operations / ours",
       .ours = accelerations,
       .theirs = {"KanesMethod, 6 x 6", paired, .context = c},
       .prepare = prepare_paired},
      {.name = "rhs-sympy-reduced",
       .question = "right-hand side, same flags: sympy's C (3 x 3) / ours",
       .ours = accelerations,
       .theirs = {"KanesMethod, 3 x 3", reduced, .context = c},
       .prepare = prepare_reduced},
      {.name = "rhs-mujoco",
       .question = "mj_forward / right-hand side",
       .ours = ours,
       .theirs = forward,
       .asked = 8,
       .possible = 10,
       .prepare = prepare_mujoco}};
  bench_add_all(list, contests, sizeof contests / sizeof contests[0], c);
  return true;
}
