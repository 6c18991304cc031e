// SPDX-License-Identifier: Apache-2.0
#include "validate_support.h"

#include "support/near.h"

#include <layer.h>

#include <ftw.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

const char support_scenario_text[] =
    "title: half a second\n"
    "bicycle: benchmark\n"
    "start: {speed: 4.6, lean_rate: 0.5}\n"
    "duration: 0.5\n"
    "sample: 0.01\n"
    "instants: {count: 5, seed: 7}\n"
    "reference: {engine: analytic}\n"
    "candidate: {engine: mujoco}\n"
    "gates:\n"
    "  - {layer: Lp, metric: relative, limit: 1e-12, reason: test}\n"
    "  - {layer: L0, metric: relative, limit: 1e-9, reason: test}\n"
    "  - {layer: L2, metric: max, signals: [lean, steer], limit: 1e-11, reason: test}\n"
    "  - {layer: L3, metric: balance_max, signals: [energy], limit: 1e-11, reason: test}\n"
    "  - {layer: L3, metric: max, signals: [rear_slip], limit: 1e-10, reason: test}\n";

char *support_folder(void) {
  char *folder = strdup("/tmp/bicycle-validate-XXXXXX");
  assert_non_null(folder);
  assert_non_null(mkdtemp(folder));
  return folder;
}

static int remove_entry(const char *path, const struct stat *status, int flag, struct FTW *ftw) {
  (void)status;
  (void)flag;
  (void)ftw;
  return remove(path);
}

void support_remove(char *folder) {
  assert_int_equal(nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS), 0);
  free(folder);
}

char *support_write(const char *folder, const char *name, const char *text) {
  char *path = NULL;
  assert_true(asprintf(&path, "%s/%s", folder, name) > 0);
  FILE *stream = fopen(path, "we");
  assert_non_null(stream);
  assert_true(fputs(text, stream) >= 0);
  assert_int_equal(fclose(stream), 0);
  return path;
}

char *support_read(const char *path) {
  FILE *stream = fopen(path, "re");
  if (!stream) return NULL;
  assert_int_equal(fseek(stream, 0, SEEK_END), 0);
  long size = ftell(stream);
  char *text = calloc(1, (size_t)size + 1);
  assert_non_null(text);
  rewind(stream);
  assert_int_equal(fread(text, 1, (size_t)size, stream), size);
  fclose(stream);
  return text;
}

double support_csv_value(const char *path, const char *column, int row) {
  char *text = support_read(path), *line = text;
  assert_non_null(text);
  int index = 0;
  char *header = strndup(text, strcspn(text, "\n")), *rest = header, *word;
  while ((word = strsep(&rest, ",")) && strcmp(word, column) != 0) index++;
  assert_non_null(word);
  for (int i = 0; i <= row; i++) line = strchr(line, '\n') + 1;
  for (int i = 0; i < index; i++) line = strchr(line, ',') + 1;
  double value = strtod(line, NULL);
  free(header);
  free(text);
  return value;
}

char *support_replace(const char *text, const char *from, const char *to) {
  char *copy = NULL;
  const char *at = from ? strstr(text, from) : text;
  assert_non_null(at);
  assert_true(asprintf(&copy, "%.*s%s%s", (int)(at - text), text, to ? to : "",
                       at + (from ? strlen(from) : 0)) >= 0);
  return copy;
}

char *support_home;

int support_enter(void **state) {
  (void)state;
  support_home = support_folder();
  return 0;
}

int support_leave(void **state) {
  (void)state;
  support_remove(support_home);
  support_home = NULL;
  return 0;
}

int support_validate(const char *arguments) {
  char *command = NULL;
  assert_true(asprintf(&command,
                       "cd %s && " BICYCLE_BINARY_DIR "/bin/bicycle-validate %s >out 2>err",
                       support_home, arguments) > 0);
  int status = system(command);
  free(command);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

char *support_output(const char *name) {
  char *path = NULL;
  assert_true(asprintf(&path, "%s/%s", support_home, name) > 0);
  char *text = support_read(path);
  free(path);
  return text;
}

void support_expect_text(const char *name, const char *part) {
  char *text = support_output(name);
  if (!text || !strstr(text, part)) fail_msg("no '%s' in '%s'", part, text ? text : "nothing");
  free(text);
}

void support_read_scenario(scenario *out, const char *folder, const char *text) {
  problem p = {""};
  char *path = support_write(folder, "test.yml", text);
  term_exit code = scenario_read(out, path, &p);
  assert_string_equal(p.text, "");
  assert_int_equal(code, TERM_DONE);
  free(path);
}

const measurement *support_find(const comparison *c, const char *layer_name, const char *signal,
                                const char *metric) {
  for (size_t i = 0; i < c->measurements.count; i++) {
    const measurement *m = &c->measurements.items[i];
    char name[MEASUREMENT_FULL_NAME];
    if (strcmp(m->layer, layer_name) == 0 && strcmp(m->metric, metric) == 0 &&
        strcmp(measurement_full_name(name, m), signal) == 0)
      return m;
  }
  fail_msg("nothing measured of %s %s %s", layer_name, signal, metric);
  return NULL;
}

support_run *support_open(const engine *candidate, const char *text) {
  support_run *run = calloc(1, sizeof *run);
  problem p = {""};
  assert_non_null(run);
  run->folder = support_folder();
  support_read_scenario(&run->scenario, run->folder, text);
  if (candidate) run->scenario.candidate.engine = candidate;
  assert_int_equal(comparison_open(&run->comparison, &run->scenario, &p), TERM_DONE);
  return run;
}

void support_close(support_run *run) {
  comparison_close(&run->comparison);
  scenario_clear(&run->scenario);
  support_remove(run->folder);
  free(run);
}

comparison *support_play(support_run *run) {
  problem p = {""};
  assert_int_equal(comparison_run(&run->comparison, &p), TERM_DONE);
  return &run->comparison;
}

size_t support_failed_gates(const gate_list *gates) {
  size_t failed = 0;
  for (size_t i = 0; i < gates->count; i++) failed += !gates->items[i].pass;
  return failed;
}

void support_expect_failure(const comparison *c, const char *layer_name, const char *named) {
  assert_int_equal(c->verdict, VERDICT_FAIL);
  assert_non_null(c->first_failure);
  assert_string_equal(c->first_failure->name, layer_name);
  if (!strstr(c->cause, named)) fail_msg("'%s' does not name %s", c->cause, named);
}

void support_expect_fault(const engine *candidate, const char *text, const char *layer_name,
                          const char *named) {
  support_run *run = support_open(candidate, text);
  support_expect_failure(support_play(run), layer_name, named);
  support_close(run);
}

static void steal(const mjModel *m, mjData *d) {
  (void)m;
  (void)d;
}

// Takes the callback away when half of the ride is over.
static bool steal_half_way(double share, void *user) {
  (void)user;
  if (share > 0.5) mjcb_control = steal;
  return true;
}

term_exit support_robbed_ride(trace *out, void *instance, const engine_ride *asked, problem *p) {
  engine_ride watched = *asked;
  mjfGeneric ours = mjcb_control;
  watched.progress = steal_half_way;
  term_exit code = engine_mujoco.ride(out, instance, &watched, p);
  mjcb_control = ours;
  return code;
}
