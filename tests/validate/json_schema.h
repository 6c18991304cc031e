// SPDX-License-Identifier: Apache-2.0
// A validator of JSON against a schema, for the keywords that schemas of this project use: type,
// enum, const, minimum, properties, required, additionalProperties, items, $ref to $defs. A schema
// with any other keyword is refused, so that no rule is passed over in silence.
#ifndef TESTS_VALIDATE_JSON_SCHEMA_H
#define TESTS_VALIDATE_JSON_SCHEMA_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

enum { JSON_SCHEMA_ERROR = 512 };

// True if the document obeys the schema; otherwise `error` says where it does not: "/a/b/0: what".
bool json_schema_check(char error[JSON_SCHEMA_ERROR], const json_t *schema, const json_t *document);

#endif
