// SPDX-License-Identifier: Apache-2.0
#include "run.h"

#include "support/near.h"

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[64];

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *place) {
  (void)info, (void)kind, (void)place;
  return remove(path);
}

void run_enter(void) {
  snprintf(folder, sizeof folder, "/tmp/bicycle-cli-XXXXXX");
  assert_non_null(mkdtemp(folder));
}

void run_leave(void) {
  assert_int_equal(nftw(folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS), 0);
}

int run_enter_group(void **state) {
  (void)state;
  run_enter();
  return 0;
}

int run_enter_filled(const char *command) {
  run_enter();
  run_result made = run_command(command);
  if (made.status != 0) print_error("%s: %s\n", command, made.err);
  int status = made.status;
  run_free(&made);
  return status;
}

int run_leave_group(void **state) {
  (void)state;
  run_leave();
  return 0;
}

const char *run_folder(void) {
  return folder;
}

static char *read_all(FILE *file) {
  char *text = NULL;
  size_t size = 0;
  FILE *copy = open_memstream(&text, &size);
  rewind(file);
  for (int c = fgetc(file); c != EOF; c = fgetc(file)) fputc(c, copy);
  fclose(copy);
  fclose(file);
  return text;
}

// The child: never returns.
static void become(const char *command, int out, int err) {
  const char *old = getenv("PATH");
  char path[8192];
  snprintf(path, sizeof path, "%s/bin:%s", BICYCLE_BINARY_DIR, old ? old : "/usr/bin:/bin");
  if (chdir(folder) != 0 || setenv("PATH", path, 1) != 0) _exit(127);
  int in = open("/dev/null", O_RDONLY);
  dup2(in, 0);
  dup2(out, 1);
  dup2(err, 2);
  execl("/bin/sh", "sh", "-c", command, (char *)NULL);
  _exit(127);
}

run_result run_command(const char *command) {
  FILE *out = tmpfile(), *err = tmpfile();
  assert_non_null(out);
  assert_non_null(err);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) become(command, fileno(out), fileno(err));
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  return (run_result){.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                      .out = read_all(out),
                      .err = read_all(err)};
}

void run_free(run_result *result) {
  free(result->out);
  free(result->err);
}

char *run_list(void) {
  struct dirent **entries;
  char *text = NULL;
  size_t size = 0;
  int count = scandir(folder, &entries, NULL, alphasort);
  assert_true(count >= 0);
  FILE *list = open_memstream(&text, &size);
  for (int i = 0; i < count; i++) {
    fprintf(list, "%s\n", entries[i]->d_name);
    free(entries[i]);
  }
  free(entries);
  fclose(list);
  return text;
}

static int count_lines(const char *text) {
  int lines = 0;
  for (; *text; text++) lines += *text == '\n';
  return lines;
}

static bool is_refused(const run_wrong *wrong, const char *files) {
  run_result result = run_command(wrong->command);
  char *after = run_list();
  bool right = result.status == 2 && count_lines(result.err) == 1 && !*result.out &&
               strncmp(result.err, "bicycle", strlen("bicycle")) == 0 &&
               strstr(result.err, wrong->says) && strcmp(files, after) == 0;
  if (!right)
    print_error("%s\n  exit %d, must be 2; must say: %s\n  out: %s\n  err: %s\n  files: %s\n",
                wrong->command, result.status, wrong->says, result.out, result.err, after);
  free(after);
  run_free(&result);
  return right;
}

void run_all_wrong(const run_wrong *commands, size_t count) {
  char *files = run_list();
  int failures = 0;
  for (size_t i = 0; i < count; i++) failures += !is_refused(&commands[i], files);
  free(files);
  assert_int_equal(failures, 0);
}

json_t *run_json(const char *command) {
  run_result result = run_command(command);
  if (result.status != 0) print_error("%s: %s\n", command, result.err);
  assert_int_equal(result.status, 0);
  json_error_t error;
  json_t *document = json_loads(result.out, JSON_REJECT_DUPLICATES, &error);
  if (!document) print_error("%s: line %d: %s\n", command, error.line, error.text);
  assert_non_null(document);
  run_free(&result);
  return document;
}

double run_number(const json_t *object, const char *key) {
  const json_t *value = json_object_get(object, key);
  if (!json_is_number(value)) print_error("no number '%s'\n", key);
  assert_true(json_is_number(value));
  return json_number_value(value);
}

void run_well(const char *command) {
  run_result result = run_command(command);
  if (result.status != 0) fail_msg("%s: %s", command, result.err);
  run_free(&result);
}

char *run_read(const char *name) {
  char path[512], *text = NULL;
  size_t size = 0;
  snprintf(path, sizeof path, "%s/%s", run_folder(), name);
  FILE *file = fopen(path, "r"), *copy = open_memstream(&text, &size);
  assert_non_null(copy);
  if (!file) fail_msg("%s is missing", name);
  for (int c = fgetc(file); c != EOF; c = fgetc(file)) fputc(c, copy);
  fclose(copy);
  fclose(file);
  return text;
}

int run_occurrences(const char *text, const char *word) {
  int count = 0;
  for (; (text = strstr(text, word)); text += strlen(word)) count++;
  return count;
}
