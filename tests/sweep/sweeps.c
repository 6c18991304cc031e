// SPDX-License-Identifier: Apache-2.0
#include "sweeps.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char SWEEP_RIDES[] = "bicycle: roadster\n"
                           "seed: 3\n"
                           "draws: 5\n"
                           "sweep:\n"
                           "  speed: [5.4, 5.8, 6.2]\n"
                           "  lean: [0, 0.2, 1.39, 1.55]\n" // no geometry at 1.55 and steer 1.3
                           "  steer: {uniform: [0.2, 1.3]}\n"
                           "  parts.rider.mass: {normal: [70, 10]}\n"
                           "outputs: [weave_speed, stable_ranges, eps_max, outcome, time]\n"
                           "ride: {time: 20}\n";

static void path_of(char out[256], const char *name) {
  snprintf(out, 256, "%s/%s", run_folder(), name);
}

void sweep_write(const char *name, const char *text) {
  char path[256];
  path_of(path, name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs(text, file);
  assert_int_equal(fclose(file), 0);
}

char *sweep_read(const char *name) {
  char path[256], *text = NULL;
  size_t size = 0;
  path_of(path, name);
  FILE *file = fopen(path, "r");
  if (!file) fail_msg("there is no %s", name);
  if (getdelim(&text, &size, '\0', file) < 0) text[0] = '\0';
  fclose(file);
  return text;
}

void sweep_run(int status, const char *format, ...) {
  char command[2048];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(command, sizeof command, format, arguments);
  va_end(arguments);
  run_result result = run_command(command);
  if (result.status != status)
    fail_msg("%s: exit %d, not %d: %s%s", command, result.status, status, result.out, result.err);
  run_free(&result);
}

void sweep_assert_same(const char *name, const char *other) {
  char *a = sweep_read(name), *b = sweep_read(other);
  if (strcmp(a, b) != 0) fail_msg("%s and %s differ", name, other);
  free(a);
  free(b);
}

long sweep_merged_count(const char *logs, const char *key) {
  char command[512];
  snprintf(command, sizeof command, "bicycle sweep merge --json %s || true", logs);
  json_t *report = run_json(command);
  const long value = (long)run_number(report, key);
  json_decref(report);
  return value;
}
