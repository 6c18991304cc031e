// SPDX-License-Identifier: Apache-2.0
// Why rides differ, as far as L2 and the convergence study have measured it.
#include "comparison_explain.h"

#include "comparison_relations.h"
#include "layer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Where the first of the rows stands that are beyond the limit. Of the metrics of single rows
// alone.
static void say_since(comparison *c, const gate *worst) {
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  const trace_signal *signal = trace_find_signal(worst->what.signal);
  if (!signal || strcmp(worst->what.metric, "max") != 0) return;
  for (size_t k = 0; k < comparison_judged_rows(c); k++) {
    double time = a->rows[k].sample.time;
    if (gate_covers(worst->what.from, worst->what.to, time, c->scenario->sample) &&
        fabs(trace_value(&b->rows[k], signal) - trace_value(&a->rows[k], signal)) >
            worst->rule->limit) {
      comparison_say(c, ", beyond the limit from %g s on", time);
      return;
    }
  }
}

//---------------------------------- the start -----------------------------------------------------

// How closely the first rows must agree: the signal's own limit, else the strictest of the
// scenario.
static double start_limit(const comparison *c, const trace_signal *signal, double value) {
  double strictest = INFINITY;
  for (size_t i = 0; i < c->gates.count; i++) {
    const gate *g = &c->gates.items[i];
    if (strcmp(g->what.layer, layer_traces.name) != 0 || strcmp(g->what.metric, "max") != 0)
      continue;
    if (strcmp(g->what.signal, signal->name) == 0) return g->rule->limit;
    strictest = fmin(strictest, g->rule->limit);
  }
  static const double none = 1e-9; // of a scenario without such limits: far above rounding
  return (isfinite(strictest) ? strictest : none) * fmax(1, fabs(value));
}

static bool is_related(const relation *relations, int count, const trace_signal *signal) {
  for (int i = 0; i < count; i++)
    if (relations[i].signal == signal) return true;
  return false;
}

// "they start differently: speed 4.6 against 4, lean rate 0.5 against 0.1": candidate against
// reference, of every signal of motion that both know, gated or not. Returns how many differ.
static int say_start(comparison *c, const relation *relations, int count) {
  static const char *const signals[TRACE_MOTION_COUNT] = {
      "speed", "lean", "steer", "lean_rate",  "steer_rate", "x",
      "y",     "yaw",  "pitch", "rear_angle", "front_angle"};
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  int differ = 0;
  for (int i = 0; i < TRACE_MOTION_COUNT && comparison_rows(c) > 0; i++) {
    const trace_signal *signal = trace_find_signal(signals[i]);
    if (!trace_has(a, signal) || !trace_has(b, signal) || is_related(relations, count, signal))
      continue;
    double reference = trace_value(a->rows, signal), candidate = trace_value(b->rows, signal);
    if (!(fabs(candidate - reference) > start_limit(c, signal, reference))) continue;
    comparison_say(c, "%s %s %.9g against %.9g %s",
                   differ++ ? ","
                   : count  ? "; they start differently:"
                            : ": they start differently:",
                   comparison_words(signal->name).text, candidate, reference, signal->unit);
  }
  return differ;
}

//---------------------------------- a time offset -------------------------------------------------

// Lean and steer are late by the same time, which explains nearly all of how both differ.
static bool say_offset(comparison *c) {
  // Curvature between rows is not seen: it leaves some hundredths of the mean square, other faults
  // leave most of it.
  static const double explained = 0.95, alike = 0.1;
  const study_shift *lean = &c->study.shift[0], *steer = &c->study.shift[1];
  if (!(lean->share > explained && steer->share > explained &&
        fabs(steer->time - lean->time) < alike * fabs(lean->time)))
    return false;
  comparison_say(c,
                 ": a time offset, %s is late by %.6g s, which explains %.3g %% of the mean square "
                 "difference of lean and %.3g %% of steer",
                 comparison_name(c, CANDIDATE), lean->time, 100 * lean->share, 100 * steer->share);
  return true;
}

//---------------------------------- what was not asked --------------------------------------------

static bool starts_are_known(const comparison *c) {
  static const char *const state[] = {"lean", "steer", "lean_rate", "steer_rate", "speed"};
  for (int i = 0; i < 5; i++)
    for (int side = REFERENCE; side <= CANDIDATE; side++)
      if (!trace_has(&c->side[side].trace, trace_find_signal(state[i]))) return false;
  return true;
}

// "; asked and agreeing: Lp, L0, the first row; not told apart: integration"
static void say_not_asked(comparison *c) {
  const char *separator = "; asked and agreeing: ";
  bool instants = comparison_is_gated(c, &layer_instant);
  const struct {
    bool open;
    const char *name;
  } causes[] = {{!instants && !comparison_is_gated(c, &layer_parameters), "parameters"},
                {!instants, "equations"},
                {!starts_are_known(c), "start"},
                {scenario_has_input(&c->scenario->input), "input"},
                {c->study.convergence.count == 0, "integration"}};
  for (int i = 0; layer_at(i) && layer_at(i) != c->first_failure; i++)
    if (comparison_is_gated(c, layer_at(i))) {
      comparison_say(c, "%s%s", separator, layer_at(i)->name);
      separator = ", ";
    }
  comparison_say(c, "%sthe first row%s", separator,
                 starts_are_known(c) ? "" : " as far as both have it");
  separator = "; not told apart: ";
  for (size_t i = 0; i < sizeof causes / sizeof *causes; i++)
    if (causes[i].open) {
      comparison_say(c, "%s%s", separator, causes[i].name);
      separator = ", ";
    }
}

void comparison_explain_traces(comparison *c, const gate *worst) {
  relation relations[TRACE_MOTION_COUNT];
  int count = relations_find(relations, c);
  bool ends_early = strcmp(worst->what.signal, "end_time") == 0;
  comparison_say_agreed(c);
  comparison_say(c, "the rides differ, most in %s: ", comparison_words(worst->what.signal).text);
  comparison_say_limit(c, worst);
  say_since(c, worst);
  if (*worst->what.detail) comparison_say(c, " (%s)", worst->what.detail);
  relations_say(c, relations, count);
  bool found = say_start(c, relations, count) > 0 || count > 0 || say_offset(c);
  if (ends_early)
    comparison_say(c, found ? "; one of them ends early" : ": one of them ends early");
  if (found || ends_early) return;
  comparison_say_order(c);
  if (c->study.convergence.count == 0 || c->study.convergence.verdict == STUDY_SAME)
    say_not_asked(c);
}
