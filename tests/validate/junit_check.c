// SPDX-License-Identifier: Apache-2.0
#include "junit_check.h"

#include "support/near.h"

#include <regex.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The pattern SUREFIRE_TIME as earlier versions of the schema have it; later ones take any number
// of decimals.
static const char surefire_time[] = "^(([0-9]{0,3},)*[0-9]{3}|[0-9]{0,3})*(\\.[0-9]{0,3})?$";

// What may stand where, `!` before what must. Attributes are between blanks.
static const struct {
  const char *element, *parent, *attributes;
} elements[] = {
    {"testsuites", "", " name time tests failures errors "},
    {"testsuite", "testsuites",
     " !name !tests !failures !errors group time skipped timestamp hostname id package file log "
     "url "},
    {"testcase", "testsuite", " !name time classname group "},
    {"failure", "testcase", " type message "},
    {"error", "testcase", " type message "},
};
enum { ELEMENTS = sizeof elements / sizeof *elements, DEEPEST = 4, NAME = 32 };

typedef struct reader {
  char open[DEEPEST][NAME]; // elements around the place
  int depth;                //
  long stated[2][3];        // tests, failures, errors that the document and its suite state
  long found[2][3];         // and those that are there
} reader;

static int kind_of(const char *element) {
  for (int i = 0; i < ELEMENTS; i++)
    if (strcmp(elements[i].element, element) == 0) return i;
  fail_msg("junit: <%s> is not in the schema", element);
  return -1;
}

static void check_time(const char *value) {
  regex_t pattern;
  assert_int_equal(regcomp(&pattern, surefire_time, REG_EXTENDED | REG_NOSUB), 0);
  if (regexec(&pattern, value, 0, NULL, 0) != 0) fail_msg("junit: time=\"%s\"", value);
  regfree(&pattern);
}

static void note_count(reader *r, const char *name, const char *value) {
  static const char *const counts[] = {"tests", "failures", "errors"};
  for (int i = 0; i < 3 && r->depth < 2; i++)
    if (strcmp(name, counts[i]) == 0) r->stated[r->depth][i] = strtol(value, NULL, 10);
}

// The attributes of a tag, from behind its name.
static void read_attributes(reader *r, int kind, const char *at, const char *end) {
  char seen[512] = " ", word[NAME + 3];
  for (at += strspn(at, " "); at < end && *at != '/'; at += strspn(at, " ")) {
    size_t length = strcspn(at, "=");
    const char *quote = at + length + 2, *close = strchr(quote, '"');
    assert_true(length < NAME && at[length + 1] == '"' && close && close < end);
    char *name = strndup(at, length), *value = strndup(quote, (size_t)(close - quote));
    const char *allowed = elements[kind].attributes;
    snprintf(word, sizeof word, " %s ", name);
    snprintf(seen + strlen(seen), sizeof seen - strlen(seen), "%s ", name);
    const bool plain = strstr(allowed, word);
    snprintf(word, sizeof word, "!%s ", name);
    if (!plain && !strstr(allowed, word))
      fail_msg("junit: %s of <%s> is not in the schema", name, elements[kind].element);
    if (strcmp(name, "time") == 0) check_time(value);
    note_count(r, name, value);
    free(name);
    free(value);
    at = close + 1;
  }
  for (const char *must = elements[kind].attributes; (must = strchr(must, '!')); must++) {
    snprintf(word, sizeof word, " %.*s ", (int)strcspn(must + 1, " "), must + 1);
    if (!strstr(seen, word)) fail_msg("junit:%sof <%s> is missing", word, elements[kind].element);
  }
}

static void count(reader *r, const char *element) {
  static const char *const counted[] = {"testcase", "failure", "error"};
  for (int i = 0; i < 3; i++)
    for (int level = 0; level < 2; level++) r->found[level][i] += strcmp(element, counted[i]) == 0;
}

static void check_counts(const reader *r, int level) {
  for (int i = 0; i < 3; i++) assert_int_equal(r->found[level][i], r->stated[level][i]);
}

static void close_element(reader *r, const char *name) {
  assert_true(r->depth > 0);
  assert_string_equal(r->open[--r->depth], name);
  if (r->depth > 1) return;
  check_counts(r, r->depth);
  memset(r->found[1], 0, sizeof r->found[1]);
}

static void read_tag(reader *r, const char *at, const char *end) {
  const bool closes = *at == '/';
  at += closes;
  size_t length = strcspn(at, " />");
  char name[NAME];
  assert_true(length < NAME);
  snprintf(name, sizeof name, "%.*s", (int)length, at);
  if (closes) {
    close_element(r, name);
    return;
  }
  const int kind = kind_of(name);
  assert_true(r->depth < DEEPEST);
  assert_string_equal(elements[kind].parent, r->depth ? r->open[r->depth - 1] : "");
  read_attributes(r, kind, at + length, end);
  count(r, name);
  strcpy(r->open[r->depth++], name);
  if (end[-1] == '/') close_element(r, name);
}

void junit_check(const char *text) {
  static const char declaration[] = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>";
  reader r = {0};
  assert_ptr_equal(strstr(text, declaration), text);
  for (const char *at = strchr(text + 1, '<'); at; at = strchr(at, '<')) {
    const char *end = strchr(at, '>');
    assert_non_null(end);
    read_tag(&r, at + 1, end);
    at = end;
  }
  assert_int_equal(r.depth, 0);
}
