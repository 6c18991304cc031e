// SPDX-License-Identifier: Apache-2.0
// What a scenario asks beyond two rides: `linear`, `convergence`, `horizon`, `cost`.
#include "gate.h"
#include "scenario_keys.h"

#include <bicycle/error.h>
#include <math.h>

static int read_mapping(const bike_yaml *yaml, const bike_field *field, const bike_key *key,
                        int count, void *target) {
  int code = bike_yaml_expect_mapping(yaml, field);
  return code ? code : bike_yaml_read(yaml, field, field->value, (bike_keys){key, count}, target);
}

static int read_count(const bike_yaml *yaml, const bike_field *field, int least, int most,
                      int *out) {
  double number;
  int code = scenario_read_whole(yaml, field, most, &number);
  if (!code && number < least)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be at least %d", least);
  if (!code) *out = (int)number;
  return code;
}

//---------------------------------- L1 ------------------------------------------------------------

static int read_speeds(const bike_yaml *yaml, const bike_field *field, void *target) {
  scenario_linear *linear = target;
  double ends[2];
  int code = bike_yaml_numbers(yaml, field, ends, 2);
  if (!code && !(ends[0] >= 0 && ends[0] < ends[1]))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be two rising speeds from 0 on");
  linear->slow = ends[0];
  linear->fast = ends[1];
  return code;
}

static int read_speed_count(const bike_yaml *yaml, const bike_field *field, void *target) {
  return read_count(yaml, field, 2, 1000, &((scenario_linear *)target)->count);
}

int scenario_read_linear(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const bike_key keys[] = {{"speeds", read_speeds, 0, true},
                                  {"count", read_speed_count, 0, true}};
  return read_mapping(yaml, field, keys, 2, target);
}

//---------------------------------- L4 ------------------------------------------------------------

enum { LEAST_STEPS = 4 }; // three terms of the error, and one more to doubt them

static int read_steps(const bike_yaml *yaml, const bike_field *field, void *target) {
  scenario_convergence *study = target;
  int code = bike_yaml_expect_list(yaml, field);
  void *cursor = NULL;
  bike_field entry = *field;
  while (!code && bike_yaml_next_entry(field->value, &cursor, &entry)) {
    if (study->count == SCENARIO_MAX_STEPS)
      return bike_yaml_fail(yaml, &entry, BIKE_ERROR_SYNTAX, "more than %d steps",
                            SCENARIO_MAX_STEPS);
    double *step = &study->step[study->count];
    code = bike_yaml_positive(yaml, &entry, step);
    if (!code && study->count > 0 && !(*step < step[-1]))
      return bike_yaml_fail(yaml, &entry, BIKE_ERROR_SYNTAX, "the steps must fall");
    study->count++;
  }
  if (!code && study->count < LEAST_STEPS)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "at least %d steps are needed",
                          LEAST_STEPS);
  return code;
}

static int read_expectation(const bike_yaml *yaml, const bike_field *field, void *target) {
  scenario_convergence *study = target;
  study->different = bike_yaml_is_text(field, "different-model");
  if (study->different || bike_yaml_is_text(field, "same-equations")) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX,
                        "is neither same-equations nor different-model");
}

int scenario_read_convergence(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const bike_key keys[] = {
      {"timesteps", read_steps, 0, true},
      {"tolerance", bike_yaml_positive, offsetof(scenario_convergence, tolerance), true},
      {"order", bike_yaml_positive, offsetof(scenario_convergence, order), false},
      {"expect", read_expectation, 0, false},
  };
  ((scenario_convergence *)target)->order = NAN;
  return read_mapping(yaml, field, keys, 4, target);
}

//---------------------------------- L5, L6 --------------------------------------------------------

static int read_share(const bike_yaml *yaml, const bike_field *field, void *target) {
  double *share = target;
  int code = bike_yaml_positive(yaml, field, share);
  if (!code && *share > 1)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be at most 1");
  return code;
}

int scenario_read_horizon(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const bike_key keys[] = {{"share", read_share, offsetof(scenario_horizon, share), true}};
  ((scenario_horizon *)target)->asked = true;
  return read_mapping(yaml, field, keys, 1, target);
}

static int read_repeats(const bike_yaml *yaml, const bike_field *field, void *target) {
  return read_count(yaml, field, 1, 100, &((scenario_cost *)target)->repeats);
}

int scenario_read_cost(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const bike_key keys[] = {{"repeats", read_repeats, 0, true}};
  return read_mapping(yaml, field, keys, 1, target);
}

//---------------------------------- before anything is ridden -------------------------------------

static bool limits_a_signal(const gate_rules *rules) {
  for (size_t i = 0; i < rules->count; i++)
    for (int k = 0; k < TRACE_SIGNAL_COUNT; k++)
      if (gate_limits_max(&rules->items[i], rules, trace_signals[k].name)) return true;
  return false;
}

int scenario_check_studies(const bike_yaml *yaml, const scenario *s) {
  bike_field field;
  if (s->convergence.count > 0 && !(engine_order(&s->candidate) > 0)) {
    bike_yaml_find(yaml->root, "convergence", &field);
    return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX,
                          "the engine '%s' chooses its steps itself", s->candidate.engine->name);
  }
  if (s->horizon.asked && !limits_a_signal(&s->rules)) {
    bike_yaml_find(yaml->root, "horizon", &field);
    return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX,
                          "no gate limits 'max' of a signal of layer L2");
  }
  return BIKE_OK;
}
