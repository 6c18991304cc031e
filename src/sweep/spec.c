// SPDX-License-Identifier: Apache-2.0
#include "spec.h"

#include "files/message.h"
#include "files/text.h"
#include "spec_axis.h"
#include "terminal/data.h"

#include <bicycle/basin.h>
#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Long lists are welcome; libfyaml needs some 400 times as much memory.
static const size_t LARGEST_SPEC = 256 * 1024;
static const size_t LARGEST_BICYCLE = 256 * 1024; // as of bike_file_read

// Seeds that a YAML number can say exactly.
static const double LARGEST_SEED = 9007199254740992.0; // 2^53

// Riding straight is settled when it has lasted for a second.
static const double SHORTEST_RIDE = 2; // s

const sweep_axis *sweep_find_axis(const sweep_spec *spec, sweep_target target) {
  for (int i = 0; i < spec->axis_count; i++)
    if (spec->axes[i].target == target) return &spec->axes[i];
  return NULL;
}

void sweep_spec_free(sweep_spec *spec) {
  for (int i = 0; i < spec->axis_count; i++) free(spec->axes[i].list);
  bike_parameters_free(spec->parameters);
  *spec = (sweep_spec){0};
}

// ---- single keys ----

static int read_outputs(const bike_yaml *yaml, const bike_field *field, void *target) {
  sweep_spec *spec = target;
  int code = bike_yaml_expect_list(yaml, field);
  void *cursor = NULL;
  bike_field entry = *field;
  while (!code && bike_yaml_next_entry(field->value, &cursor, &entry)) {
    int found = 0;
    while (found < SWEEP_OUTPUT_COUNT &&
           !bike_yaml_is_text(&entry, sweep_output_name((sweep_output)found)))
      found++;
    if (found == SWEEP_OUTPUT_COUNT)
      return bike_yaml_fail(yaml, &entry, BIKE_ERROR_SYNTAX,
                            "must be weave_speed, capsize_speed, stable_ranges, eps_max, "
                            "turn_eps_max, outcome or time");
    for (int i = 0; i < spec->output_count; i++)
      if ((int)spec->outputs[i] == found)
        return bike_yaml_fail(yaml, &entry, BIKE_ERROR_SYNTAX, "'%s' is given twice",
                              sweep_output_name((sweep_output)found));
    spec->outputs[spec->output_count++] = (sweep_output)found;
  }
  if (code || spec->output_count > 0) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "the list is empty");
}

static int read_seed(const bike_yaml *yaml, const bike_field *field, void *target) {
  sweep_spec *spec = target;
  double seed;
  const int code = sweep_read_whole(&seed, yaml, field, 0, LARGEST_SEED);
  if (code) return code;
  spec->seed = (uint64_t)seed;
  spec->has_seed = true;
  return BIKE_OK;
}

static int read_draws(const bike_yaml *yaml, const bike_field *field, void *target) {
  double draws;
  const int code = sweep_read_whole(&draws, yaml, field, 1, SWEEP_MOST_POINTS);
  if (!code) *(long *)target = (long)draws;
  return code;
}

static int read_front(const bike_yaml *yaml, const bike_field *field, void *target) {
  bike_front_hold *hold = target;
  const bool on_axis = bike_yaml_is_text(field, "on_axis");
  *hold = on_axis ? BIKE_FRONT_ON_AXIS : BIKE_FRONT_IN_SPACE;
  if (on_axis || bike_yaml_is_text(field, "in_space")) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be in_space or on_axis");
}

static int read_search(const bike_yaml *yaml, const bike_field *field, void *target) {
  double *search = target;
  const int code = bike_yaml_numbers(yaml, field, search, 2);
  if (code || (search[0] >= 0 && search[0] < search[1])) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "must be [LOW, HIGH], 0 <= LOW < HIGH");
}

static int read_ride_time(const bike_yaml *yaml, const bike_field *field, void *target) {
  const int code = bike_yaml_number(yaml, field, target);
  if (code || *(double *)target >= SHORTEST_RIDE) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER,
                        "is too short to tell an outcome (%g s or more)", SHORTEST_RIDE);
}

static int read_start_speed(const bike_yaml *yaml, const bike_field *field, void *target) {
  *(bool *)target = bike_yaml_is_text(field, "same_energy");
  if (*(bool *)target || bike_yaml_is_text(field, "given")) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be given or same_energy");
}

static int read_ride(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const bike_key keys[] = {
      {"time", read_ride_time, offsetof(sweep_spec, ride_time), false},
      {"settled", bike_yaml_positive, offsetof(sweep_spec, settled), false},
      {"start_speed", read_start_speed, offsetof(sweep_spec, same_energy), false},
  };
  const int code = bike_yaml_expect_mapping(yaml, field);
  return code ? code : bike_yaml_read(yaml, field, field->value, (bike_keys){keys, 3}, target);
}

static int read_axes(const bike_yaml *yaml, const bike_field *field, void *target) {
  int code = bike_yaml_expect_mapping(yaml, field);
  void *cursor = NULL;
  bike_field axis;
  while (!code && bike_yaml_next(field->value, &cursor, &axis))
    code = sweep_read_axis(target, yaml, &axis);
  if (code || ((sweep_spec *)target)->axis_count > 0) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "holds no axis");
}

// ---- the bicycle ----

// A shipped name, or a path from the folder of the spec.
static bool bicycle_path(char out[TERM_PATH_SIZE], const char *name, const char *spec_path) {
  const char *slash = strrchr(spec_path, '/');
  if (!strpbrk(name, "/.")) return term_bicycle_path(out, name);
  const int folder = slash && name[0] != '/' ? (int)(slash - spec_path) + 1 : 0;
  return snprintf(out, TERM_PATH_SIZE, "%.*s%s", folder, spec_path, name) < TERM_PATH_SIZE;
}

// Both texts, so that neither can change between a start and a restart.
static int hash_texts(sweep_spec *spec, const bike_text *text, const char *path,
                      bike_file_error *error) {
  bike_text bicycle;
  const int code = bike_text_read(&bicycle, path, LARGEST_BICYCLE, error);
  if (code) return code;
  char both[2 * SHA256_HEX_SIZE - 1];
  sha256_hex(both, text->data, text->size);
  sha256_hex(both + SHA256_HEX_SIZE - 1, bicycle.data, bicycle.size);
  sha256_hex(spec->hash, both, sizeof both - 1);
  bike_text_free(&bicycle);
  return BIKE_OK;
}

static int read_bicycle(sweep_spec *spec, const bike_yaml *yaml, const bike_text *text) {
  bike_field field;
  char name[TERM_PATH_SIZE], path[TERM_PATH_SIZE];
  if (!bike_yaml_find(yaml->root, "bicycle", &field))
    return bike_yaml_fail(yaml, NULL, BIKE_ERROR_SYNTAX, "key 'bicycle' is missing");
  int code = bike_yaml_text(yaml, &field, name, sizeof name);
  if (code) return code;
  if (!bicycle_path(path, name, yaml->path))
    return bike_yaml_fail(yaml, &field, BIKE_ERROR_FILE, "the path is too long");
  bike_file_error error = {""};
  code = bike_parameters_read(&spec->parameters, &spec->file, path, &error);
  if (!code) code = hash_texts(spec, text, path, &error);
  return code ? bike_yaml_fail(yaml, &field, code, "%s", error.text) : BIKE_OK;
}

// ---- the whole ----

static bool is_drawn(const sweep_axis *axis) {
  return axis->law == SWEEP_UNIFORM || axis->law == SWEEP_NORMAL;
}

static int check_draws(const sweep_spec *spec, const bike_yaml *yaml) {
  bool drawn = false;
  bike_field field = {.key = "draws"};
  for (int i = 0; i < spec->axis_count; i++) drawn = drawn || is_drawn(&spec->axes[i]);
  const bool found =
      bike_yaml_find(yaml->root, "draws", &field) || bike_yaml_find(yaml->root, "seed", &field);
  if (!drawn && found)
    return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX, "no axis is drawn at random");
  if (!drawn || (spec->draws > 0 && spec->has_seed)) return BIKE_OK;
  return bike_yaml_fail(yaml, NULL, BIKE_ERROR_SYNTAX, "key '%s' is missing: an axis is drawn",
                        spec->draws > 0 ? "seed" : "draws");
}

static int count_points(sweep_spec *spec, const bike_yaml *yaml) {
  bike_field field = {0};
  double product = (double)(spec->draws > 0 ? spec->draws : 1);
  for (int i = 0; i < spec->axis_count; i++) product *= (double)spec->axes[i].count;
  bike_yaml_find(yaml->root, "sweep", &field);
  if (product > SWEEP_MOST_POINTS)
    return bike_yaml_fail(yaml, &field, BIKE_ERROR_PARAMETER, "%.17g points are more than %d",
                          product, SWEEP_MOST_POINTS);
  if (spec->draws == 0) spec->draws = 1;
  spec->points = (long)product;
  return BIKE_OK;
}

static int check_needs(const sweep_spec *spec, const bike_yaml *yaml) {
  bike_field field = {0};
  bike_yaml_find(yaml->root, "outputs", &field);
  for (int i = 0; i < spec->output_count; i++) {
    const char *name = sweep_output_name(spec->outputs[i]);
    if (sweep_output_needs_speed(spec->outputs[i]) && !sweep_find_axis(spec, SWEEP_SPEED))
      return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX,
                            "'%s' needs a speed, and `sweep` has none", name);
  }
  if (spec->same_energy && sweep_find_axis(spec, SWEEP_RIDER_OFFSET)) {
    bike_yaml_find(yaml->root, "ride", &field);
    return bike_yaml_fail(yaml, &field, BIKE_ERROR_PARAMETER,
                          "start_speed same_energy and an axis rider_offset exclude each other");
  }
  return BIKE_OK;
}

static int read_document(sweep_spec *spec, const bike_yaml *yaml, const bike_text *text) {
  static const bike_key keys[] = {
      {"bicycle", bike_yaml_ignored_text, 0, true}, // read before the others
      {"description", bike_yaml_ignored_text, 0, false},
      {"sweep", read_axes, 0, true},
      {"outputs", read_outputs, 0, true},
      {"seed", read_seed, 0, false},
      {"draws", read_draws, offsetof(sweep_spec, draws), false},
      {"front", read_front, offsetof(sweep_spec, front), false},
      {"search", read_search, offsetof(sweep_spec, search), false},
      {"ride", read_ride, 0, false},
  };
  const int count = sizeof keys / sizeof *keys;
  int code = read_bicycle(spec, yaml, text);
  if (!code) code = bike_yaml_read(yaml, NULL, yaml->root, (bike_keys){keys, count}, spec);
  if (!code) code = check_draws(spec, yaml);
  if (!code) code = count_points(spec, yaml);
  return code ? code : check_needs(spec, yaml);
}

int sweep_spec_read(sweep_spec *out, const char *path, bike_file_error *error) {
  const bike_basin_def fate = bike_default_basin_def();
  *out = (sweep_spec){.search = {NAN, NAN}, // by each bicycle's size
                      .ride_time = fate.duration,
                      .settled = fate.settled};
  bike_text text;
  bike_yaml yaml;
  int code = bike_text_read(&text, path, LARGEST_SPEC, error);
  if (code) return code;
  code = bike_yaml_open_with_columns(&yaml, &text, path, error);
  if (!code) code = read_document(out, &yaml, &text);
  bike_yaml_close(&yaml);
  bike_text_free(&text);
  return code;
}
