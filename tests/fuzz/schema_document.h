// SPDX-License-Identifier: Apache-2.0
// Documents made from a JSON schema and a list of choices.
#ifndef TESTS_FUZZ_SCHEMA_DOCUMENT_H
#define TESTS_FUZZ_SCHEMA_DOCUMENT_H

#include "fuzz.h"

#include <jansson.h>

// A document that obeys the schema, for the keywords that schemas of this project use; with
// `strays` one choice in 64 makes a value that does not: another type, or a key left out.
json_t *schema_document(const json_t *schema, fuzz_bytes *bytes, bool strays);

#endif
