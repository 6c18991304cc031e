// SPDX-License-Identifier: Apache-2.0
#include "suite.h"

#include <stdlib.h>
#include <string.h>

void suite_clear(suite *s) {
  for (size_t i = 0; i < s->count; i++) {
    if (s->comparisons) comparison_close(&s->comparisons[i]);
    if (s->scenarios) scenario_clear(&s->scenarios[i]);
  }
  free(s->scenarios);
  free(s->comparisons);
  *s = (suite){0};
}

// Their files in the report would have the same names.
static term_exit check_names(const suite *s, problem *p) {
  for (size_t i = 0; i < s->count; i++)
    for (size_t k = 0; k < i; k++)
      if (strcmp(s->scenarios[i].name, s->scenarios[k].name) == 0)
        return problem_set(p, TERM_USAGE, "%.400s, %.400s: two scenarios have the name '%s'",
                           s->scenarios[k].path, s->scenarios[i].path, s->scenarios[i].name);
  return TERM_DONE;
}

// What others have recorded is looked through before anything is played, lest a wrong row is told
// when all scenarios before its own are done.
static term_exit check_recordings(const scenario *s, problem *p) {
  const engine_choice *choices[2] = {&s->reference, &s->candidate};
  const engine_ride ride = {.duration = s->duration, .sample = s->sample};
  term_exit code = TERM_DONE;
  for (int i = 0; i < 2 && code == TERM_DONE; i++)
    if (choices[i]->engine->check) code = choices[i]->engine->check(choices[i], &ride, p);
  return code == TERM_DONE ? code : problem_prefix(p, code, s->name);
}

static term_exit read_suite(suite *out, char *const *paths, size_t count, problem *p) {
  *out = (suite){calloc(count, sizeof *out->scenarios), calloc(count, sizeof *out->comparisons),
                 count};
  term_exit code = out->scenarios && out->comparisons ? TERM_DONE : problem_memory(p);
  for (size_t i = 0; i < count && code == TERM_DONE; i++)
    code = scenario_read(&out->scenarios[i], paths[i], p);
  if (code == TERM_DONE) code = check_names(out, p);
  for (size_t i = 0; i < count && code == TERM_DONE; i++)
    code = check_recordings(&out->scenarios[i], p);
  if (code != TERM_DONE) suite_clear(out);
  return code;
}

static void free_paths(char **paths, size_t count) {
  for (size_t i = 0; i < count; i++) free(paths[i]);
  free(paths);
}

static term_exit find_all(char ***out, size_t *count, char *const *given, int given_count,
                          problem *p) {
  if (given_count == 0) return scenario_list(out, count, p);
  char **paths = calloc((size_t)given_count, sizeof *paths);
  term_exit code = paths ? TERM_DONE : problem_memory(p);
  for (int i = 0; i < given_count && code == TERM_DONE; i++) {
    char path[SCENARIO_PATH];
    code = scenario_find(path, given[i], p);
    if (code == TERM_DONE && !(paths[i] = strdup(path))) code = problem_memory(p);
  }
  *out = paths;
  *count = paths ? (size_t)given_count : 0;
  return code;
}

term_exit suite_load(suite *out, char *const *given, int given_count, problem *p) {
  char **paths = NULL;
  size_t count = 0;
  *out = (suite){0};
  term_exit code = find_all(&paths, &count, given, given_count, p);
  if (code == TERM_DONE) code = read_suite(out, paths, count, p);
  free_paths(paths, count);
  return code;
}
