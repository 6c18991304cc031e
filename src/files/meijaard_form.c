// SPDX-License-Identifier: Apache-2.0
// Meijaard's symbols in YAML: BicycleParameters' `values:` form and its flat form.
#include "forms.h"

#include <bicycle/error.h>
#include <string.h>

// What stands beside the symbols. `rider` and `description` are read and not used: whether B holds
// a rider changes nothing, which share of B it is says `rider_share`.
typedef struct head {
  char name[BIKE_NAME_SIZE];
  bike_symbols *symbols;
} head;

static int read_symbol(const bike_yaml *yaml, const bike_field *field, bike_symbols *out) {
  const int index = bike_symbol_index(field->key);
  if (index == BIKE_SYMBOL_UNKNOWN)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "unknown key");
  double value;
  const int code = bike_yaml_number(yaml, field, &value);
  if (code || index == BIKE_SYMBOL_UNUSED) return code;
  if (out->line[index]) return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "given twice");
  out->value[index] = value;
  out->line[index] = field->line;
  return BIKE_OK;
}

static int read_values(const bike_yaml *yaml, const bike_field *field, void *target) {
  const head *h = target;
  int code = bike_yaml_expect_mapping(yaml, field);
  void *cursor = NULL;
  bike_field symbol;
  while (!code && bike_yaml_next(field->value, &cursor, &symbol))
    code = read_symbol(yaml, &symbol, h->symbols);
  return code;
}

// The name of the set; BicycleParameters writes an empty one, and its names may be long.
static int read_name(const bike_yaml *yaml, const bike_field *field, void *target) {
  head *h = target;
  char text[BIKE_MESSAGE_SIZE];
  if (bike_yaml_is_null(field) || bike_yaml_is_empty_text(field)) return BIKE_OK;
  const int code = bike_yaml_text(yaml, field, text, sizeof text);
  if (!code) bike_text_name(h->name, sizeof h->name, text, strlen(text));
  return code;
}

static int read_rider(const bike_yaml *yaml, const bike_field *field, void *target) {
  (void)target;
  bool flag;
  return bike_yaml_is_null(field) ? BIKE_OK : bike_yaml_flag(yaml, field, &flag);
}

static int read_damping(const bike_yaml *yaml, const bike_field *field, void *target) {
  const head *h = target;
  return bike_yaml_not_negative(yaml, field, &h->symbols->steer_damping);
}

static int read_share(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const bike_key keys[] = {
      {"mP", bike_yaml_positive, offsetof(bike_rider_share, mass), true},
      {"xP", bike_yaml_number, offsetof(bike_rider_share, position[0]), true},
      {"yP", bike_yaml_number, offsetof(bike_rider_share, position[1]), false},
      {"zP", bike_yaml_number, offsetof(bike_rider_share, position[2]), true},
  };
  const head *h = target;
  const int code = bike_yaml_expect_mapping(yaml, field);
  if (code) return code;
  h->symbols->rider.given = true;
  h->symbols->rider.line = field->line;
  return bike_yaml_read(yaml, field, field->value, (bike_keys){keys, 4}, &h->symbols->rider);
}

static const bike_key HEAD[] = {
    {"parameterization", bike_yaml_ignored_text, 0, true}, // what brought us here
    {"values", read_values, 0, true},
    {"parameters", read_name, 0, false},
    {"rider", read_rider, 0, false},
    {"description", bike_yaml_ignored_text, 0, false},
    {"steer_damping", read_damping, 0, false},
    {"rider_share", read_share, 0, false},
};
enum { HEAD_COUNT = sizeof HEAD / sizeof *HEAD, FIRST_FLAT = 2 };

int bike_read_values_form(bike_symbols *out, char name[BIKE_NAME_SIZE], const bike_yaml *yaml) {
  *out = (bike_symbols){0};
  head h = {.symbols = out};
  const int code = bike_yaml_read(yaml, NULL, yaml->root, (bike_keys){HEAD, HEAD_COUNT}, &h);
  memcpy(name, h.name, sizeof h.name);
  return code;
}

static const bike_key *flat_key(const char *name) {
  for (int i = FIRST_FLAT; i < HEAD_COUNT; ++i)
    if (strcmp(HEAD[i].name, name) == 0) return &HEAD[i];
  return NULL;
}

int bike_read_flat_form(bike_symbols *out, char name[BIKE_NAME_SIZE], const bike_yaml *yaml) {
  *out = (bike_symbols){0};
  head h = {.symbols = out};
  int code = BIKE_OK;
  void *cursor = NULL;
  bike_field field, first;
  while (!code && bike_yaml_next(yaml->root, &cursor, &field)) {
    const bike_key *key = flat_key(field.key);
    if (key && bike_yaml_find(yaml->root, field.key, &first) && first.line != field.line)
      code = bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX, "given twice");
    else
      code = key ? key->read(yaml, &field, &h) : read_symbol(yaml, &field, out);
  }
  memcpy(name, h.name, sizeof h.name);
  return code;
}
