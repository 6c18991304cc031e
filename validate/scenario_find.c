// SPDX-License-Identifier: Apache-2.0
// Where scenarios stand: files by path, shipped ones by name.
#include "scenario.h"

#include "scenario_keys.h"
#include "terminal/data.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char extension[] = ".yml";

bool scenario_relative_path(char out[SCENARIO_PATH], const char *from, const char *name) {
  const char *slash = name[0] == '/' ? NULL : strrchr(from, '/');
  int folder = slash ? (int)(slash - from) + 1 : 0;
  int length = snprintf(out, SCENARIO_PATH, "%.*s%s", folder, from, name);
  return length >= 0 && length < SCENARIO_PATH;
}

term_exit scenario_find(char out[SCENARIO_PATH], const char *given, problem *p) {
  bool bare = *given && !strpbrk(given, "/.");
  char name[SCENARIO_PATH];
  if (bare && snprintf(name, sizeof name, "scenarios/%s%s", given, extension) < SCENARIO_PATH &&
      term_data_path(out, name) && access(out, R_OK) == 0)
    return TERM_DONE;
  if (snprintf(out, SCENARIO_PATH, "%s", given) >= SCENARIO_PATH)
    return problem_set(p, TERM_USAGE, "%.100s...: the path is too long", given);
  if (!bare || access(out, F_OK) == 0) return TERM_DONE;
  return problem_set(p, TERM_USAGE,
                     "%s: neither a file nor a shipped scenario (`bicycle validate list` shows "
                     "these)",
                     given);
}

static int is_scenario(const struct dirent *entry) {
  size_t length = strlen(entry->d_name);
  return entry->d_name[0] != '.' && length > strlen(extension) &&
         strcmp(entry->d_name + length - strlen(extension), extension) == 0;
}

term_exit scenario_list(char ***out, size_t *count, problem *p) {
  char folder[TERM_PATH_SIZE] = "";
  struct dirent **entries = NULL;
  int found =
      term_data_path(folder, "scenarios") ? scandir(folder, &entries, is_scenario, alphasort) : -1;
  if (found <= 0) {
    free(entries);
    return problem_set(p, TERM_USAGE, "%s: no scenarios are there", folder);
  }
  char **paths = calloc((size_t)found, sizeof *paths);
  bool lost = !paths;
  for (int i = 0; i < found; i++) {
    if (paths && asprintf(&paths[i], "%s/%s", folder, entries[i]->d_name) < 0) {
      paths[i] = NULL;
      lost = true;
    }
    free(entries[i]);
  }
  free(entries);
  *out = paths;
  *count = paths ? (size_t)found : 0;
  return lost ? problem_memory(p) : TERM_DONE;
}
