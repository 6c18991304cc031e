// SPDX-License-Identifier: Apache-2.0
#include "document.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const verdicts[VERDICTS] = {"confirmed", "partly", "not"};

bool document_key(char key[KEY_SIZE], const char *line) {
  if (strncmp(line, "| `", 3) != 0) return false;
  const char *end = strstr(line + 3, "` |");
  if (!end || end - (line + 3) >= KEY_SIZE) return false;
  snprintf(key, KEY_SIZE, "%.*s", (int)(end - (line + 3)), line + 3);
  return true;
}

static const char construction[] = ", by construction";

// A verdict in its cell, with what follows it.
static int find_verdict(const char *line, const char *after) {
  const char *cell = line;
  for (int bar = 0; bar < 5 && cell; bar++) cell = strchr(cell + (bar > 0), '|');
  for (int v = 0; cell && v < VERDICTS; v++) {
    char text[KEY_SIZE];
    snprintf(text, sizeof text, "| %s%s |", verdicts[v], after);
    if (strncmp(cell, text, strlen(text)) == 0) return v;
  }
  return -1;
}

bool document_is_constructed(const char *line) {
  return find_verdict(line, construction) >= 0;
}

int document_verdict(const char *line) {
  int plain = find_verdict(line, "");
  return plain >= 0 ? plain : find_verdict(line, construction);
}

// A bold figure: text between the stars.
typedef struct token {
  const char *from, *to;
  char limit;    // '<', '>' or 0
  bool none;     //
  double value;  //
  int decimals;  //
  bool exponent; // 2.1e-10
} token;

static bool read_token(token *out, const char *from, const char *to) {
  char text[KEY_SIZE];
  if (to - from >= KEY_SIZE) return false;
  snprintf(text, sizeof text, "%.*s", (int)(to - from), from);
  *out = (token){.from = from, .to = to, .none = strcmp(text, "none") == 0};
  if (out->none) return true;
  const char *number = text;
  if (*number == '<' || *number == '>') {
    out->limit = *number;
    number += 2;
  }
  char *end;
  out->value = strtod(number, &end);
  if (end == number || *end) return false;
  const char *point = strchr(number, '.'), *e = strchr(number, 'e');
  out->exponent = e != NULL;
  if (point) out->decimals = (int)strcspn(point + 1, "e");
  return true;
}

// The next bold figure of a line from `line` on; bold words are none.
static bool next_token(token *out, const char *line) {
  for (const char *from = strstr(line, "**"); from; from = strstr(from, "**")) {
    from += 2;
    const char *to = strstr(from, "**");
    if (!to) return false;
    if (read_token(out, from, to)) return true;
    from = to + 2;
  }
  return false;
}

static bool agrees(const token *t, double computed) {
  if (t->none) return isnan(computed);
  if (t->limit == '<') return fabs(computed) < t->value;
  if (t->limit == '>') return computed > t->value;
  double unit = pow(10, -t->decimals);
  if (t->exponent && t->value != 0) unit *= pow(10, floor(log10(fabs(t->value))));
  // half a unit of the last digit, and a thousandth of one so that a figure that falls between two
  // digits may be rounded either way by another machine
  return fabs(computed - t->value) <= 0.501 * unit;
}

int document_check(const char *key, const char *line, const figures *computed) {
  int count = 0, faults = 0;
  token t;
  for (const char *at = line; next_token(&t, at); at = t.to + 2, count++) {
    if (count >= computed->count || agrees(&t, computed->values[count])) continue;
    printf("%s: figure %d: the table says %.*s, computed %.10g\n", key, count + 1,
           (int)(t.to - t.from), t.from, computed->values[count]);
    faults++;
  }
  if (count != computed->count) {
    printf("%s: the table has %d figures, computed are %d\n", key, count, computed->count);
    faults++;
  }
  return faults;
}

static void write_token(char *out, size_t size, const token *t, double value) {
  if (t->limit)
    snprintf(out, size, "%.*s", (int)(t->to - t->from), t->from);
  else if (isnan(value))
    snprintf(out, size, "none");
  else if (t->exponent)
    snprintf(out, size, "%.*e", t->decimals, value);
  else
    snprintf(out, size, "%.*f", t->none ? 3 : t->decimals, value);
}

void document_renew(char *out, size_t size, const char *line, const figures *computed) {
  token t;
  size_t used = 0;
  const char *at = line;
  for (int i = 0; i < computed->count && used < size && next_token(&t, at); i++, at = t.to) {
    char figure[2 * KEY_SIZE];
    write_token(figure, sizeof figure, &t, computed->values[i]);
    used += (size_t)snprintf(out + used, size - used, "%.*s%s", (int)(t.from - at), at, figure);
    // step over the closing stars
    if (used < size) used += (size_t)snprintf(out + used, size - used, "**");
    t.to += 2;
  }
  if (used < size) snprintf(out + used, size - used, "%s", at);
}
