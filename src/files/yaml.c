// SPDX-License-Identifier: Apache-2.0
// The document: parsing, refusing what is not plain, walking, and reading by a list of keys.
#include "yaml.h"

#include "message.h"

#include <bicycle/error.h>
#include <libfyaml.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

// Our deepest file has four levels (root, parts, part, inertia, its numbers); this bounds the
// recursion below whatever libfyaml allows.
enum { DEEPEST = 16 };

int bike_yaml_fail(const bike_yaml *yaml, const bike_field *field, int code, const char *format,
                   ...) {
  char what[BIKE_MESSAGE_SIZE];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(what, sizeof what, format, arguments);
  va_end(arguments);
  if (yaml->columns && field && field->column > 0)
    return bike_message(yaml->error, code, "%s:%d:%d: %s: %s", yaml->path, field->line,
                        field->column, field->key, what);
  return bike_message_at(yaml->error, code, yaml->path, field ? field->line : 0,
                         field ? field->key : NULL, what);
}

// Where a scalar begins, or NULL for what has no token.
static const struct fy_mark *mark_of(struct fy_node *node) {
  struct fy_token *token = node && fy_node_is_scalar(node) ? fy_node_get_scalar_token(node) : NULL;
  return token ? fy_token_start_mark(token) : NULL;
}

// Its line and column, from 1; 0 where there is none.
static int line_of(struct fy_node *node) {
  const struct fy_mark *mark = mark_of(node);
  return mark ? mark->line + 1 : 0;
}

static int column_of(struct fy_node *node) {
  const struct fy_mark *mark = mark_of(node);
  if (!mark) return 0;
  const enum fy_node_style style = fy_node_get_style(node);
  const bool quoted = style == FYNS_SINGLE_QUOTED || style == FYNS_DOUBLE_QUOTED;
  return mark->column + (quoted ? 0 : 1); // of a quoted text libfyaml marks what is within
}

bool bike_yaml_next(struct fy_node *mapping, void **cursor, bike_field *out) {
  struct fy_node_pair *pair = fy_node_mapping_iterate(mapping, cursor);
  if (!pair) return false;
  struct fy_node *key = fy_node_pair_key(pair);
  const char *text = key ? fy_node_get_scalar0(key) : NULL;
  *out = (bike_field){text ? text : "", line_of(key), fy_node_pair_value(pair), column_of(key)};
  return true;
}

// The first place found in a node: its own, of a mapping that of its first key, of a list that of
// its first entry. Line 0 for empty ones, and for lists of lists.
static bike_field first_place(struct fy_node *node) {
  bike_field first = {0};
  void *cursor = NULL;
  if (fy_node_is_sequence(node)) node = fy_node_sequence_iterate(node, &cursor);
  cursor = NULL;
  if (node && fy_node_is_mapping(node))
    bike_yaml_next(node, &cursor, &first);
  else
    first = (bike_field){.line = line_of(node), .column = column_of(node)};
  return first;
}

bool bike_yaml_next_entry(struct fy_node *list, void **cursor, bike_field *out) {
  struct fy_node *entry = fy_node_sequence_iterate(list, cursor);
  if (!entry) return false;
  out->value = entry;
  const bike_field first = first_place(entry);
  if (!first.line) return true;
  out->line = first.line;
  out->column = first.column;
  return true;
}

bool bike_yaml_find(struct fy_node *mapping, const char *key, bike_field *out) {
  void *cursor = NULL;
  bike_field field;
  while (bike_yaml_next(mapping, &cursor, &field)) {
    if (strcmp(field.key, key) != 0) continue;
    *out = field;
    return true;
  }
  return false;
}

static int no_memory(const bike_yaml *yaml) {
  return bike_message(yaml->error, BIKE_ERROR_MEMORY, "%s: out of memory", yaml->path);
}

static const char *forbidden(struct fy_node *node) {
  if (fy_node_is_alias(node)) return "aliases are not accepted";
  if (fy_node_get_anchor(node)) return "anchors are not accepted";
  if (fy_node_get_tag(node, NULL)) return "tags are not accepted";
  return NULL;
}

static int check_plain(const bike_yaml *yaml, bike_field where, int depth);

// libfyaml makes the text of a scalar when first asked for it and keeps it; where it finds no
// memory the text is empty. Asked for here, before anybody reads it. (A text in double quotes may
// be empty though something is written.)
static int take_text(const bike_yaml *yaml, struct fy_node *node) {
  if (!node || !fy_node_is_scalar(node) || fy_node_is_alias(node)) return BIKE_OK;
  struct fy_token *token = fy_node_get_scalar_token(node);
  const char *text = token ? fy_token_get_text0(token) : NULL;
  if (!token || (text && *text)) return BIKE_OK;
  const enum fy_node_style style = fy_node_get_style(node);
  const bool shown = style == FYNS_PLAIN || style == FYNS_SINGLE_QUOTED;
  const struct fy_mark *begin = fy_token_start_mark(token), *end = fy_token_end_mark(token);
  const bool written = begin && end && end->input_pos > begin->input_pos;
  return shown && written ? no_memory(yaml) : BIKE_OK;
}

static int check_mapping(const bike_yaml *yaml, const bike_field *where, int depth) {
  void *cursor = NULL;
  struct fy_node_pair *pair;
  bike_field field = *where;
  while ((pair = fy_node_mapping_iterate(where->value, &cursor))) {
    struct fy_node *key = fy_node_pair_key(pair);
    if (take_text(yaml, key)) return BIKE_ERROR_MEMORY;
    if (!key || !fy_node_is_scalar(key) || fy_node_is_alias(key) || !fy_node_get_scalar0(key))
      return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX, "a key must be text");
    field = (bike_field){fy_node_get_scalar0(key), line_of(key), fy_node_pair_value(pair),
                         column_of(key)};
    if (forbidden(key))
      return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX, "%s", forbidden(key));
    const int code = check_plain(yaml, field, depth);
    if (code) return code;
  }
  return BIKE_OK;
}

static int check_list(const bike_yaml *yaml, bike_field where, int depth) {
  struct fy_node *list = where.value;
  void *cursor = NULL;
  while (bike_yaml_next_entry(list, &cursor, &where)) {
    const int code = check_plain(yaml, where, depth);
    if (code) return code;
  }
  return BIKE_OK;
}

// Refuses what is not plain anywhere below a node.
static int check_plain(const bike_yaml *yaml, bike_field where, int depth) {
  if (!where.value) return BIKE_OK;
  if (depth >= DEEPEST)
    return bike_yaml_fail(yaml, &where, BIKE_ERROR_SYNTAX, "more than %d levels", DEEPEST);
  const char *what = forbidden(where.value);
  if (what) return bike_yaml_fail(yaml, &where, BIKE_ERROR_SYNTAX, "%s", what);
  if (take_text(yaml, where.value)) return BIKE_ERROR_MEMORY;
  if (fy_node_is_mapping(where.value)) return check_mapping(yaml, &where, depth + 1);
  if (fy_node_is_sequence(where.value)) return check_list(yaml, where, depth + 1);
  return BIKE_OK;
}

// libfyaml's own complaint. Where it has none, memory was probably short.
static int parse_error(const bike_yaml *yaml) {
  void *cursor = NULL;
  const struct fy_diag_error *first = fy_diag_errors_iterate(yaml->diagnostics, &cursor);
  if (!first || !first->msg) return no_memory(yaml);
  if (yaml->columns && first->line > 0)
    return bike_message(yaml->error, BIKE_ERROR_SYNTAX, "%s:%d:%d: %s", yaml->path, first->line,
                        first->column, first->msg);
  return bike_message_at(yaml->error, BIKE_ERROR_SYNTAX, yaml->path, first->line, NULL, first->msg);
}

// A parser that collects errors in `diagnostics` and leaves keys given twice to bike_yaml_read: its
// own check takes time with the square of their number.
static struct fy_parser *create_parser(struct fy_diag *diagnostics, const bike_text *text) {
  const struct fy_parse_cfg configuration = {.flags = FYPCF_JSON_NONE | FYPCF_ALLOW_DUPLICATE_KEYS,
                                             .diag = diagnostics};
  struct fy_parser *parser = fy_parser_create(&configuration);
  if (!parser || fy_parser_set_string(parser, text->data, text->size) == 0) return parser;
  fy_parser_destroy(parser);
  return NULL;
}

// Whether there is more than comments, blanks and marks of documents. Of such a text libfyaml makes
// a document, has a complaint, or has probably found no memory.
static bool says_something(const bike_text *text) {
  for (const char *line = text->data; line && *line; line += *line == '\n') {
    line += strspn(line, " \t\r");
    if (!strchr("#%\n", *line) && strncmp(line, "---", 3) != 0 && strncmp(line, "...", 3) != 0)
      return true;
    line += strcspn(line, "\n");
  }
  return false;
}

static int check_document(bike_yaml *yaml, const bike_text *text) {
  if (fy_parser_get_stream_error(yaml->parser)) return parse_error(yaml);
  if (!yaml->document && says_something(text)) return no_memory(yaml);
  yaml->root = yaml->document ? fy_document_root(yaml->document) : NULL;
  if (!yaml->root) return bike_yaml_fail(yaml, NULL, BIKE_ERROR_SYNTAX, "the file is empty");
  struct fy_document *second = fy_parse_load_document(yaml->parser);
  if (second) {
    fy_parse_document_destroy(yaml->parser, second);
    return bike_yaml_fail(yaml, NULL, BIKE_ERROR_SYNTAX, "more than one YAML document");
  }
  if (fy_parser_get_stream_error(yaml->parser)) return parse_error(yaml);
  if (!fy_node_is_mapping(yaml->root))
    return bike_message_at(yaml->error, BIKE_ERROR_SYNTAX, yaml->path,
                           first_place(yaml->root).line ? first_place(yaml->root).line : 1, NULL,
                           "must hold `key: value` pairs");
  return check_plain(yaml, (bike_field){.key = "", .line = 1, .value = yaml->root}, 0);
}

// Collects errors: a library does not print.
static struct fy_diag *create_diagnostics(void) {
  struct fy_diag_cfg configuration;
  fy_diag_cfg_default(&configuration);
  configuration.fp = NULL;
  struct fy_diag *diagnostics = fy_diag_create(&configuration);
  if (diagnostics) fy_diag_set_collect_errors(diagnostics, true);
  return diagnostics;
}

static int parse(bike_yaml *out, const bike_text *text) {
  out->diagnostics = create_diagnostics();
  if (out->diagnostics) out->parser = create_parser(out->diagnostics, text);
  if (!out->parser) return no_memory(out);
  out->document = fy_parse_load_document(out->parser);
  return check_document(out, text);
}

// Where libfyaml seems to have run out of memory it is asked again: if it fails alike, it is the
// text, about which it merely says nothing ("%YAML 9.9").
static int open_text(bike_yaml *out, const bike_text *text, const char *path, bool columns,
                     bike_file_error *error) {
  const bike_yaml fresh = {.path = path, .error = error, .columns = columns};
  *out = fresh;
  int code = parse(out, text);
  if (code != BIKE_ERROR_MEMORY || !out->parser) return code;
  bike_yaml_close(out);
  *out = fresh;
  code = parse(out, text);
  if (code != BIKE_ERROR_MEMORY || !out->parser) return code;
  return bike_message_at(error, BIKE_ERROR_SYNTAX, path, 0, NULL, "is not YAML");
}

int bike_yaml_open(bike_yaml *out, const bike_text *text, const char *path,
                   bike_file_error *error) {
  return open_text(out, text, path, false, error);
}

int bike_yaml_open_with_columns(bike_yaml *out, const bike_text *text, const char *path,
                                bike_file_error *error) {
  return open_text(out, text, path, true, error);
}

void bike_yaml_close(bike_yaml *yaml) {
  if (yaml->document) fy_parse_document_destroy(yaml->parser, yaml->document);
  if (yaml->parser) fy_parser_destroy(yaml->parser);
  // last, and not fy_diag_unref: only so does libfyaml free the errors it collected
  if (yaml->diagnostics) fy_diag_destroy(yaml->diagnostics);
  *yaml = (bike_yaml){0};
}

static int index_of(bike_keys keys, const char *name) {
  for (int i = 0; i < keys.count; ++i)
    if (strcmp(keys.key[i].name, name) == 0) return i;
  return -1;
}

static int missing_key(const bike_yaml *yaml, const bike_field *where, bike_keys keys,
                       uint64_t seen) {
  for (int i = 0; i < keys.count; ++i) {
    if (!keys.key[i].required || (seen >> i & 1U)) continue;
    return bike_yaml_fail(yaml, where, BIKE_ERROR_SYNTAX, "key '%s' is missing", keys.key[i].name);
  }
  return BIKE_OK;
}

int bike_yaml_read(const bike_yaml *yaml, const bike_field *where, struct fy_node *mapping,
                   bike_keys keys, void *target) {
  uint64_t seen = 0; // bit i: key i was given
  void *cursor = NULL;
  bike_field field;
  while (bike_yaml_next(mapping, &cursor, &field)) {
    const int i = index_of(keys, field.key);
    if (i < 0) return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX, "unknown key");
    if (seen >> i & 1U) return bike_yaml_fail(yaml, &field, BIKE_ERROR_SYNTAX, "given twice");
    seen |= (uint64_t)1 << i;
    const int code = keys.key[i].read(yaml, &field, (char *)target + keys.key[i].offset);
    if (code) return code;
  }
  return missing_key(yaml, where, keys, seen);
}
