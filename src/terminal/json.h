// SPDX-License-Identifier: Apache-2.0
// JSON documents: numbers that round-trip, null where there is no number.
#ifndef BICYCLE_TERMINAL_JSON_H
#define BICYCLE_TERMINAL_JSON_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// Makes jansson call term_lose where it finds no memory, so that documents can be built without
// looking at every step. term_begin calls it, before the first document.
void term_json_begin(void);

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
// releases it. False when memory was short (the document is NULL, lacks something, or could not be
// printed); nothing is written then unless it is the printing that failed. What goes wrong with the
// stream itself is found by who closes it.
bool term_json_write(json_t *document, FILE *stream);

#endif
