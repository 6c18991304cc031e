// SPDX-License-Identifier: Apache-2.0
// The rules of a scenario: `gates:` and the files with gates that several scenarios share.
#include "layer.h"
#include "scenario_keys.h"

#include "files/text.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LARGEST_FILE = 1 << 20 }; // bytes; ours have a few kB

static int read_layer(const bike_yaml *yaml, const bike_field *field, void *target) {
  char name[MEASUREMENT_NAME];
  int code = bike_yaml_text(yaml, field, name, sizeof name);
  if (code) return code;
  const layer *found = layer_find(name);
  if (!found) return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "'%s' is not a layer", name);
  *(const layer **)target = found;
  return BIKE_OK;
}

static int read_metric(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_text(yaml, field, target, MEASUREMENT_NAME);
}

static int read_reason(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_text(yaml, field, target, GATE_REASON);
}

// `target` is the rule's list of signals; the number of them is counted afterwards.
static int read_signals(const bike_yaml *yaml, const bike_field *field, void *target) {
  char(*signals)[MEASUREMENT_NAME] = target;
  int code = bike_yaml_expect_list(yaml, field);
  void *cursor = NULL;
  bike_field entry = *field;
  int count = 0;
  while (!code && bike_yaml_next_entry(field->value, &cursor, &entry)) {
    if (count == GATE_MAX_SIGNALS)
      return bike_yaml_fail(yaml, &entry, BIKE_ERROR_SYNTAX, "more than %d signals",
                            GATE_MAX_SIGNALS);
    code = bike_yaml_text(yaml, &entry, signals[count++], MEASUREMENT_NAME);
  }
  if (!code && count == 0)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must name a signal");
  return code;
}

// A limit that nothing is measured for would never be looked at.
static int check_names(const bike_yaml *yaml, const bike_field *where, const gate_rule *rule) {
  if (!rule->layer->knows(NULL, rule->metric))
    return bike_yaml_fail(yaml, where, BIKE_ERROR_SYNTAX, "layer %s has no metric '%s'",
                          rule->layer->name, rule->metric);
  for (int i = 0; i < rule->signal_count; i++)
    if (!rule->layer->knows(rule->signals[i], rule->metric))
      return bike_yaml_fail(yaml, where, BIKE_ERROR_SYNTAX,
                            "layer %s has no signal '%s' with the metric '%s'", rule->layer->name,
                            rule->signals[i], rule->metric);
  return BIKE_OK;
}

// An option that only one metric has; it would say nothing elsewhere.
static int check_only_for(const bike_yaml *yaml, const bike_field *where, const gate_rule *rule,
                          const char *key, const char *metric) {
  bike_field given;
  if (strcmp(rule->metric, metric) == 0 || !bike_yaml_find(where->value, key, &given))
    return BIKE_OK;
  return bike_yaml_fail(yaml, &given, BIKE_ERROR_SYNTAX, "only the metric '%s' has it", metric);
}

// What begins after the ride or between two rows would cost the whole ride and then fail. A ride
// that ends before its time is another matter.
static int check_rows(const bike_yaml *yaml, const bike_field *from, const gate_rule *rule,
                      const gate_rules *rules) {
  double duration = rules->duration, sample = rules->sample;
  if (!(duration > 0 && sample > 0)) return BIKE_OK; // their absence is said elsewhere
  if (!gate_covers(0, duration, rule->from, sample))
    return bike_yaml_fail(yaml, from, BIKE_ERROR_SYNTAX, "%g s is after the end of the ride, %g s",
                          rule->from, duration);
  double end = rule->to > 0 ? fmin(rule->to, duration) : duration;
  double row = floor(rule->from / sample) * sample; // the last that is not later, and the next
  if (gate_covers(rule->from, end, row, sample) ||
      gate_covers(rule->from, end, row + sample, sample))
    return BIKE_OK;
  return bike_yaml_fail(yaml, from, BIKE_ERROR_SYNTAX,
                        "no row lies from %g to %g s: there is one every %g s", rule->from, end,
                        sample);
}

// Only the metrics of L2 that sum up a ride can do so for a part of it.
static int check_window(const bike_yaml *yaml, const bike_field *where, const gate_rule *rule,
                        const gate_rules *rules) {
  bike_field from, to;
  bool has_from = bike_yaml_find(where->value, "from", &from);
  bool has_to = bike_yaml_find(where->value, "to", &to);
  if (!has_from && !has_to) return BIKE_OK;
  if (rule->layer != &layer_traces || strcmp(rule->metric, "difference") == 0)
    return bike_yaml_fail(yaml, has_from ? &from : &to, BIKE_ERROR_SYNTAX,
                          "the metric '%s' of layer %s has no window in time", rule->metric,
                          rule->layer->name);
  if (has_from && has_to && rule->from > rule->to)
    return bike_yaml_fail(yaml, &from, BIKE_ERROR_SYNTAX, "%g s is later than 'to', %g s",
                          rule->from, rule->to);
  return has_from ? check_rows(yaml, &from, rule, rules) : BIKE_OK; // the first row is at 0
}

static int check_options(const bike_yaml *yaml, const bike_field *where, const gate_rule *rule,
                         const gate_rules *rules) {
  bike_field limit;
  if (!rule->information && !bike_yaml_find(where->value, "limit", &limit))
    return bike_yaml_fail(yaml, where, BIKE_ERROR_SYNTAX,
                          "key 'limit' is missing, or 'info: true' where nothing is judged");
  int code = check_only_for(yaml, where, rule, "time_tolerance", "tube");
  if (!code) code = check_only_for(yaml, where, rule, "nominal", "nrmse");
  return code ? code : check_window(yaml, where, rule, rules);
}

static int add_rule(const bike_yaml *yaml, const bike_field *where, gate_rules *rules,
                    const gate_rule *rule) {
  if (rules->count == rules->room) {
    size_t room = rules->room ? 2 * rules->room : 16;
    gate_rule *items = realloc(rules->items, room * sizeof *items);
    if (!items) return bike_yaml_fail(yaml, where, BIKE_ERROR_MEMORY, "out of memory");
    rules->items = items;
    rules->room = room;
  }
  rules->items[rules->count++] = *rule;
  return BIKE_OK;
}

static int read_rule(const bike_yaml *yaml, const bike_field *where, gate_rules *rules) {
  static const bike_key keys[] = {
      {"layer", read_layer, offsetof(gate_rule, layer), true},
      {"metric", read_metric, offsetof(gate_rule, metric), true},
      {"signals", read_signals, offsetof(gate_rule, signals), false},
      {"limit", bike_yaml_not_negative, offsetof(gate_rule, limit), false},
      {"info", bike_yaml_flag, offsetof(gate_rule, information), false},
      {"from", bike_yaml_not_negative, offsetof(gate_rule, from), false},
      {"to", bike_yaml_positive, offsetof(gate_rule, to), false},
      {"nominal", bike_yaml_positive, offsetof(gate_rule, nominal), false},
      {"time_tolerance", bike_yaml_not_negative, offsetof(gate_rule, time_tolerance), false},
      {"reason", read_reason, offsetof(gate_rule, reason), true},
  };
  gate_rule rule = {0};
  int code = bike_yaml_expect_mapping(yaml, where);
  if (!code)
    code = bike_yaml_read(yaml, where, where->value, (bike_keys){keys, sizeof keys / sizeof *keys},
                          &rule);
  if (code) return code;
  while (rule.signal_count < GATE_MAX_SIGNALS && *rule.signals[rule.signal_count])
    rule.signal_count++;
  code = check_names(yaml, where, &rule);
  if (!code) code = check_options(yaml, where, &rule, rules);
  return code ? code : add_rule(yaml, where, rules, &rule);
}

int scenario_read_gates(const bike_yaml *yaml, const bike_field *field, void *target) {
  int code = bike_yaml_expect_list(yaml, field);
  void *cursor = NULL;
  bike_field entry = *field;
  while (!code && bike_yaml_next_entry(field->value, &cursor, &entry))
    code = read_rule(yaml, &entry, target);
  return code;
}

int scenario_include_gates(gate_rules *out, const char *path, bike_file_error *error) {
  static const bike_key keys[] = {{"gates", scenario_read_gates, 0, true}};
  bike_text text;
  bike_yaml yaml;
  int code = bike_text_read(&text, path, LARGEST_FILE, error);
  if (code) return code;
  code = bike_yaml_open(&yaml, &text, path, error);
  if (!code) code = bike_yaml_read(&yaml, NULL, yaml.root, (bike_keys){keys, 1}, out);
  bike_yaml_close(&yaml);
  bike_text_free(&text);
  return code;
}
