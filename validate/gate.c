// SPDX-License-Identifier: Apache-2.0
#include "gate.h"

#include "layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool names_signal(const gate_rule *rule, const char *signal) {
  for (int i = 0; i < rule->signal_count; i++)
    if (strcmp(rule->signals[i], signal) == 0) return true;
  return rule->signal_count == 0;
}

bool gate_covers(double from, double to, double time, double sample) {
  double slack = 1e-6 * sample;
  return time >= from - slack && (to == 0 || time <= to + slack);
}

bool gate_rule_names(const gate_rule *rule, const measurement *m) {
  return strcmp(rule->layer->name, m->layer) == 0 && strcmp(rule->metric, m->metric) == 0 &&
         names_signal(rule, m->signal);
}

// Another part of the ride is another measurement.
static bool fits(const gate_rule *rule, const measurement *m) {
  return gate_rule_names(rule, m) && rule->from == m->from && rule->to == m->to;
}

// The rules of a layer name no layer: they are its own.
static const gate_rule *own_rule(const measurement *m) {
  const layer *l = layer_find(m->layer);
  for (int i = 0; l && i < l->rule_count; i++)
    if (strcmp(l->rules[i].metric, m->metric) == 0 && names_signal(&l->rules[i], m->signal))
      return &l->rules[i];
  return NULL;
}

const gate_rule *gate_rule_for(const measurement *m, const gate_rules *rules) {
  for (size_t i = rules->count; i-- > 0;)
    if (fits(&rules->items[i], m)) return &rules->items[i];
  return own_rule(m);
}

bool gate_limits_max(const gate_rule *rule, const gate_rules *rules, const char *signal) {
  measurement m = measurement_of(layer_traces.name, signal, "max", "");
  m.from = rule->from;
  m.to = rule->to;
  return !rule->information && gate_rule_for(&m, rules) == rule;
}

static bool add(gate_list *list, const measurement *m, const gate_rule *rule) {
  gate *items = realloc(list->items, (list->count + 1) * sizeof *items);
  if (!items) return false;
  list->items = items;
  items[list->count++] = (gate){*m, rule, m->value <= rule->limit};
  return true;
}

static bool was_measured(const measurement_list *list, const gate_rule *rule, const char *signal) {
  for (size_t i = 0; i < list->count; i++)
    if (fits(rule, &list->items[i]) && (!signal || strcmp(list->items[i].signal, signal) == 0))
      return true;
  return false;
}

// A gate that fails for each signal of a rule that no engine has measured.
static bool add_missing(gate_list *out, const measurement_list *list, const gate_rule *rule) {
  int count = rule->signal_count ? rule->signal_count : 1;
  for (int i = 0; i < count; i++) {
    const char *signal = rule->signal_count ? rule->signals[i] : NULL;
    if (was_measured(list, rule, signal)) continue;
    measurement m = measurement_of(rule->layer->name, signal ? signal : "any", rule->metric, "");
    m.from = rule->from;
    m.to = rule->to;
    measurement_detail(&m, "no engine of this scenario measures it");
    if (!add(out, &m, rule)) return false;
  }
  return true;
}

static bool is_measured_layer(const layer *l, int measured_layers) {
  for (int i = 0; i < measured_layers; i++)
    if (layer_at(i) == l) return true;
  return false;
}

bool gates_judge(gate_list *out, const measurement_list *measurements, const gate_rules *rules,
                 int measured_layers) {
  for (size_t i = 0; i < measurements->count; i++) {
    const gate_rule *rule = gate_rule_for(&measurements->items[i], rules);
    if (rule && !rule->information && !add(out, &measurements->items[i], rule)) return false;
  }
  for (size_t i = 0; i < rules->count; i++)
    if (!rules->items[i].information && is_measured_layer(rules->items[i].layer, measured_layers) &&
        !add_missing(out, measurements, &rules->items[i]))
      return false;
  return !measurements->lost;
}

void gates_clear(gate_list *list) {
  free(list->items);
  *list = (gate_list){0};
}

double gate_use(const gate *g) {
  if (g->what.value == 0) return 0;
  if (isnan(g->what.value)) return INFINITY;
  return g->what.value / g->rule->limit;
}
