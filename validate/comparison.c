// SPDX-License-Identifier: Apache-2.0
#include "comparison.h"

#include "layer.h"
#include "terminal/message.h"

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *verdict_string(verdict v) {
  static const char *const texts[] = {"agree", "fail", "invalid"};
  return texts[v];
}

term_exit verdict_exit(verdict v) {
  static const term_exit codes[] = {TERM_DONE, TERM_FAILED, TERM_INVALID};
  return codes[v];
}

static term_exit resolve_growth(comparison *c, problem *p) {
  const scenario *s = c->scenario;
  c->growth_rate = s->growth.rate;
  if (!s->growth.unstable_mode) return TERM_DONE;
  bike_eigenvalues modes;
  int error = bike_upright_eigenvalues(&modes, &s->model, s->start.speed);
  if (error != BIKE_OK)
    return problem_set(p, term_exit_of(error), "%s: growth: %s", s->name, bike_error_string(error));
  c->growth_rate = fmax(0, modes.re[0]); // a stable ride makes no difference larger
  return TERM_DONE;
}

static term_exit open_side(comparison_side *side, const engine_choice *choice, const char *label,
                           const bike_bicycle *bicycle, problem *p) {
  term_exit code = TERM_INVALID;
  side->engine = choice->engine;
  snprintf(side->label, sizeof side->label, "%s", label);
  side->instance = side->engine->create(bicycle, choice->option, &code, p);
  return side->instance ? TERM_DONE : problem_prefix(p, code, side->label);
}

term_exit comparison_open(comparison *c, const scenario *s, problem *p) {
  *c = (comparison){.scenario = s, .weight = s->model.total_mass * s->model.gravity};
  const engine *reference = s->reference.engine, *candidate = s->candidate.engine;
  bool alike = strcmp(reference->name, candidate->name) == 0;
  term_exit code = resolve_growth(c, p);
  if (code == TERM_DONE)
    code = open_side(&c->side[REFERENCE], &s->reference, alike ? "reference" : reference->name,
                     &s->bicycle, p);
  if (code == TERM_DONE)
    code = open_side(&c->side[CANDIDATE], &s->candidate, alike ? "candidate" : candidate->name,
                     &s->bicycle, p);
  return code;
}

void comparison_close(comparison *c) {
  for (int i = 0; i < 2; i++) {
    if (c->side[i].instance) c->side[i].engine->free(c->side[i].instance);
    trace_clear(&c->side[i].trace);
  }
  measurement_clear(&c->measurements);
  gates_clear(&c->gates);
  *c = (comparison){0};
}

// Rides of the two engines, one after the other, make up the progress of a scenario.
typedef struct ride_progress {
  comparison *c;
  int side;
} ride_progress;

static bool ride_progressed(double share, void *user) {
  const ride_progress *r = user;
  if (r->c->progress) r->c->progress(0.5 * (r->side + share), r->c->user);
  return true;
}

static term_exit ride_side(comparison *c, int side, problem *p) {
  comparison_side *s = &c->side[side];
  ride_progress progress = {c, side};
  engine_ride ride = {
      .start = c->scenario->start,
      .duration = c->scenario->duration,
      .sample = c->scenario->sample,
      .lean_limit = bike_default_ride_def().lean_limit, // the same for all engines
      .progress = ride_progressed,
      .user = &progress,
  };
  term_exit code = s->engine->ride(&s->trace, s->instance, &ride, p);
  if (code != TERM_DONE) return problem_prefix(p, code, s->label);
  long row = trace_first_not_finite(&s->trace);
  if (row >= 0)
    return problem_set(p, TERM_INVALID, "%s: not a finite number at %g s", s->label,
                       s->trace.rows[row].sample.time);
  return TERM_DONE;
}

term_exit comparison_ride(comparison *c, problem *p) {
  term_exit code = TERM_DONE;
  for (int i = 0; i < 2 && !c->ridden && code == TERM_DONE; i++) code = ride_side(c, i, p);
  c->ridden = code == TERM_DONE;
  return code;
}

size_t comparison_rows(const comparison *c) {
  size_t a = c->side[REFERENCE].trace.count, b = c->side[CANDIDATE].trace.count;
  return a < b ? a : b;
}

// Says which gate of the first failing layer uses up its limit most, and what that means.
static void explain(comparison *c, const gate *worst) {
  char name[MEASUREMENT_FULL_NAME];
  const measurement *m = &worst->what;
  c->first_failure = layer_find(m->layer);
  int used = snprintf(c->cause, sizeof c->cause, "%s; largest in %s: %s %.3g%s%s, limit %.3g",
                      c->first_failure->failure, measurement_full_name(name, m), m->metric,
                      m->value, *m->unit ? " " : "", m->unit, worst->rule->limit);
  if (used < 0 || used >= (int)sizeof c->cause) return;
  if (isfinite(m->time))
    used += snprintf(c->cause + used, sizeof c->cause - (size_t)used, " at %g s", m->time);
  if (*m->detail && used < (int)sizeof c->cause)
    snprintf(c->cause + used, sizeof c->cause - (size_t)used, " (%s)", m->detail);
}

static const gate *worst_of(const gate_list *gates, const layer *l) {
  const gate *worst = NULL;
  for (size_t i = 0; i < gates->count; i++) {
    const gate *g = &gates->items[i];
    if (strcmp(g->what.layer, l->name) != 0 || g->pass) continue;
    if (!worst || gate_use(g) > gate_use(worst)) worst = g;
  }
  return worst;
}

static void find_first_failure(comparison *c) {
  for (int i = 0; layer_at(i); i++) {
    const gate *worst = worst_of(&c->gates, layer_at(i));
    if (!worst) continue;
    c->verdict = VERDICT_FAIL;
    explain(c, worst);
    return;
  }
}

static void invalidate(comparison *c, const layer *l, const problem *p) {
  c->verdict = VERDICT_INVALID;
  c->first_failure = l;
  snprintf(c->cause, sizeof c->cause, "%s", p->text);
}

term_exit comparison_run(comparison *c, problem *p) {
  term_exit code = TERM_DONE;
  int layers = 0;
  for (; code == TERM_DONE && layer_at(layers); layers++) code = layer_at(layers)->measure(c, p);
  if (code == TERM_USAGE) return problem_prefix(p, code, c->scenario->name);
  bool whole = code == TERM_DONE;
  if (!gates_judge(&c->gates, &c->measurements, &c->scenario->rules, whole ? layers : layers - 1))
    return problem_memory(p);
  if (whole)
    find_first_failure(c);
  else
    invalidate(c, layer_at(layers - 1), p);
  if (c->progress) c->progress(1, c->user);
  return TERM_DONE;
}
