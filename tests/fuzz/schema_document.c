// SPDX-License-Identifier: Apache-2.0
#include "schema_document.h"

#include <math.h>
#include <string.h>

enum { DEEPEST = 12, MOST_ITEMS = 4, LONG_TEXT = 3000 };

typedef struct maker {
  const json_t *root;
  fuzz_bytes *bytes;
  bool strays;
} maker;

static json_t *make(const maker *m, const json_t *schema, int depth);

static json_t *any_text(fuzz_bytes *bytes) {
  static const char *const texts[] = {
      "lean",
      "mujoco.energy",
      "",
      "max",
      "rad",
      "weave_speed",
      "benchmark",
      "reference",
      "same",
      "a <b> & \"c\" 'd'",
      "%s%n%d",
      "\xc3\xa9\xe2\x82\xac\xf0\x9f\x9a\xb2",
      "line\nfeed\ttab",
      "\x01\x1f\x7f",
      "]]>",
      "<!--",
      "../../etc/passwd",
      "50%25 #1?.yml",
      "a|b`c`*d*",
      "convergence",
  };
  enum { COUNT = sizeof texts / sizeof *texts };
  static char buffer[LONG_TEXT + 1];
  unsigned choice = fuzz_byte(bytes);
  if (choice == 255) { // longer than any buffer
    memset(buffer, 'x', LONG_TEXT);
    return json_string(buffer);
  }
  if (choice < 200) return json_string(texts[choice % COUNT]);
  size_t length = fuzz_below(bytes, 24);
  for (size_t i = 0; i < length; i++) buffer[i] = (char)(1 + fuzz_below(bytes, 127));
  return json_stringn(buffer, length);
}

// JSON holds no number that is not finite.
static json_t *any_number(fuzz_bytes *bytes, const json_t *schema) {
  double value = fuzz_number(bytes);
  const json_t *minimum = json_object_get(schema, "minimum");
  if (!isfinite(value)) value = 0;
  if (minimum && value < json_number_value(minimum)) value = json_number_value(minimum);
  return json_real(value);
}

static json_t *any_value(fuzz_bytes *bytes) {
  switch (fuzz_below(bytes, 8)) {
  case 0:
    return json_null();
  case 1:
    return json_true();
  case 2:
    return json_integer((json_int_t)fuzz_number(&(fuzz_bytes){NULL, 0}) - 1);
  case 3:
    return any_number(bytes, NULL);
  case 4:
    return json_array();
  case 5:
    return json_object();
  case 6:
    return json_pack("[n, {s:s}, i]", "layer", "L2", 7);
  default:
    return any_text(bytes);
  }
}

static json_t *make_object(const maker *m, const json_t *schema, int depth) {
  json_t *object = json_object(), *rule;
  const char *key;
  const json_t *required = json_object_get(schema, "required");
  json_object_foreach((json_t *)(uintptr_t)json_object_get(schema, "properties"), key, rule) {
    bool needed = false;
    size_t i;
    const json_t *name;
    json_array_foreach(required, i, name) needed |= strcmp(json_string_value(name), key) == 0;
    if (needed ? m->strays && fuzz_byte(m->bytes) == 255 : fuzz_byte(m->bytes) % 2 == 0) continue;
    json_object_set_new(object, key, make(m, rule, depth + 1));
  }
  json_t *others = json_object_get(schema, "additionalProperties");
  static const char *const names[] = {"lean", "steer", "lean_rate", "steer_rate", "speed", "file"};
  if (!json_object_get(schema, "properties") && json_is_object(others))
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
      json_object_set_new(object, names[i], make(m, others, depth + 1));
  return object;
}

static json_t *make_array(const maker *m, const json_t *schema, int depth) {
  json_t *array = json_array();
  unsigned count = fuzz_below(m->bytes, MOST_ITEMS);
  for (unsigned i = 0; i < count; i++)
    json_array_append_new(array, make(m, json_object_get(schema, "items"), depth + 1));
  return array;
}

static json_t *make_type(const maker *m, const json_t *schema, const char *type, int depth) {
  if (strcmp(type, "object") == 0) return make_object(m, schema, depth);
  if (strcmp(type, "array") == 0) return make_array(m, schema, depth);
  if (strcmp(type, "string") == 0) return any_text(m->bytes);
  if (strcmp(type, "number") == 0) return any_number(m->bytes, schema);
  if (strcmp(type, "integer") == 0) return json_integer(fuzz_byte(m->bytes));
  if (strcmp(type, "boolean") == 0) return json_boolean(fuzz_byte(m->bytes) % 2);
  FUZZ_REQUIRE(strcmp(type, "null") == 0, "type %s", type);
  return json_null();
}

static const json_t *referred(const maker *m, const json_t *schema) {
  const char *path = json_string_value(json_object_get(schema, "$ref"));
  if (!path) return schema;
  FUZZ_REQUIRE(strncmp(path, "#/$defs/", 8) == 0, "%s", path);
  const json_t *rule = json_object_get(json_object_get(m->root, "$defs"), path + 8);
  FUZZ_REQUIRE(rule, "%s", path);
  return rule;
}

static json_t *make(const maker *m, const json_t *schema, int depth) {
  schema = referred(m, schema);
  if (depth > DEEPEST) return json_null();
  if (m->strays && fuzz_byte(m->bytes) % 64 == 63) return any_value(m->bytes);
  json_t *fixed = json_object_get(schema, "const"), *choices = json_object_get(schema, "enum");
  json_t *type = json_object_get(schema, "type");
  if (fixed) return json_incref(fixed);
  if (choices)
    return json_incref(
        json_array_get(choices, fuzz_below(m->bytes, (unsigned)json_array_size(choices))));
  if (json_is_array(type))
    type = json_array_get(type, fuzz_below(m->bytes, 8) % json_array_size(type));
  return type ? make_type(m, schema, json_string_value(type), depth) : any_value(m->bytes);
}

json_t *schema_document(const json_t *schema, fuzz_bytes *bytes, bool strays) {
  const maker m = {schema, bytes, strays};
  return make(&m, schema, 0);
}
