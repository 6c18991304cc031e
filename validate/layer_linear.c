// SPDX-License-Identifier: Apache-2.0
// L1: small motions about upright riding: eigenvalues of both engines' own linearisations over
// speeds, and the speeds at which the bicycle becomes stable and unstable.
#include "layer.h"

#include "modes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// The modes of one engine over all speeds, and its critical speeds.
static term_exit examine(comparison *c, int side, const double *speed, bike_eigenvalues *modes,
                         problem *p) {
  study_linear *study = &c->study.linear;
  const comparison_side *s = &c->side[side];
  term_exit code = TERM_DONE;
  for (int k = 0; k < study->count && code == TERM_DONE; k++) {
    code = modes_at(&modes[k], s->engine, s->instance, speed[k], p);
    study->modes[k].engine[side] = modes[k];
  }
  if (code == TERM_DONE)
    code = modes_critical_speeds(&study->speed[side], s->engine, s->instance, speed, modes,
                                 study->count, p);
  return code == TERM_DONE ? code : problem_prefix(p, code, s->label);
}

static void add_modes(comparison *c) {
  const study_linear *study = &c->study.linear;
  measurement m = measurement_of(layer_linear.name, "eigenvalues", "relative", "");
  m.value = -1;
  for (int k = 0; k < study->count; k++) {
    const study_modes *modes = &study->modes[k];
    if (isnan(m.value) || modes->error <= m.value) continue;
    m.value = modes->error;
    measurement_detail(&m, "at %.6g m/s: %.9g%+.9gi against %.9g%+.9gi 1/s", modes->speed,
                       modes->engine[CANDIDATE].re[0], modes->engine[CANDIDATE].im[0],
                       modes->engine[REFERENCE].re[0], modes->engine[REFERENCE].im[0]);
  }
  measurement_add(&c->measurements, &m);
}

// The speeds of one kind: as many in both engines, and the same. An engine without any agrees with
// another without.
static void add_speeds(comparison *c, const char *signal, const double *reference,
                       int reference_count, const double *candidate, int candidate_count) {
  measurement m = measurement_of(layer_linear.name, signal, "relative", "");
  bool alike = reference_count == candidate_count;
  m.value = alike ? 0 : NAN;
  for (int i = 0; alike && i < reference_count; i++)
    m.value = fmax(m.value, fabs(candidate[i] - reference[i]) / reference[i]);
  if (!alike)
    measurement_detail(&m, "%d such speeds against %d", candidate_count, reference_count);
  else if (reference_count)
    measurement_detail(&m, "%.12g against %.12g m/s", candidate[0], reference[0]);
  measurement_add(&c->measurements, &m);
}

static void add_all(comparison *c) {
  const bike_critical_speeds *a = &c->study.linear.speed[REFERENCE];
  const bike_critical_speeds *b = &c->study.linear.speed[CANDIDATE];
  add_modes(c);
  add_speeds(c, "weave_speed", a->weave, a->weave_count, b->weave, b->weave_count);
  add_speeds(c, "capsize_speed", a->capsize, a->capsize_count, b->capsize, b->capsize_count);
}

static term_exit examine_both(comparison *c, double *speed, bike_eigenvalues *modes, problem *p) {
  study_linear *study = &c->study.linear;
  const scenario_linear *asked = &c->scenario->linear;
  for (int k = 0; k < study->count; k++)
    study->modes[k].speed = speed[k] =
        asked->slow + (asked->fast - asked->slow) * k / (study->count - 1);
  term_exit code = examine(c, REFERENCE, speed, modes, p);
  if (code == TERM_DONE) code = examine(c, CANDIDATE, speed, modes, p);
  for (int k = 0; k < study->count; k++)
    study->modes[k].error =
        modes_difference(&study->modes[k].engine[REFERENCE], &study->modes[k].engine[CANDIDATE]);
  return code;
}

static term_exit measure(comparison *c, problem *p) {
  study_linear *study = &c->study.linear;
  int count = c->scenario->linear.count;
  if (count == 0) return TERM_DONE;
  for (int i = 0; i < 2; i++)
    if (!c->side[i].engine->linearize)
      return problem_set(p, TERM_USAGE, "linear: the engine '%s' has no linearisation",
                         c->side[i].engine->name);
  double *speed = calloc((size_t)count, sizeof *speed);
  bike_eigenvalues *modes = calloc((size_t)count, sizeof *modes);
  study->modes = calloc((size_t)count, sizeof *study->modes);
  study->count = study->modes ? count : 0;
  term_exit code =
      speed && modes && study->modes ? examine_both(c, speed, modes, p) : problem_memory(p);
  if (code == TERM_DONE) add_all(c);
  free(speed);
  free(modes);
  return code;
}

static bool knows(const char *signal, const char *metric) {
  static const char *const metrics[] = {"relative", NULL};
  static const char *const signals[] = {"eigenvalues", "weave_speed", "capsize_speed", NULL};
  return layer_names(metrics, metric) && (!signal || layer_names(signals, signal));
}

static const gate_rule rules[] = {
    {.metric = "relative",
     .limit = 1e-8,
     .reason = "differences of order 8 of accelerations that are right to 1e-13 give entries right "
               "to 1e-11; an eigenvalue errs by some ten times that, near a double one more"},
};

const layer layer_linear = {
    .name = "L1",
    .title = "linear",
    .agreed = "the engines agree on small motions about upright riding",
    .failure = "small motions about upright riding differ",
    .knows = knows,
    .measure = measure,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};
