// SPDX-License-Identifier: Apache-2.0
#include "scenario.h"

#include "scenario_keys.h"
#include "terminal/data.h"
#include "terminal/message.h"

#include "files/text.h"

#include <bicycle_import.h>

#include <bicycle/error.h>
#include <bicycle/file.h>
#include <bicycle/ride.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  LARGEST_FILE = 1 << 20, // bytes; ours have a few kB
  MOST_ROWS = 1000000,    // some hundred MB for two engines
  MOST_INSTANTS = 1000000
};

static int read_title(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_text(yaml, field, ((scenario *)target)->title, SCENARIO_TITLE);
}

static bool is_model(const char *path) {
  size_t length = strlen(path);
  const char *end = path + (length < 4 ? length : length - 4);
  return strcmp(end, ".xml") == 0 || strcmp(end, ".mjb") == 0;
}

// A MuJoCo model: the bicycle is read out of it.
static int read_model(scenario *s, const bike_yaml *yaml, const bike_field *field,
                      const char *path) {
  mjcf_error error = {.text = ""};
  mjModel *model = mjcf_load(path, &error);
  bool found = model && import_bicycle(&s->bicycle, NULL, model, &error);
  if (found) import_stops(s->stops, sizeof s->stops, model);
  if (model) mj_deleteModel(model);
  if (!found)
    return bike_yaml_fail(yaml, field, error.no_memory ? BIKE_ERROR_MEMORY : BIKE_ERROR_PARAMETER,
                          "%s: %s", path, error.text);
  snprintf(s->model_path, sizeof s->model_path, "%s", path);
  return BIKE_OK;
}

// Names beside the scenario, so that the current folder does not matter; a bare name is a shipped
// bicycle's.
static int read_bicycle(const bike_yaml *yaml, const bike_field *field, void *target) {
  scenario *s = target;
  char path[SCENARIO_PATH];
  bike_file_error error;
  bike_file file;
  int code = bike_yaml_text(yaml, field, s->bicycle_name, sizeof s->bicycle_name);
  if (code) return code;
  bool bare = !strpbrk(s->bicycle_name, "/.");
  if (!(bare ? term_bicycle_path(path, s->bicycle_name)
             : scenario_relative_path(path, s->path, s->bicycle_name)))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_FILE, "the path is too long");
  if (is_model(path)) {
    code = read_model(s, yaml, field, path);
    if (code) return code;
  } else {
    code = bike_file_read(&file, path, &error);
    if (code) return bike_yaml_fail(yaml, field, code, "%s", error.text);
    s->bicycle = file.bicycle;
  }
  code = bike_model_init(&s->model, &s->bicycle);
  if (code) return bike_yaml_fail(yaml, field, code, "%s: %s", path, bike_error_string(code));
  return BIKE_OK;
}

// The rider sits beside his place, to the right: in the bicycle itself, so that every engine has
// it.
static int read_rider_offset(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_number(yaml, field, &((scenario *)target)->rider_offset);
}

static int displace_rider(const bike_yaml *yaml, scenario *s) {
  bike_field field = {.key = "rider_offset"};
  if (s->rider_offset == 0) return BIKE_OK;
  bike_yaml_find(yaml->root, field.key, &field);
  for (int i = 0; i < s->bicycle.part_count; i++) {
    if (!s->bicycle.parts[i].rider) continue;
    s->bicycle.parts[i].position[1] -= s->rider_offset;
    int code = bike_model_init(&s->model, &s->bicycle);
    return code ? bike_yaml_fail(yaml, &field, code, "%s", bike_error_string(code)) : BIKE_OK;
  }
  return bike_yaml_fail(yaml, &field, BIKE_ERROR_NO_RIDER, "%s",
                        bike_error_string(BIKE_ERROR_NO_RIDER));
}

static int read_start(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const bike_key keys[] = {
      {"lean", bike_yaml_angle, offsetof(bike_state, lean), false},
      {"steer", bike_yaml_angle, offsetof(bike_state, steer), false},
      {"lean_rate", bike_yaml_number, offsetof(bike_state, lean_rate), false},
      {"steer_rate", bike_yaml_number, offsetof(bike_state, steer_rate), false},
      {"speed", bike_yaml_number, offsetof(bike_state, speed), true},
  };
  int code = bike_yaml_expect_mapping(yaml, field);
  if (code) return code;
  return bike_yaml_read(yaml, field, field->value, (bike_keys){keys, sizeof keys / sizeof *keys},
                        &((scenario *)target)->start);
}

static int read_duration(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_positive(yaml, field, &((scenario *)target)->duration);
}

static int read_sample(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_positive(yaml, field, &((scenario *)target)->sample);
}

static int read_growth(const bike_yaml *yaml, const bike_field *field, void *target) {
  scenario_growth *growth = &((scenario *)target)->growth;
  growth->unstable_mode = bike_yaml_is_text(field, "unstable-mode");
  return growth->unstable_mode ? BIKE_OK : bike_yaml_not_negative(yaml, field, &growth->rate);
}

int scenario_read_whole(const bike_yaml *yaml, const bike_field *field, double most, double *out) {
  int code = bike_yaml_not_negative(yaml, field, out);
  if (!code && (*out > most || *out != floor(*out)))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be a whole number up to %.0f",
                          most);
  return code;
}

static int read_count(const bike_yaml *yaml, const bike_field *field, void *target) {
  double number;
  int code = scenario_read_whole(yaml, field, MOST_INSTANTS, &number);
  if (!code) *(int *)target = (int)number;
  return code;
}

static int read_seed(const bike_yaml *yaml, const bike_field *field, void *target) {
  double number;
  int code = scenario_read_whole(yaml, field, 0x1p53,
                                 &number); // beyond, not every whole number is a double
  if (!code) *(uint64_t *)target = (uint64_t)number;
  return code;
}

static int read_largest_angle(const bike_yaml *yaml, const bike_field *field, void *target) {
  int code = bike_yaml_not_negative(yaml, field, target);
  return code ? code : bike_yaml_angle(yaml, field, target);
}

static int read_instants(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const bike_key keys[] = {
      {"count", read_count, offsetof(scenario_instants, count), false},
      {"seed", read_seed, offsetof(scenario_instants, seed), false},
      {"lean", read_largest_angle, offsetof(scenario_instants, lean), false},
      {"steer", read_largest_angle, offsetof(scenario_instants, steer), false},
      {"rate", bike_yaml_not_negative, offsetof(scenario_instants, rate), false},
      {"slow", bike_yaml_number, offsetof(scenario_instants, slow), false},
      {"fast", bike_yaml_number, offsetof(scenario_instants, fast), false},
  };
  scenario_instants *instants = &((scenario *)target)->instants;
  int code = bike_yaml_expect_mapping(yaml, field);
  if (!code)
    code = bike_yaml_read(yaml, field, field->value, (bike_keys){keys, sizeof keys / sizeof *keys},
                          instants);
  if (!code && !(instants->slow <= instants->fast))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "'slow' is above 'fast'");
  return code;
}

static int read_reference(const bike_yaml *yaml, const bike_field *field, void *target) {
  return scenario_read_engine(yaml, field, &((scenario *)target)->reference);
}

static int read_candidate(const bike_yaml *yaml, const bike_field *field, void *target) {
  return scenario_read_engine(yaml, field, &((scenario *)target)->candidate);
}

static int read_gates(const bike_yaml *yaml, const bike_field *field, void *target) {
  return scenario_read_gates(yaml, field, &((scenario *)target)->rules);
}

// Files whose gates come first, so that the scenario's own judge in their place.
static int read_include(const bike_yaml *yaml, const bike_field *field, void *target) {
  scenario *s = target;
  int code = bike_yaml_expect_list(yaml, field);
  void *cursor = NULL;
  bike_field entry = *field;
  if (!code && s->rules.count > 0)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must stand before 'gates'");
  while (!code && bike_yaml_next_entry(field->value, &cursor, &entry)) {
    char name[SCENARIO_PATH], path[SCENARIO_PATH];
    bike_file_error error;
    code = bike_yaml_text(yaml, &entry, name, sizeof name);
    if (code) return code;
    if (!scenario_relative_path(path, s->path, name))
      return bike_yaml_fail(yaml, &entry, BIKE_ERROR_FILE, "the path is too long");
    code = scenario_include_gates(&s->rules, path, &error);
    if (code) return bike_yaml_fail(yaml, &entry, code, "%s", error.text);
  }
  return code;
}

// Windows of gates lie within the ride: how long it is must be known before they are read, wherever
// in the file it stands. Whether it is there at all is said when all keys are read.
static int read_times(const bike_yaml *yaml, scenario *s) {
  bike_field field;
  int code = BIKE_OK;
  if (bike_yaml_find(yaml->root, "duration", &field)) code = read_duration(yaml, &field, s);
  if (!code && bike_yaml_find(yaml->root, "sample", &field)) code = read_sample(yaml, &field, s);
  s->rules.duration = s->duration;
  s->rules.sample = s->sample;
  return code;
}

static const bike_key scenario_keys[] = {
    {"title", read_title, 0, true},
    {"bicycle", read_bicycle, 0, true},
    {"start", read_start, 0, true},
    {"duration", read_duration, 0, true},
    {"sample", read_sample, 0, true},
    {"growth", read_growth, 0, false},
    {"instants", read_instants, 0, false},
    {"reference", read_reference, 0, true},
    {"candidate", read_candidate, 0, true},
    {"include", read_include, 0, false},
    {"gates", read_gates, 0, false},
    {"linear", scenario_read_linear, offsetof(scenario, linear), false},
    {"convergence", scenario_read_convergence, offsetof(scenario, convergence), false},
    {"horizon", scenario_read_horizon, offsetof(scenario, horizon), false},
    {"rider_offset", read_rider_offset, 0, false},
    {"cost", scenario_read_cost, offsetof(scenario, cost), false},
    {"steer_torque", bike_yaml_number, offsetof(scenario, input.steer_torque), false},
    {"roll_torque", bike_yaml_number, offsetof(scenario, input.roll_torque), false},
    {"input", scenario_read_input_file, offsetof(scenario, input), false},
};

static bool judges(const gate_rules *rules) {
  for (size_t i = 0; i < rules->count; i++)
    if (!rules->items[i].information) return true;
  return false;
}

double scenario_lean_limit(void) {
  return bike_default_ride_def().lean_limit;
}

// A ride that ends where it starts says nothing, and what lies flat has no coordinates.
static int check_start(const bike_yaml *yaml, const scenario *s) {
  bike_field start, lean;
  if (fabs(s->start.lean) < scenario_lean_limit()) return BIKE_OK;
  bike_yaml_find(yaml->root, "start", &start);
  bike_yaml_find(start.value, "lean", &lean);
  return bike_yaml_fail(yaml, &lean, BIKE_ERROR_SYNTAX,
                        "%g rad is too much: rides end at a lean of %g rad", s->start.lean,
                        scenario_lean_limit());
}

// What no single key can be blamed for.
static int check_whole(const bike_yaml *yaml, const scenario *s) {
  bike_field field = {.key = "sample"};
  bike_yaml_find(yaml->root, "sample", &field);
  if (s->sample > s->duration)
    return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX, "is longer than the duration");
  if (s->duration / s->sample > MOST_ROWS)
    return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX, "asks for more than %d rows", MOST_ROWS);
  if (!judges(&s->rules))
    return bike_yaml_fail(yaml, NULL, BIKE_ERROR_SYNTAX,
                          "nothing is judged: neither 'gates' nor 'include' names a gate");
  return BIKE_OK;
}

// The keys come in any order, so that engines learn of model and rider at the end.
static void tell_engines(scenario *s) {
  engine_choice *choice[2] = {&s->reference, &s->candidate};
  for (int i = 0; i < 2; i++) {
    memcpy(choice[i]->model, s->model_path, sizeof s->model_path);
    choice[i]->moving_rider = s->input.table && bike_input_table_has_rider(s->input.table);
  }
}

// A file may move the rider only where there is one.
static int check_rider(const bike_yaml *yaml, const scenario *s) {
  bike_field field = {.key = "input"};
  if (!s->input.table || !bike_input_table_has_rider(s->input.table) || s->model.rider_mass > 0)
    return BIKE_OK;
  bike_yaml_find(yaml->root, field.key, &field);
  return bike_yaml_fail(yaml, &field, BIKE_ERROR_NO_RIDER, "%s: rider_offset: %s", s->input.path,
                        bike_error_string(BIKE_ERROR_NO_RIDER));
}

static int parse(scenario *s, bike_file_error *error) {
  bike_text text;
  bike_yaml yaml;
  bike_keys keys = {scenario_keys, sizeof scenario_keys / sizeof *scenario_keys};
  int code = bike_text_read(&text, s->path, LARGEST_FILE, error);
  if (code) return code;
  code = bike_yaml_open(&yaml, &text, s->path, error);
  if (!code) code = read_times(&yaml, s);
  if (!code) code = bike_yaml_read(&yaml, NULL, yaml.root, keys, s);
  if (!code) code = check_start(&yaml, s);
  if (!code) code = check_whole(&yaml, s);
  if (!code) code = displace_rider(&yaml, s);
  if (!code) code = scenario_load_input(&yaml, &s->input, s->duration);
  if (!code) code = check_rider(&yaml, s);
  tell_engines(s);
  if (!code) code = scenario_check_studies(&yaml, s);
  bike_yaml_close(&yaml);
  bike_text_free(&text);
  return code;
}

// Well within what every shipped bicycle can do, and far from upright.
static const scenario_instants default_instants = {
    .count = 100, .seed = 1, .lean = 0.5, .steer = 0.6, .rate = 2, .slow = 1, .fast = 10};

term_exit scenario_read(scenario *out, const char *path, problem *p) {
  bike_file_error error;
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
  const char *point = strrchr(base, '.');
  size_t length = point && point > base ? (size_t)(point - base) : strlen(base);
  *out = (scenario){.instants = default_instants};
  if (strlen(path) >= sizeof out->path)
    return problem_set(p, TERM_USAGE, "%.100s...: the path is too long", path);
  if (length == 0 || length >= sizeof out->name)
    return problem_set(p, TERM_USAGE, "%s: the name of a scenario has 1 to %d characters", path,
                       SCENARIO_NAME - 1);
  strcpy(out->path, path);
  bike_text_name(out->name, sizeof out->name, base, length); // links, files and JSON hold it
  int code = parse(out, &error);
  if (code == BIKE_OK) return TERM_DONE;
  scenario_clear(out);
  return problem_set(p, term_exit_of(code), "%s", error.text);
}

void scenario_clear(scenario *s) {
  free(s->rules.items);
  s->rules = (gate_rules){0};
  bike_input_table_free(s->input.table);
  s->input = (scenario_input){0};
}
