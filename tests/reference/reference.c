// SPDX-License-Identifier: Apache-2.0
#include "reference/reference.h"
#include "support/near.h"
#include <stdlib.h>
#include <string.h>

json_t *reference_open(void) {
  json_error_t error;
  json_t *document =
      json_load_file(BICYCLE_SOURCE_DIR "/tests/reference/published.json", 0, &error);
  if (!document) fail_msg("%s:%d: %s", error.source, error.line, error.text);
  return document;
}

double reference_number(const json_t *document, const char *path) {
  const json_t *node = document;
  char key[64];
  for (const char *rest = path; *rest;) {
    size_t length = strcspn(rest, ".");
    if (length >= sizeof key) fail_msg("%s: key too long", path);
    memcpy(key, rest, length);
    key[length] = '\0';
    node = json_is_array(node) ? json_array_get(node, strtoul(key, NULL, 10))
                               : json_object_get(node, key);
    rest += length + (rest[length] == '.');
  }
  if (!json_is_number(node)) fail_msg("published.json has no number %s", path);
  return json_number_value(node);
}
