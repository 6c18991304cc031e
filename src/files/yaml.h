// SPDX-License-Identifier: Apache-2.0
// Strict YAML on libfyaml: every message knows its line, and what a key means is a table.
//
// Accepted is the plain part of YAML that people write by hand: one document, a mapping at its
// root, keys that are text. Anchors, aliases, merges and tags are refused, so a small file cannot
// unfold into a large one. No key may stand twice.
#ifndef FILES_YAML_H
#define FILES_YAML_H

#include "text.h"

#include <stdbool.h>
#include <stddef.h>

struct fy_diag;
struct fy_document;
struct fy_node;
struct fy_parser;

// A YAML file in memory. Nodes and keys live as long as it does.
typedef struct bike_yaml {
  const char *path;             // as the user gave it; the caller's
  bike_file_error *error;       // where messages go; may be NULL
  bool columns;                 // messages say "path:line:column: key: what"
  struct fy_diag *diagnostics;  // libfyaml's complaints
  struct fy_parser *parser;     //
  struct fy_document *document; //
  struct fy_node *root;         // a mapping
} bike_yaml;

// One `key: value` of a mapping; of a list's entry the key is that of the list.
typedef struct bike_field {
  const char *key;       //
  int line;              // of the key, from 1
  struct fy_node *value; //
  int column;            // from 1; 0 where it is not known
} bike_field;

// What reads the value of a key into `target`. Returns 0 or an error whose message is written.
typedef int bike_value_reader(const bike_yaml *yaml, const bike_field *field, void *target);

// A key that a mapping may hold.
typedef struct bike_key {
  const char *name;        //
  bike_value_reader *read; //
  size_t offset;           // of the reader's target in what the mapping describes
  bool required;           //
} bike_key;

// A mapping as a list of keys.
typedef struct bike_keys {
  const bike_key *key; //
  int count;           // at most 64
} bike_keys;

// Parses the text of a file. BIKE_ERROR_SYNTAX or BIKE_ERROR_MEMORY; on success the text must
// outlive the document, which bike_yaml_close ends. `out` is safe to close in any case.
int bike_yaml_open(bike_yaml *out, const bike_text *text, const char *path, bike_file_error *error);
int bike_yaml_open_with_columns(bike_yaml *out, const bike_text *text, const char *path,
                                bike_file_error *error);
void bike_yaml_close(bike_yaml *yaml);

// Reads a whole mapping by its list: unknown keys, keys given twice and missing keys are errors.
// `where` names the mapping in messages about missing keys; NULL: the file.
int bike_yaml_read(const bike_yaml *yaml, const bike_field *where, struct fy_node *mapping,
                   bike_keys keys, void *target);

// The next pair of a mapping, or the next entry of a list; `cursor` starts at NULL.
bool bike_yaml_next(struct fy_node *mapping, void **cursor, bike_field *out);
bool bike_yaml_next_entry(struct fy_node *list, void **cursor, bike_field *out);

// The pair with that key, if the mapping holds it.
bool bike_yaml_find(struct fy_node *mapping, const char *key, bike_field *out);

// Writes "path:line: key: what", or with the column, and returns `code`.
int bike_yaml_fail(const bike_yaml *yaml, const bike_field *field, int code, const char *format,
                   ...) __attribute__((format(printf, 4, 5)));

// Values. A text target is a buffer of `size`; the others check the kind only.
int bike_yaml_text(const bike_yaml *yaml, const bike_field *field, char *out, size_t size);
int bike_yaml_numbers(const bike_yaml *yaml, const bike_field *field, double *out, int count);
int bike_yaml_expect_mapping(const bike_yaml *yaml, const bike_field *field);
int bike_yaml_expect_list(const bike_yaml *yaml, const bike_field *field);
bool bike_yaml_is_mapping(const bike_field *field);
bool bike_yaml_is_null(const bike_field *field);
bool bike_yaml_is_empty_text(const bike_field *field);              // '' or ""
bool bike_yaml_is_plain(const bike_field *field, const char *word); // without quotes
bool bike_yaml_is_text(const bike_field *field, const char *word);  // with or without

// Readers for lists of keys.
bike_value_reader bike_yaml_number;       // double: finite
bike_value_reader bike_yaml_positive;     // double: > 0
bike_value_reader bike_yaml_not_negative; // double: >= 0
bike_value_reader bike_yaml_angle;        // double: within 100 turns
bike_value_reader bike_yaml_point;        // double[3]
bike_value_reader bike_yaml_flag;         // bool: true or false
bike_value_reader bike_yaml_ignored_text; // nothing: any text, null or a truth value

#endif
