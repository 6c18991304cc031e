// SPDX-License-Identifier: Apache-2.0
#include "comparison.h"

#include "comparison_explain.h"
#include "horizon.h"
#include "layer.h"
#include "terminal/message.h"

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *verdict_string(verdict v) {
  static const char *const texts[] = {"agree", "differs as expected", "fail", "invalid"};
  return texts[v];
}

term_exit verdict_exit(verdict v) {
  static const term_exit codes[] = {TERM_DONE, TERM_DONE, TERM_FAILED, TERM_INVALID};
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
  side->instance = side->engine->create(bicycle, choice, &code, p);
  return side->instance ? TERM_DONE : problem_prefix(p, code, side->label);
}

// How many rides the layers will ask for; only the progress depends on it.
static int count_rides(const scenario *s) {
  return 2 + s->convergence.count + (s->horizon.asked ? 2 : 0) + 2 * s->cost.repeats;
}

static term_exit check_input(const scenario *s, problem *p) {
  const engine *engines[2] = {s->reference.engine, s->candidate.engine};
  for (int i = 0; scenario_has_input(&s->input) && i < 2; i++)
    if (!engines[i]->takes_input)
      return problem_set(p, TERM_USAGE, "%s: this engine rides hands off, without input",
                         engines[i]->name);
  return TERM_DONE;
}

term_exit comparison_open(comparison *c, const scenario *s, problem *p) {
  *c = (comparison){.scenario = s, .weight = s->model.total_mass * s->model.gravity};
  c->rides = count_rides(s);
  const engine *reference = s->reference.engine, *candidate = s->candidate.engine;
  bool alike = strcmp(reference->name, candidate->name) == 0;
  term_exit code = check_input(s, p);
  if (code == TERM_DONE) code = resolve_growth(c, p);
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
  study_clear(&c->study);
  *c = (comparison){0};
}

// Every ride counts alike in the progress of a scenario.
static bool ride_progressed(double share, void *user) {
  const comparison *c = user;
  if (c->progress) c->progress(fmin(1, (c->played + share) / c->rides), c->user);
  return true;
}

static term_exit ride(trace *out, comparison *c, const engine *e, void *instance,
                      const bike_state *start, problem *p) {
  engine_ride asked = {
      .start = *start,
      .duration = c->scenario->duration,
      .sample = c->scenario->sample,
      .lean_limit = scenario_lean_limit(),
      .progress = ride_progressed,
      .user = c,
  };
  scenario_input input = c->scenario->input; // only read
  if (scenario_has_input(&input)) {
    asked.input = scenario_input_at;
    asked.input_user = &input;
  }
  if (input.table) asked.breakpoints = bike_input_table_times(input.table, &asked.breakpoint_count);
  double begun = engine_clock(), processor = engine_processor_clock();
  term_exit code = e->ride(out, instance, &asked, p);
  // Engines measure what their integrator takes, without what is measured on the way; to ask for
  // the processor's time at every step would be a tenth of a step. A ride's share will do.
  double elapsed = engine_clock() - begun;
  double share = (engine_processor_clock() - processor) / elapsed;
  out->cpu_time = out->wall_time * (share < 1 ? share : 1);
  trace_blank_missing(out);
  c->played++;
  if (code != TERM_DONE) return code;
  long row = trace_first_not_finite(out);
  if (row < 0) return TERM_DONE;
  return problem_set(p, TERM_INVALID, "not a finite number at %g s", out->rows[row].sample.time);
}

term_exit comparison_ride_also(trace *out, comparison *c, const engine_choice *choice,
                               const bike_state *start, problem *p) {
  term_exit code = TERM_INVALID;
  void *instance = choice->engine->create(&c->scenario->bicycle, choice, &code, p);
  if (!instance) return code;
  code = ride(out, c, choice->engine, instance, start, p);
  choice->engine->free(instance);
  return code;
}

// Of what a side's recording holds, NaN or infinities matter in signals that a layer needs: the
// first of these, or NULL.
static const trace_flaw *find_flaw(const comparison *c, const trace *t) {
  const trace_flaw *first = NULL;
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++) {
    const trace_flaw *flaw = &t->flaws[i];
    if (!flaw->place || (first && first->row <= flaw->row)) continue;
    if (layer_needs(c, &trace_signals[i], flaw->row)) first = flaw;
  }
  return first;
}

static term_exit check_flaws(const comparison *c, problem *p) {
  for (int i = 0; i < 2; i++) {
    const comparison_side *side = &c->side[i];
    const trace_flaw *flaw = find_flaw(c, &side->trace);
    if (flaw)
      return problem_set(p, TERM_INVALID, "%s: %s: not a finite number at %.9g s", side->label,
                         flaw->place, side->trace.rows[flaw->row].sample.time);
  }
  return TERM_DONE;
}

term_exit comparison_ride(comparison *c, problem *p) {
  term_exit code = TERM_DONE;
  if (c->ridden) return TERM_DONE;
  for (int i = 0; i < 2 && code == TERM_DONE; i++) {
    comparison_side *s = &c->side[i];
    code = ride(&s->trace, c, s->engine, s->instance, &c->scenario->start, p);
    if (code != TERM_DONE) problem_prefix(p, code, s->label);
  }
  if (code == TERM_DONE) code = check_flaws(c, p);
  if (code == TERM_DONE && c->scenario->horizon.asked) code = horizon_find(c, p);
  c->ridden = code == TERM_DONE;
  return code;
}

size_t comparison_rows(const comparison *c) {
  size_t a = c->side[REFERENCE].trace.count, b = c->side[CANDIDATE].trace.count;
  return a < b ? a : b;
}

size_t comparison_judged_rows(const comparison *c) {
  size_t rows = comparison_rows(c);
  if (!c->study.horizon.asked) return rows;
  const trace_row *row = c->side[REFERENCE].trace.rows;
  while (rows > 0 && row[rows - 1].sample.time > c->study.horizon.time) rows--;
  return rows;
}

// Whether a gate that fails says more than another: a value that was measured more than none.
static bool is_worse(const gate *g, const gate *than) {
  if (isnan(g->what.value) != isnan(than->what.value)) return isnan(than->what.value);
  return gate_use(g) > gate_use(than);
}

static const gate *worst_of(const gate_list *gates, const layer *l) {
  const gate *worst = NULL;
  for (size_t i = 0; i < gates->count; i++) {
    const gate *g = &gates->items[i];
    if (strcmp(g->what.layer, l->name) != 0 || g->pass) continue;
    if (!worst || is_worse(g, worst)) worst = g;
  }
  return worst;
}

static void find_first_failure(comparison *c) {
  for (int i = 0; layer_at(i); i++) {
    const gate *worst = worst_of(&c->gates, layer_at(i));
    if (!worst) continue;
    c->verdict = VERDICT_FAIL;
    comparison_explain(c, worst);
    return;
  }
}

// Without a gate that fails. A study that ended early has measured no difference of models.
static verdict passing_verdict(const comparison *c) {
  const study_convergence *study = &c->study.convergence;
  bool differ = study->count > 0 && study->complete && study->verdict == STUDY_DIFFERENT;
  return differ ? VERDICT_DIFFER : VERDICT_AGREE;
}

// A run that means nothing; but where an earlier layer has found a fault, that is its cause.
static void invalidate(comparison *c, const layer *l, const problem *p) {
  find_first_failure(c);
  bool failed = c->verdict == VERDICT_FAIL;
  c->verdict = VERDICT_INVALID;
  if (failed) {
    size_t used = strlen(c->cause);
    snprintf(c->cause + used, sizeof c->cause - used, "; then %s: %s", l->name, p->text);
    return;
  }
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
  c->verdict = passing_verdict(c);
  if (whole)
    find_first_failure(c);
  else
    invalidate(c, layer_at(layers - 1), p);
  if (c->progress) c->progress(1, c->user);
  return TERM_DONE;
}
