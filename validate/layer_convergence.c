// SPDX-License-Identifier: Apache-2.0
// L4: the candidate's ride with several steps: what falls with the step is integration, what stays
// is the model.
#include "layer.h"

#include "richardson.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// The candidate's signals at each step, and the reference's: arrays of `rows` numbers.
typedef struct rides {
  size_t rows;
  double *time;
  double *reference[STUDY_SIGNALS];
  double *ride[SCENARIO_MAX_STEPS][STUDY_SIGNALS];
} rides;

static double *copy_signal(const trace *t, size_t rows, int index) {
  const trace_signal *signal = trace_find_signal(study_signals[index]);
  double *copy = calloc(rows + 1, sizeof *copy);
  for (size_t k = 0; copy && k < rows; k++) copy[k] = trace_value(&t->rows[k], signal);
  return copy;
}

static void free_rides(rides *r) {
  free(r->time);
  for (int s = 0; s < STUDY_SIGNALS; s++) {
    free(r->reference[s]);
    for (int i = 0; i < SCENARIO_MAX_STEPS; i++) free(r->ride[i][s]);
  }
}

static bool take_reference(rides *r, const comparison *c) {
  const trace *t = &c->side[REFERENCE].trace;
  bool taken = (r->time = calloc(t->count + 1, sizeof *r->time)) != NULL;
  r->rows = t->count;
  for (size_t k = 0; taken && k < r->rows; k++) r->time[k] = t->rows[k].sample.time;
  for (int s = 0; s < STUDY_SIGNALS; s++)
    taken = taken && (r->reference[s] = copy_signal(t, r->rows, s));
  return taken;
}

static bool take_ride(rides *r, int index, const trace *t) {
  bool taken = true;
  if (t->count < r->rows) r->rows = t->count;
  for (int s = 0; s < STUDY_SIGNALS; s++)
    taken = taken && (r->ride[index][s] = copy_signal(t, t->count, s));
  return taken;
}

// One more ride, with another step.
static term_exit ride_point(comparison *c, rides *r, int index, problem *p) {
  study_convergence *study = &c->study.convergence;
  engine_choice choice = c->scenario->candidate;
  study_point *point = &study->point[index];
  trace t = {0};
  point->step = c->scenario->convergence.step[index];
  choice.option[engine_option_index(choice.engine, choice.engine->step_option)] = point->step;
  term_exit code = comparison_ride_also(&t, c, &choice, &c->scenario->start, p);
  if (code == TERM_DONE) {
    point->steps = t.steps;
    point->evaluations = t.evaluations;
    point->wall_time = t.wall_time;
    point->cpu_time = t.cpu_time;
    study->complete = study->complete && t.complete;
    if (!take_ride(r, index, &t)) code = problem_memory(p);
  } else {
    char prefix[64];
    snprintf(prefix, sizeof prefix, "convergence: %s %g s", choice.engine->step_option,
             point->step);
    problem_prefix(p, code, prefix);
  }
  trace_clear(&t);
  return code;
}

static double largest_error(const rides *r, int index, int signal) {
  double largest = 0;
  for (size_t k = 0; k < r->rows; k++) {
    double error = fabs(r->ride[index][signal][k] - r->reference[signal][k]);
    if (!(error <= largest)) largest = error;
  }
  return largest;
}

// The limit for step 0 at a row, from the `count` finest of the `total` rides.
static double limit_at(const rides *r, const double weight[], int total, int count, int signal,
                       size_t row) {
  double sum = 0;
  for (int i = 0; i < count; i++) sum += weight[i] * r->ride[total - count + i][signal][row];
  return sum;
}

// How far an order may be from the expected one: what the next term of the error still makes of it
// at the largest step.
static const double order_tolerance = 0.2;

// The power of the error's first term: the expected one, or, where the errors fall with another
// whole one (another integrator), that: a wrong power leaves false plateaus.
static double first_power(const study_signal *s, double expected) {
  double whole = round(s->order);
  if (whole >= 1 && fabs(s->order - whole) <= order_tolerance) return whole;
  return expected;
}

// Plateau: limit with as many terms as the steps allow, minus reference. Uncertainty: what one term
// fewer would have given instead.
static bool extrapolate(study_signal *out, const study_convergence *study, const rides *r,
                        const double step[], int signal) {
  double all[RICHARDSON_MAX], fewer[RICHARDSON_MAX];
  int n = study->count;
  out->power = first_power(out, study->order);
  if (!richardson_weights(all, step, n, out->power) ||
      !richardson_weights(fewer, step + 1, n - 1, out->power))
    return false;
  out->plateau = out->uncertainty = 0;
  for (size_t k = 0; k < r->rows; k++) {
    double limit = limit_at(r, all, n, n, signal, k);
    double off = fabs(limit - r->reference[signal][k]);
    double doubt = fabs(limit - limit_at(r, fewer, n, n - 1, signal, k));
    if (!(doubt <= out->uncertainty)) out->uncertainty = doubt;
    if (off <= out->plateau) continue;
    out->plateau = off;
    out->plateau_time = r->time[k];
  }
  return true;
}

static study_verdict judge(const study_signal *s, double order, double tolerance) {
  if (!(s->plateau <= tolerance || s->plateau <= 3 * s->uncertainty)) return STUDY_DIFFERENT;
  return fabs(s->order - order) <= order_tolerance ? STUDY_SAME : STUDY_UNDECIDED;
}

static bool examine(comparison *c, const rides *r) {
  study_convergence *study = &c->study.convergence;
  double step[SCENARIO_MAX_STEPS], error[SCENARIO_MAX_STEPS];
  for (int s = 0; s < STUDY_SIGNALS; s++) {
    study_signal *out = &study->signal[s];
    for (int i = 0; i < study->count; i++) {
      step[i] = study->point[i].step;
      error[i] = study->point[i].error[s] = largest_error(r, i, s);
    }
    richardson_order(&out->order, &out->scatter, step, error, study->count);
    if (!extrapolate(out, study, r, step, s)) return false;
    out->verdict = judge(out, study->order, c->scenario->convergence.tolerance);
    // A different model is worse than an unexpected order.
    if (out->verdict == STUDY_DIFFERENT || study->verdict == STUDY_SAME)
      study->verdict = out->verdict;
  }
  return true;
}

static void add(comparison *c, const char *signal, const char *metric, const char *unit,
                double value, double time) {
  measurement m = measurement_of(layer_convergence.name, signal, metric, unit);
  m.value = value;
  m.time = time;
  measurement_add(&c->measurements, &m);
}

static void add_verdict(comparison *c) {
  const study_convergence *study = &c->study.convergence;
  const scenario_convergence *asked = &c->scenario->convergence;
  study_verdict expected = asked->different ? STUDY_DIFFERENT : STUDY_SAME;
  measurement m = measurement_of(layer_convergence.name, "verdict", "unexpected", "");
  m.value = study->complete && study->verdict == expected ? 0 : 1;
  double plateau = fmax(study->signal[0].plateau, study->signal[1].plateau);
  if (!study->complete)
    measurement_detail(&m, "with some step the ride ends early");
  else
    measurement_detail(&m, "%s, plateau %.3g rad, order %.3g (lean) and %.3g (steer), expected %s",
                       study_verdict_string(study->verdict), plateau, study->signal[0].order,
                       study->signal[1].order, study_verdict_string(expected));
  measurement_add(&c->measurements, &m);
}

static void add_all(comparison *c) {
  const study_convergence *study = &c->study.convergence;
  add_verdict(c);
  for (int i = 0; i < STUDY_SIGNALS; i++) {
    const study_signal *s = &study->signal[i];
    const char *name = study_signals[i];
    add(c, name, "order", "", s->order, NAN);
    add(c, name, "order_size", "", fabs(s->order), NAN);
    add(c, name, "order_error", "", fabs(s->order - study->order), NAN);
    add(c, name, "plateau", "rad", s->plateau, s->plateau_time);
    add(c, name, "uncertainty", "rad", s->uncertainty, NAN);
  }
}

static void prepare(comparison *c) {
  const scenario *s = c->scenario;
  study_convergence *study = &c->study.convergence;
  study->count = s->convergence.count;
  study->order = isnan(s->convergence.order) ? engine_order(&s->candidate) : s->convergence.order;
  study->terms = study->count - 1;
  study->complete = true;
}

static term_exit measure(comparison *c, problem *p) {
  rides r = {0};
  if (c->scenario->convergence.count == 0) return TERM_DONE;
  term_exit code = comparison_ride(c, p);
  if (code != TERM_DONE) return code;
  prepare(c);
  if (code == TERM_DONE && !take_reference(&r, c)) code = problem_memory(p);
  for (int i = 0; i < c->study.convergence.count && code == TERM_DONE; i++)
    code = ride_point(c, &r, i, p);
  if (code == TERM_DONE && !examine(c, &r))
    code = problem_set(p, TERM_USAGE, "convergence: these steps determine no limit");
  if (code == TERM_DONE) add_all(c);
  free_rides(&r);
  return code;
}

static bool knows(const char *signal, const char *metric) {
  static const char *const metrics[] = {"order",   "order_size",  "order_error",
                                        "plateau", "uncertainty", NULL};
  static const char *const verdicts[] = {"verdict", NULL}, *const unexpected[] = {"unexpected",
                                                                                  NULL};
  if (layer_names(unexpected, metric)) return !signal || layer_names(verdicts, signal);
  if (!layer_names(metrics, metric)) return false;
  for (int i = 0; signal && i < STUDY_SIGNALS; i++)
    if (layer_names((const char *const[]){study_signals[i], NULL}, signal)) return true;
  return !signal;
}

static const gate_rule rules[] = {
    {.metric = "unexpected",
     .signals = {"verdict"},
     .signal_count = 1,
     .limit = 0,
     .reason = "whether both engines hold the same equations is what the scenario says of them: "
               "'same equations' where the order is within 0.2 of the expected one and the plateau "
               "below the tolerance or three uncertainties, 'different model' where it is above"},
};

const layer layer_convergence = {
    .name = "L4",
    .title = "convergence",
    .agreed = "the rides converge as expected",
    .failure = "the rides do not converge as expected",
    .knows = knows,
    .measure = measure,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};
