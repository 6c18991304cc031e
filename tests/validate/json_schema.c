// SPDX-License-Identifier: Apache-2.0
#include "json_schema.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { PATH = 256 };

// One check within a document.
typedef struct check {
  const json_t *root; // the whole schema
  char *error;
  char path[PATH];
} check;

static bool obeys(check *c, const json_t *schema, const json_t *value);

__attribute__((format(printf, 2, 3))) static bool fail(check *c, const char *format, ...) {
  va_list arguments;
  int used = snprintf(c->error, JSON_SCHEMA_ERROR, "%s: ", c->path);
  va_start(arguments, format);
  vsnprintf(c->error + used, (size_t)(JSON_SCHEMA_ERROR - used), format, arguments);
  va_end(arguments);
  return false;
}

// Checks a member under its own path.
static bool member_obeys(check *c, const json_t *schema, const char *name, const json_t *value) {
  size_t length = strlen(c->path);
  snprintf(c->path + length, PATH - length, "/%s", name);
  bool done = obeys(c, schema, value);
  c->path[length] = '\0';
  return done;
}

static bool has_type(const char *type, const json_t *value) {
  if (strcmp(type, "object") == 0) return json_is_object(value);
  if (strcmp(type, "array") == 0) return json_is_array(value);
  if (strcmp(type, "string") == 0) return json_is_string(value);
  if (strcmp(type, "number") == 0) return json_is_number(value);
  if (strcmp(type, "integer") == 0) return json_is_integer(value);
  if (strcmp(type, "boolean") == 0) return json_is_boolean(value);
  return strcmp(type, "null") == 0 && json_is_null(value);
}

static bool type_obeys(check *c, const json_t *type, const json_t *value) {
  size_t i;
  const json_t *one;
  if (json_is_string(type))
    return has_type(json_string_value(type), value) ||
           fail(c, "is not of type %s", json_string_value(type));
  json_array_foreach(type, i, one) if (has_type(json_string_value(one), value)) return true;
  return fail(c, "is of none of the types");
}

static bool enum_obeys(check *c, const json_t *values, const json_t *value) {
  size_t i;
  const json_t *one;
  json_array_foreach(values, i, one) if (json_equal(one, value)) return true;
  return fail(c, "is not one of the values");
}

static bool required_obeys(check *c, const json_t *names, const json_t *value) {
  size_t i;
  const json_t *name;
  json_array_foreach(
      names, i,
      name) if (!json_object_get(value,
                                 json_string_value(name))) return fail(c, "'%s' is missing",
                                                                       json_string_value(name));
  return true;
}

// Members of an object: by name, or by `additionalProperties`.
static bool members_obey(check *c, const json_t *schema, const json_t *value) {
  const char *name;
  json_t *member;
  const json_t *properties = json_object_get(schema, "properties");
  const json_t *others = json_object_get(schema, "additionalProperties");
  json_object_foreach((json_t *)value, name, member) {
    const json_t *own = json_object_get(properties, name);
    if (!own && json_is_false(others)) return fail(c, "'%s' is not in the schema", name);
    if (!own && !others) continue;
    if (!member_obeys(c, own ? own : others, name, member)) return false;
  }
  return true;
}

static bool items_obey(check *c, const json_t *schema, const json_t *value) {
  size_t i;
  const json_t *item;
  json_array_foreach(value, i, item) {
    char name[32];
    snprintf(name, sizeof name, "%zu", i);
    if (!member_obeys(c, schema, name, item)) return false;
  }
  return true;
}

static bool reference_obeys(check *c, const char *target, const json_t *value) {
  static const char prefix[] = "#/$defs/";
  const json_t *schema = NULL;
  if (strncmp(target, prefix, strlen(prefix)) == 0)
    schema = json_object_get(json_object_get(c->root, "$defs"), target + strlen(prefix));
  return schema ? obeys(c, schema, value) : fail(c, "the schema has no %s", target);
}

static bool keyword_obeys(check *c, const char *keyword, const json_t *rule, const json_t *value) {
  static const char *const silent[] = {"$schema", "title",      "description",
                                       "$defs",   "properties", "additionalProperties"};
  for (size_t i = 0; i < sizeof silent / sizeof *silent; i++)
    if (strcmp(keyword, silent[i]) == 0) return true;
  if (strcmp(keyword, "$ref") == 0) return reference_obeys(c, json_string_value(rule), value);
  if (strcmp(keyword, "type") == 0) return type_obeys(c, rule, value);
  if (strcmp(keyword, "enum") == 0) return enum_obeys(c, rule, value);
  if (strcmp(keyword, "const") == 0)
    return json_equal(rule, value) || fail(c, "is not the one value allowed");
  if (strcmp(keyword, "minimum") == 0)
    return !json_is_number(value) || json_number_value(value) >= json_number_value(rule) ||
           fail(c, "is too small");
  if (strcmp(keyword, "required") == 0)
    return !json_is_object(value) || required_obeys(c, rule, value);
  if (strcmp(keyword, "items") == 0) return !json_is_array(value) || items_obey(c, rule, value);
  return fail(c, "the schema's keyword '%s' is not known here", keyword);
}

static bool obeys(check *c, const json_t *schema, const json_t *value) {
  const char *keyword;
  json_t *rule;
  json_object_foreach((json_t *)schema, keyword,
                      rule) if (!keyword_obeys(c, keyword, rule, value)) return false;
  return !json_is_object(value) || members_obey(c, schema, value);
}

bool json_schema_check(char error[JSON_SCHEMA_ERROR], const json_t *schema,
                       const json_t *document) {
  check c = {.root = schema, .error = error};
  error[0] = '\0';
  return obeys(&c, schema, document);
}
