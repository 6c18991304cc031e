// SPDX-License-Identifier: Apache-2.0
// JSON documents: numbers that round-trip, null where there is no number.
#ifndef BICYCLE_TERMINAL_JSON_H
#define BICYCLE_TERMINAL_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// JSON knows no NaN and no infinity, and json_real refuses them with NULL: null, on purpose.
json_t *term_json_number(double value);

// A text that need not be UTF-8, as names of files: what is none becomes U+FFFD.
json_t *term_json_text(const char *text);

// An array of numbers.
json_t *term_json_numbers(const double *values, size_t count);

// An array of `rows` arrays of `columns` numbers, from a row-major matrix.
json_t *term_json_matrix(const double *values, size_t rows, size_t columns);

// An array of texts.
json_t *term_json_texts(const char *const *texts, size_t count);

// Writes the document with 17 digits, keys in the order of insertion, a line feed at the end, and
// releases it. False when memory is short (the document is NULL, or could not be printed); what
// goes wrong with the stream itself is found by who closes it.
bool term_json_write(json_t *document, FILE *stream);

#endif
