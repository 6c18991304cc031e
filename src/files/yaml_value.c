// SPDX-License-Identifier: Apache-2.0
// Values of a document: numbers, texts, truth values and lists, each of exactly its kind.
#include "yaml.h"

#include "angle.h"
#include "number.h"

#include <bicycle/error.h>
#include <libfyaml.h>
#include <string.h>

enum { SHOWN = 40 }; // characters of a wrong value in a message

// The scalar's text, or NULL for mappings and lists.
static const char *scalar(const bike_field *field, size_t *length) {
  *length = 0;
  if (!field->value || !fy_node_is_scalar(field->value)) return NULL;
  const char *text = fy_node_get_scalar(field->value, length);
  return text ? text : "";
}

static bool is_unquoted(const bike_field *field) {
  return fy_node_get_style(field->value) == FYNS_PLAIN;
}

bool bike_yaml_is_text(const bike_field *field, const char *word) {
  size_t length;
  const char *text = scalar(field, &length);
  return text && length == strlen(word) && memcmp(text, word, length) == 0;
}

bool bike_yaml_is_plain(const bike_field *field, const char *word) {
  return bike_yaml_is_text(field, word) && is_unquoted(field);
}

static bool is_one_of(const bike_field *field, const char *const words[3]) {
  for (int i = 0; i < 3; ++i)
    if (bike_yaml_is_plain(field, words[i])) return true;
  return false;
}

bool bike_yaml_is_null(const bike_field *field) {
  static const char *const words[3] = {"null", "Null", "NULL"};
  if (!field->value) return true;
  return bike_yaml_is_plain(field, "") || bike_yaml_is_plain(field, "~") || is_one_of(field, words);
}

bool bike_yaml_is_empty_text(const bike_field *field) {
  size_t length;
  return scalar(field, &length) && length == 0;
}

bool bike_yaml_is_mapping(const bike_field *field) {
  return field->value && fy_node_is_mapping(field->value);
}

int bike_yaml_expect_mapping(const bike_yaml *yaml, const bike_field *field) {
  if (bike_yaml_is_mapping(field)) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must hold `key: value` pairs");
}

int bike_yaml_expect_list(const bike_yaml *yaml, const bike_field *field) {
  if (field->value && fy_node_is_sequence(field->value)) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be a list");
}

int bike_yaml_number(const bike_yaml *yaml, const bike_field *field, void *target) {
  size_t length;
  const char *text = scalar(field, &length);
  if (!text || bike_yaml_is_null(field))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be a number");
  if (!is_unquoted(field))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be a number, not a quoted text");
  const char *wrong = bike_number_parse(target, text, length);
  if (!wrong) return BIKE_OK;
  char hint[BIKE_ANGLE_TEXT];
  bike_angle_hint(hint, text, length);
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "'%.*s' %s%s",
                        length < SHOWN ? (int)length : SHOWN, text, wrong, hint);
}

int bike_yaml_positive(const bike_yaml *yaml, const bike_field *field, void *target) {
  const int code = bike_yaml_number(yaml, field, target);
  if (code || *(double *)target > 0) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "must be positive");
}

int bike_yaml_not_negative(const bike_yaml *yaml, const bike_field *field, void *target) {
  const int code = bike_yaml_number(yaml, field, target);
  if (code || *(double *)target >= 0) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "must not be negative");
}

int bike_yaml_angle(const bike_yaml *yaml, const bike_field *field, void *target) {
  char what[BIKE_ANGLE_TEXT];
  const int code = bike_yaml_number(yaml, field, target);
  if (code || bike_angle_check(what, &bike_turns_range, *(double *)target)) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "%s", what);
}

int bike_yaml_numbers(const bike_yaml *yaml, const bike_field *field, double *out, int count) {
  if (!field->value || !fy_node_is_sequence(field->value) ||
      fy_node_sequence_item_count(field->value) != count)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be a list of %d numbers", count);
  void *cursor = NULL;
  bike_field entry = *field;
  for (int i = 0; bike_yaml_next_entry(field->value, &cursor, &entry); ++i) {
    const int code = bike_yaml_number(yaml, &entry, &out[i]);
    if (code) return code;
  }
  return BIKE_OK;
}

int bike_yaml_point(const bike_yaml *yaml, const bike_field *field, void *target) {
  return bike_yaml_numbers(yaml, field, target, 3);
}

int bike_yaml_flag(const bike_yaml *yaml, const bike_field *field, void *target) {
  static const char *const yes[3] = {"true", "True", "TRUE"};
  static const char *const no[3] = {"false", "False", "FALSE"};
  *(bool *)target = is_one_of(field, yes);
  if (*(bool *)target || is_one_of(field, no)) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be true or false");
}

int bike_yaml_text(const bike_yaml *yaml, const bike_field *field, char *out, size_t size) {
  size_t length;
  const char *text = scalar(field, &length);
  if (!text || bike_yaml_is_null(field))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be a text");
  if (length == 0) return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must not be empty");
  if (length >= size)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "is longer than %zu bytes", size - 1);
  for (size_t i = 0; i < length; ++i)
    if ((unsigned char)text[i] < 0x20 || text[i] == 0x7f)
      return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "holds a control character");
  memcpy(out, text, length);
  out[length] = '\0';
  return BIKE_OK;
}

int bike_yaml_ignored_text(const bike_yaml *yaml, const bike_field *field, void *target) {
  (void)target;
  if (!field->value || fy_node_is_scalar(field->value)) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "must be a text");
}
