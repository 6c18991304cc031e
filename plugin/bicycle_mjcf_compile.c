// SPDX-License-Identifier: Apache-2.0
// From text or file to a compiled model, with every failure in one line.
#include "bicycle_mjcf_internal.h"
#include "rolling.h"
#include "runner_guard.h"

#include <bicycle/error.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// What mj_loadXML and mj_loadModel are asked, and what they answered.
typedef struct load {
  const char *path;
  mjVFS *vfs; // NULL: the path is a file
  mjModel *model;
  char error[MJCF_TEXT_SIZE];
} load;

static void load_xml(void *argument) {
  load *l = (load *)argument;
  l->model = mj_loadXML(l->path, l->vfs, l->error, sizeof l->error);
}

static void load_binary(void *argument) {
  load *l = (load *)argument;
  l->model = mj_loadModel(l->path, l->vfs);
}

// MuJoCo's messages have line feeds in them.
static void fold(char *text) {
  size_t length = strlen(text);
  while (length && (text[length - 1] == '\n' || text[length - 1] == '\r')) text[--length] = '\0';
  for (char *c = text; *c; c++)
    if (*c == '\n' || *c == '\r') *c = ' ';
}

static bool is_binary(const char *path) {
  size_t length = strlen(path);
  return length >= 4 && strcmp(path + length - 4, ".mjb") == 0;
}

mjModel *mjcf_call_compiler(const char *path, mjVFS *vfs, mjcf_error *error) {
  static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
  load l = {.path = path, .vfs = vfs};
  guard_report report;
  pthread_mutex_lock(&lock);
  guard_call(&report, is_binary(path) ? load_binary : load_xml, &l); // an error comes back here
  pthread_mutex_unlock(&lock);
  fold(l.error);
  if (!report.failed && l.model) return l.model;
  if (report.failed) return guard_fail(error, &report), NULL;
  if (guard_tells_of_memory(l.error)) return mjcf_fail_memory(error), NULL;
  const char *why = report.warnings ? report.warning : l.error;
  mjcf_fail(error, "%s", *why ? why : "not a MuJoCo model");
  return NULL;
}

// A tuple that looks like a marker of what rolls and is none would be passed over by everybody.
static bool check_names(const mjModel *model, mjcf_error *error) {
  roll_object where;
  roll_error code = roll_check(&where, model);
  if (code != ROLL_BAD_NAME) return true;
  roll_fault_string(error->text, sizeof error->text, code, where, model);
  return false;
}

static mjModel *load_exactly(const char *path, mjVFS *vfs, mjcf_error *error) {
  mjModel *model = mjcf_call_compiler(path, vfs, error);
  if (!model || (check_names(model, error) && mjcf_apply_inertia(model, error))) return model;
  mj_deleteModel(model);
  return NULL;
}

// A file in memory; false with a text.
static bool add_file(mjVFS *vfs, const char *name, const char *text, mjcf_error *error) {
  size_t size = strlen(text);
  if (size == 0) return mjcf_fail(error, "the text is empty"); // MuJoCo would end the program
  if (!guard_make_file(vfs, name, (int)size)) return mjcf_fail_memory(error);
  memcpy(vfs->filedata[vfs->nfile - 1], text, size);
  return true;
}

mjModel *mjcf_compile_scene(const char *scene, const char *model_file, const char *model,
                            mjcf_error *error) {
  static const char name[] = "bicycle-scene.xml";
  mjVFS *vfs = (mjVFS *)malloc(sizeof *vfs); // 2 MB: too large for a stack
  if (!vfs) return mjcf_fail_memory(error), NULL;
  mj_defaultVFS(vfs);
  mjModel *compiled = NULL;
  if (add_file(vfs, name, scene, error) && (!model_file || add_file(vfs, model_file, model, error)))
    compiled = load_exactly(name, vfs, error);
  mj_deleteVFS(vfs);
  free(vfs);
  return compiled;
}

mjModel *mjcf_compile(const char *text, mjcf_error *error) {
  return mjcf_compile_scene(text, NULL, NULL, error);
}

mjModel *mjcf_load(const char *path, mjcf_error *error) {
  struct stat about;
  if (stat(path, &about) != 0) return mjcf_fail(error, "%s", strerror(errno)), NULL;
  if (!S_ISREG(about.st_mode)) return mjcf_fail(error, "not a file"), NULL;
  return load_exactly(path, NULL, error);
}

mjModel *mjcf_model(const bike_bicycle *bicycle, const mjcf_options *options, const mjcf_key *key,
                    mjcf_error *error) {
  char *text = mjcf_text(bicycle, options, key, error);
  if (!text) return NULL;
  mjModel *model = mjcf_compile(text, error);
  free(text);
  return model;
}
