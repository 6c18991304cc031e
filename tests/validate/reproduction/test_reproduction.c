// SPDX-License-Identifier: Apache-2.0
// validate/REPRODUCTION.md against what the library computes now.
//
//     test_reproduction            compare; status 1 where a figure, a row or a count differs
//     test_reproduction --write    write the figures into the file
//     test_reproduction KEY        print the figures of one row
#include "document.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE_SIZE = 8192 };
static const char path[] = BICYCLE_SOURCE_DIR "/validate/REPRODUCTION.md";
static const char count_key[] = "verdicts"; // the row that counts the verdicts of the others

static const claim *const lists[] = {claims_motion, claims_turns, claims_modes, claims_effects,
                                     claims_conclusion};
enum { LISTS = sizeof lists / sizeof lists[0] };

static const claim *find_claim(const char *key) {
  for (int i = 0; i < LISTS; i++)
    for (const claim *c = lists[i]; c->key; c++)
      if (strcmp(c->key, key) == 0) return c;
  return NULL;
}

static int claim_count(void) {
  int count = 0;
  for (int i = 0; i < LISTS; i++)
    for (const claim *c = lists[i]; c->key; c++) count++;
  return count;
}

typedef struct tally {
  int rows, faults;
  int verdict[VERDICTS]; // of the whole file
  int constructed;       // of these, by construction
} tally;

// Every row has a claim and a verdict, and stands once.
static const claim *claim_of_row(tally *t, const char *key, const char *line) {
  static const claim *seen[256];
  const claim *c = find_claim(key);
  int verdict = document_verdict(line);
  bool twice = false;
  for (int i = 0; c && i < t->rows; i++) twice = twice || seen[i] == c;
  if (!c || verdict < 0 || twice || t->rows >= 256) {
    printf("%s: %s\n", key,
           !c      ? "no such claim"
           : twice ? "stands twice"
                   : "the verdict is none of confirmed, partly, not");
    t->faults++;
    return NULL;
  }
  seen[t->rows++] = c;
  return c;
}

static figures figures_of_row(tally *t, const char *key, const char *line) {
  figures computed = {0};
  if (strcmp(key, count_key) == 0) {
    computed.values[computed.count++] = claim_count();
    for (int v = 0; v < VERDICTS; v++) computed.values[computed.count++] = t->verdict[v];
    computed.values[computed.count++] = t->constructed;
    return computed;
  }
  const claim *c = claim_of_row(t, key, line);
  if (c) c->compute(&computed);
  return computed;
}

// They are counted first: their row stands before the others.
static void count_verdicts(tally *t, FILE *in) {
  static char line[LINE_SIZE];
  char key[KEY_SIZE];
  while (fgets(line, sizeof line, in)) {
    int verdict = document_key(key, line) ? document_verdict(line) : -1;
    if (verdict >= 0) t->verdict[verdict]++;
    if (verdict >= 0) t->constructed += document_is_constructed(line);
  }
  rewind(in);
}

// Reads the file line by line; with `out` writes the renewed one, else compares.
static tally go_through(FILE *in, FILE *out) {
  static char line[LINE_SIZE], renewed[LINE_SIZE];
  char key[KEY_SIZE];
  tally t = {0};
  count_verdicts(&t, in);
  while (fgets(line, sizeof line, in)) {
    bool is_row = document_key(key, line);
    figures computed = {0};
    if (is_row) computed = figures_of_row(&t, key, line);
    if (is_row && !out) t.faults += document_check(key, line, &computed);
    snprintf(renewed, sizeof renewed, "%s", line);
    if (is_row) document_renew(renewed, sizeof renewed, line, &computed);
    if (out) fputs(renewed, out);
  }
  if (t.rows != claim_count()) {
    printf("%d rows, %d claims are computed\n", t.rows, claim_count());
    t.faults++;
  }
  return t;
}

static int print_row(const char *key) {
  const claim *c = find_claim(key);
  if (!c) {
    fprintf(stderr, "no row '%s'\n", key);
    return 2;
  }
  figures computed = {0};
  c->compute(&computed);
  for (int i = 0; i < computed.count; i++) printf("%.12g\n", computed.values[i]);
  return 0;
}

static FILE *must_open(const char *name, const char *mode) {
  FILE *file = fopen(name, mode);
  if (file) return file;
  fprintf(stderr, "%s: %s\n", name, strerror(errno));
  exit(1);
}

int main(int argc, char **argv) {
  bool write = argc == 2 && strcmp(argv[1], "--write") == 0;
  if (argc == 2 && !write) return print_row(argv[1]);
  FILE *in = must_open(path, "r"), *out = NULL;
  char aside[sizeof path + 8];
  snprintf(aside, sizeof aside, "%s.new", path);
  if (write) out = must_open(aside, "w");
  tally t = go_through(in, out);
  fclose(in);
  if (out && (fclose(out) != 0 || rename(aside, path) != 0)) {
    fprintf(stderr, "%s: %s\n", path, strerror(errno));
    return 1;
  }
  printf("%d claims: %d confirmed, %d partly, %d not; %d faults\n", t.rows, t.verdict[0],
         t.verdict[1], t.verdict[2], t.faults);
  return t.faults > 0;
}
