// SPDX-License-Identifier: Apache-2.0
#include "terminal/data.h"

#include <bicycle/error.h>
#include <dirent.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

__attribute__((format(printf, 2, 3))) static bool join(char out[TERM_PATH_SIZE], const char *format,
                                                       ...) {
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(out, TERM_PATH_SIZE, format, arguments);
  va_end(arguments);
  return length >= 0 && length < TERM_PATH_SIZE;
}

bool term_path_beside(char out[TERM_PATH_SIZE], const char *name) {
  char program[TERM_PATH_SIZE];
  ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
  if (length <= 0) return false;
  program[length] = '\0';
  char *slash = strrchr(program, '/');
  if (!slash) return false;
  *slash = '\0';
  return join(out, "%s/%s", program, name);
}

bool term_data_path(char out[TERM_PATH_SIZE], const char *name) {
  char folder[TERM_PATH_SIZE];
  return term_path_beside(folder, "../share/bicycle") && join(out, "%s/%s", folder, name);
}

static bool is_bare_name(const char *file) {
  return *file && !strpbrk(file, "/.");
}

// A bicycle's folder, file and name are called alike.
static bool shipped_path(char out[TERM_PATH_SIZE], const char *name) {
  char relative[TERM_PATH_SIZE];
  return join(relative, "model/%s/%s.yml", name, name) && term_data_path(out, relative) &&
         access(out, R_OK) == 0;
}

bool term_bicycle_path(char out[TERM_PATH_SIZE], const char *file) {
  if (is_bare_name(file) && shipped_path(out, file)) return true;
  return join(out, "%s", file);
}

static int is_shipped(const struct dirent *entry) {
  char path[TERM_PATH_SIZE];
  return is_bare_name(entry->d_name) && shipped_path(path, entry->d_name);
}

// "a, b, c": the shipped bicycles; empty when there are none.
static void list_shipped(char out[TERM_PATH_SIZE]) {
  char folder[TERM_PATH_SIZE];
  struct dirent **entries = NULL;
  out[0] = '\0';
  if (!term_data_path(folder, "model")) return;
  int count = scandir(folder, &entries, is_shipped, alphasort);
  size_t used = 0;
  for (int i = 0; i < count; i++) {
    if (used < TERM_PATH_SIZE)
      used += (size_t)snprintf(out + used, TERM_PATH_SIZE - used, "%s%s", i ? ", " : "",
                               entries[i]->d_name);
    free(entries[i]);
  }
  free(entries);
}

static term_exit fail_unknown(const char *file) {
  char shipped[TERM_PATH_SIZE];
  list_shipped(shipped);
  return term_fail(TERM_USAGE, "%s: neither a file nor a shipped bicycle (%s)", file,
                   *shipped ? shipped : "none found");
}

// The path tells of errors that are found later.
static term_exit load(bike_file *out, char path[TERM_PATH_SIZE], const char *file) {
  bike_file_error error;
  if (!term_bicycle_path(path, file)) return term_fail(TERM_USAGE, "%s: path too long", file);
  if (is_bare_name(file) && access(path, F_OK) != 0) return fail_unknown(file);
  int code = bike_file_read(out, path, &error);
  return code == BIKE_OK ? TERM_DONE : term_fail(term_exit_of(code), "%s", error.text);
}

term_exit term_load_file(bike_file *out, const char *file) {
  char path[TERM_PATH_SIZE];
  return load(out, path, file);
}

term_exit term_load_bicycle(bike_bicycle *bicycle, bike_model *model, const char *file) {
  char path[TERM_PATH_SIZE];
  bike_file read;
  term_exit status = load(&read, path, file);
  if (status != TERM_DONE) return status;
  *bicycle = read.bicycle;
  int code = model ? bike_model_init(model, bicycle) : BIKE_OK;
  return code == BIKE_OK ? TERM_DONE : term_fail_bike(code, path);
}
