// SPDX-License-Identifier: Apache-2.0
// The engine of a scenario: `{engine: NAME, OPTION: value, ...}`, the options being the engine's.
#include "scenario_keys.h"

#include <bicycle/error.h>
#include <stdio.h>
#include <string.h>

enum { WORD_SIZE = 64 };

// "a, b, c" of a list of choices.
static void list_choices(char *out, size_t size, const char *const *choices) {
  size_t used = 0;
  out[0] = '\0';
  for (int i = 0; choices[i] && used < size; i++)
    used += (size_t)snprintf(out + used, size - used, "%s%s", i ? ", " : "", choices[i]);
}

static int read_choice(const bike_yaml *yaml, const bike_field *field, const char *const *choices,
                       double *out) {
  char word[WORD_SIZE], all[BIKE_MESSAGE_SIZE / 2];
  int code = bike_yaml_text(yaml, field, word, sizeof word);
  if (code) return code;
  for (int i = 0; choices[i]; i++) {
    if (strcmp(choices[i], word) != 0) continue;
    *out = i;
    return BIKE_OK;
  }
  list_choices(all, sizeof all, choices);
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "'%s' is none of %s", word, all);
}

// True where an earlier pair of the mapping has the key.
static bool is_repeated(const bike_field *mapping, const bike_field *field) {
  bike_field first;
  return bike_yaml_find(mapping->value, field->key, &first) && first.value != field->value;
}

static int read_column_name(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_text(yaml, field, target, ENGINE_COLUMN_SIZE);
}

// The recorded ride's file, beside the scenario.
static int read_file(const bike_yaml *yaml, const bike_field *field, engine_choice *out) {
  char name[SCENARIO_PATH];
  int code = bike_yaml_text(yaml, field, name, sizeof name);
  if (code) return code;
  if (scenario_relative_path(out->file, yaml->path, name)) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_FILE, "the path is too long");
}

// `SIGNAL: COLUMN` or `SIGNAL: {column: COLUMN, scale: FACTOR}`.
static int read_column(const bike_yaml *yaml, const bike_field *field, engine_column *out) {
  static const bike_key keys[] = {
      {"column", read_column_name, offsetof(engine_column, column), true},
      {"scale", bike_yaml_number, offsetof(engine_column, scale), false},
  };
  *out = (engine_column){.scale = 1};
  if (strcmp(field->key, "time") != 0 && !trace_find_signal(field->key))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX,
                          "is neither 'time' nor a signal of a ride");
  snprintf(out->signal, sizeof out->signal, "%s", field->key);
  if (!bike_yaml_is_mapping(field)) return read_column_name(yaml, field, out->column);
  int code = bike_yaml_read(yaml, field, field->value, (bike_keys){keys, 2}, out);
  if (!code && out->scale == 0)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "a scale of zero");
  return code;
}

static int read_columns(const bike_yaml *yaml, const bike_field *field, engine_choice *out) {
  int code = bike_yaml_expect_mapping(yaml, field);
  void *cursor = NULL;
  bike_field entry;
  while (!code && bike_yaml_next(field->value, &cursor, &entry)) {
    if (is_repeated(field, &entry))
      return bike_yaml_fail(yaml, &entry, BIKE_ERROR_SYNTAX, "given twice");
    if (out->column_count == ENGINE_MAX_COLUMNS)
      return bike_yaml_fail(yaml, &entry, BIKE_ERROR_SYNTAX, "more than %d columns",
                            ENGINE_MAX_COLUMNS);
    code = read_column(yaml, &entry, &out->columns[out->column_count++]);
  }
  if (!code && out->column_count == 0)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must name a column");
  return code;
}

static int read_option(const bike_yaml *yaml, const bike_field *field, engine_choice *out) {
  if (out->engine->plays_file && strcmp(field->key, "file") == 0)
    return read_file(yaml, field, out);
  if (out->engine->plays_file && strcmp(field->key, "columns") == 0)
    return read_columns(yaml, field, out);
  for (int i = 0; i < out->engine->option_count; i++) {
    const engine_option *option = &out->engine->options[i];
    if (strcmp(option->name, field->key) != 0) continue;
    if (option->choices) return read_choice(yaml, field, option->choices, &out->option[i]);
    return bike_yaml_positive(yaml, field, &out->option[i]);
  }
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "the engine '%s' has no such option",
                        out->engine->name);
}

static int find_engine(const bike_yaml *yaml, const bike_field *field, const engine **out) {
  char name[WORD_SIZE];
  bike_field named;
  int code = bike_yaml_expect_mapping(yaml, field);
  if (code) return code;
  if (!bike_yaml_find(field->value, "engine", &named))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "key 'engine' is missing");
  code = bike_yaml_text(yaml, &named, name, sizeof name);
  if (code) return code;
  *out = engine_find(name);
  if (*out) return BIKE_OK;
  return bike_yaml_fail(yaml, &named, BIKE_ERROR_SYNTAX, "'%s' is not an engine", name);
}

int scenario_read_engine(const bike_yaml *yaml, const bike_field *field, void *target) {
  const engine *e = NULL;
  int code = find_engine(yaml, field, &e);
  if (code) return code;
  engine_choice choice = engine_default_choice(e);
  void *cursor = NULL;
  bike_field option;
  while (!code && bike_yaml_next(field->value, &cursor, &option)) {
    if (is_repeated(field, &option))
      return bike_yaml_fail(yaml, &option, BIKE_ERROR_SYNTAX, "given twice");
    if (strcmp(option.key, "engine") != 0) code = read_option(yaml, &option, &choice);
  }
  if (!code && e->plays_file && !*choice.file)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "key 'file' is missing");
  *(engine_choice *)target = choice;
  return code;
}
