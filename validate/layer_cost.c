// SPDX-License-Identifier: Apache-2.0
// L6: what a ride costs, and what one gets for it. Information: a machine is busy or not, so that
// no gate can stand here.
#include "layer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static int rising(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double lean_error(const comparison *c, const trace *t) {
  const trace *reference = &c->side[REFERENCE].trace;
  double largest = 0;
  for (size_t k = 0; k < t->count && k < reference->count; k++)
    largest = fmax(largest, fabs(t->rows[k].sample.lean - reference->rows[k].sample.lean));
  return largest;
}

enum { MOST_REPEATS = 100 };

// Sorts.
static double median_of(double *seconds, int count) {
  qsort(seconds, (size_t)count, sizeof *seconds, rising);
  return (seconds[(count - 1) / 2] + seconds[count / 2]) / 2;
}

// Rides again and again. A setting that cannot be ridden (a step too coarse) is left out.
static term_exit add_run(comparison *c, int side, const engine_choice *choice, const char *setting,
                         problem *p) {
  study_cost *study = &c->study.cost;
  study_run *run = &study->run[study->count];
  double seconds[MOST_REPEATS], processor[MOST_REPEATS];
  int repeats = study->repeats < MOST_REPEATS ? study->repeats : MOST_REPEATS;
  *run = (study_run){.side = side};
  snprintf(run->setting, sizeof run->setting, "%s", setting);
  for (int i = 0; i < repeats; i++) {
    trace t = {0};
    term_exit code = comparison_ride_also(&t, c, choice, &c->scenario->start, p);
    seconds[i] = t.wall_time;
    processor[i] = t.cpu_time;
    run->steps = t.steps;
    run->evaluations = t.evaluations;
    run->error = lean_error(c, &t);
    trace_clear(&t);
    if (code != TERM_DONE) return code;
  }
  run->median = median_of(seconds, repeats);
  run->cpu = median_of(processor, repeats);
  run->low = seconds[0];
  run->high = seconds[repeats - 1];
  study->count++;
  return TERM_DONE;
}

// The work-precision curve of an engine that chooses its steps: each tolerance of a list.
static term_exit add_tolerances(comparison *c, int side, const engine_choice *as_asked,
                                const char *option, problem *p) {
  static const double tolerances[] = {1e-6, 1e-8, 1e-10, 1e-12};
  int relative = engine_option_index(as_asked->engine, option);
  int absolute = engine_option_index(as_asked->engine, "atol");
  term_exit code = TERM_DONE;
  for (int i = 0; i < 4 && relative >= 0 && code == TERM_DONE; i++) {
    engine_choice choice = *as_asked;
    char setting[64];
    choice.option[relative] = tolerances[i];
    if (absolute >= 0) choice.option[absolute] = tolerances[i];
    snprintf(setting, sizeof setting, "%s %g", option, tolerances[i]);
    code = add_run(c, side, &choice, setting, p);
  }
  return code;
}

static void add_information(comparison *c, int side) {
  const trace *t = &c->side[side].trace;
  measurement m = measurement_of(layer_cost.name, "ride", "steps", "");
  snprintf(m.source, sizeof m.source, "%s", c->side[side].label);
  m.value = (double)t->steps;
  measurement_add(&c->measurements, &m);
  m.metric = "evaluations";
  m.value = (double)t->evaluations;
  measurement_add(&c->measurements, &m);
}

static bool is_adaptive(const engine_choice *choice) {
  return choice->engine->order && engine_order(choice) == 0;
}

static term_exit measure(comparison *c, problem *p) {
  const scenario *s = c->scenario;
  const engine_choice *choice[2] = {&s->reference, &s->candidate};
  term_exit code = TERM_DONE;
  if (s->cost.repeats == 0) return TERM_DONE;
  code = comparison_ride(c, p);
  c->study.cost.repeats = s->cost.repeats;
  for (int i = 0; i < 2 && code == TERM_DONE; i++) {
    add_information(c, i);
    code = add_run(c, i, choice[i], "as in the scenario", p);
  }
  for (int i = 0; i < 2 && code == TERM_DONE; i++) {
    if (!is_adaptive(choice[i])) continue;
    bool has_rtol = engine_option_index(choice[i]->engine, "rtol") >= 0;
    code = add_tolerances(c, i, choice[i], has_rtol ? "rtol" : "tolerance", p);
  }
  return code;
}

// Nothing that a gate could limit.
static bool knows(const char *signal, const char *metric) {
  (void)signal;
  (void)metric;
  return false;
}

const layer layer_cost = {
    .name = "L6",
    .title = "cost",
    .failure = "",
    .knows = knows,
    .measure = measure,
};
