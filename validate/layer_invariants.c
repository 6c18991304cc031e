// SPDX-License-Identifier: Apache-2.0
// L3: what must hold for each ride by itself: energy, wheels that stay on the ground and roll.
#include "layer.h"

#include "metrics.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Columns of a trace, one after the other in time.
typedef struct columns {
  double *time, *value;
  size_t count;
} columns;

static void add(comparison *c, const comparison_side *side, const char *signal, const char *metric,
                const char *unit, metrics_peak peak) {
  measurement m = measurement_of(layer_invariants.name, signal, metric, unit);
  snprintf(m.source, sizeof m.source, "%s", side->label);
  m.value = peak.value;
  m.time = peak.time;
  measurement_add(&c->measurements, &m);
}

static void load(columns *out, const trace *t, const char *name) {
  const trace_signal *signal = trace_find_signal(name);
  for (size_t k = 0; k < out->count; k++) out->value[k] = trace_value(&t->rows[k], signal);
}

// Balance: (E(t) - E(0) - work) / E(0). IFToMM's criterion for its benchmark 'uncontrolled
// bicycle': 100 (Emax - Emin) / E0, a percentage, of rides on which no work is done.
static void measure_energy(comparison *c, const comparison_side *side, columns *v) {
  const trace *t = &side->trace;
  double start = t->rows[0].sample.energy;
  load(v, t, "energy");
  metrics_peak spread = {100 * metrics_spread(v->value, v->count) / start, NAN};
  for (size_t k = 0; k < v->count; k++)
    v->value[k] = (v->value[k] - start - t->rows[k].more.work) / start;
  add(c, side, "energy", "balance_max", "", metrics_max(v->time, v->value, v->count));
  add(c, side, "energy", "balance_end", "",
      (metrics_peak){fabs(v->value[v->count - 1]), v->time[v->count - 1]});
  add(c, side, "energy", "spread_percent", "%", spread);
}

static bool has(const comparison_side *side, const char *name) {
  return trace_has(&side->trace, trace_find_signal(name));
}

static void measure_peak(comparison *c, const comparison_side *side, columns *v, const char *name) {
  if (!has(side, name)) return;
  load(v, &side->trace, name);
  add(c, side, name, "max", trace_find_signal(name)->unit,
      metrics_max(v->time, v->value, v->count));
}

static void measure_smallest(comparison *c, const comparison_side *side, columns *v,
                             const char *name) {
  metrics_peak low = {NAN, NAN};
  if (!has(side, name)) return;
  load(v, &side->trace, name);
  for (size_t k = 0; k < v->count; k++)
    if (!(v->value[k] >= low.value)) low = (metrics_peak){v->value[k], v->time[k]};
  add(c, side, name, "min", trace_find_signal(name)->unit, low);
}

static const char *const contacts[] = {"rear_slip", "front_slip", "rear_height", "front_height",
                                       NULL};
static const char *const demands[] = {"rear_friction", "front_friction", NULL};
static const char *const loads[] = {"rear_normal", "front_normal", NULL};

static term_exit measure_side(comparison *c, const comparison_side *side, problem *p) {
  size_t count = side->trace.count;
  if (count == 0) return problem_set(p, TERM_INVALID, "%s: the ride has no row", side->label);
  columns v = {calloc(count, sizeof(double)), calloc(count, sizeof(double)), count};
  bool ready = v.time && v.value;
  if (ready) {
    for (size_t k = 0; k < count; k++) v.time[k] = side->trace.rows[k].sample.time;
    if (has(side, "energy") && has(side, "work")) measure_energy(c, side, &v);
    for (int i = 0; side->trace.has_contacts && contacts[i]; i++)
      measure_peak(c, side, &v, contacts[i]);
    for (int i = 0; demands[i]; i++) measure_peak(c, side, &v, demands[i]);
    for (int i = 0; loads[i]; i++) measure_smallest(c, side, &v, loads[i]);
  }
  free(v.time);
  free(v.value);
  return ready ? TERM_DONE : problem_memory(p);
}

static term_exit measure(comparison *c, problem *p) {
  term_exit code = comparison_ride(c, p);
  for (int i = 0; i < 2 && code == TERM_DONE; i++) code = measure_side(c, &c->side[i], p);
  return code;
}

// The smallest normal force is information: a gate is an upper limit.
static bool knows(const char *signal, const char *metric) {
  static const char *const energy[] = {"balance_max", "balance_end", "spread_percent", NULL};
  if (layer_names(energy, metric)) return !signal || strcmp(signal, "energy") == 0;
  if (strcmp(metric, "max") != 0) return false;
  return !signal || layer_names(contacts, signal) || layer_names(demands, signal);
}

// What a gate of the scenario judges; work is part of the energy's balance.
static bool needs(const comparison *c, const trace_signal *signal, size_t row) {
  const gate_rules *rules = &c->scenario->rules;
  const char *name = strcmp(signal->name, "work") == 0 ? "energy" : signal->name;
  (void)row;
  for (size_t i = 0; i < rules->count; i++) {
    const gate_rule *rule = &rules->items[i];
    const measurement m = measurement_of(layer_invariants.name, name, rule->metric, "");
    if (!rule->information && gate_rule_names(rule, &m) && knows(name, rule->metric)) return true;
  }
  return false;
}

const layer layer_invariants = {
    .name = "L3",
    .title = "invariants",
    .agreed = "each ride keeps the laws that hold for every ride",
    .failure = "an engine breaks a law that holds for every ride",
    .knows = knows,
    .needs = needs,
    .measure = measure,
};
