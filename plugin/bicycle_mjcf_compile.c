// SPDX-License-Identifier: Apache-2.0
// From text or file to a compiled model, with every failure in one line.
#include "bicycle_mjcf.h"
#include "runner_guard.h"

#include <bicycle/error.h>
#include <errno.h>
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

static mjModel *finish(load *l, void (*function)(void *), mjcf_error *error) {
  guard_report report;
  guard_call(&report, function, l);
  fold(l->error);
  if (report.failed || !l->model) {
    const char *why = report.failed ? report.error : report.warnings ? report.warning : l->error;
    mjcf_fail(error, "%s", *why ? why : "not a MuJoCo model");
    return NULL;
  }
  if (mjcf_apply_inertia(l->model, error)) return l->model;
  mj_deleteModel(l->model);
  return NULL;
}

mjModel *mjcf_compile(const char *text, mjcf_error *error) {
  static const char name[] = "bicycle.xml";
  size_t size = strlen(text);
  if (size == 0) return mjcf_fail(error, "the text is empty"), NULL; // MuJoCo would end the program
  mjVFS *vfs = (mjVFS *)malloc(sizeof *vfs);                         // 2 MB: too large for a stack
  mjModel *model = NULL;
  if (vfs) {
    mj_defaultVFS(vfs);
    if (mj_makeEmptyFileVFS(vfs, name, (int)size) == 0) {
      memcpy(vfs->filedata[0], text, size);
      load l = {.path = name, .vfs = vfs};
      model = finish(&l, load_xml, error);
    } else {
      mjcf_fail(error, "%s", bike_error_string(BIKE_ERROR_MEMORY));
    }
    mj_deleteVFS(vfs);
  } else {
    mjcf_fail(error, "%s", bike_error_string(BIKE_ERROR_MEMORY));
  }
  free(vfs);
  return model;
}

mjModel *mjcf_load(const char *path, mjcf_error *error) {
  struct stat about;
  if (stat(path, &about) != 0) return mjcf_fail(error, "%s", strerror(errno)), NULL;
  if (!S_ISREG(about.st_mode)) return mjcf_fail(error, "not a file"), NULL;
  size_t length = strlen(path);
  bool binary = length >= 4 && strcmp(path + length - 4, ".mjb") == 0;
  load l = {.path = path};
  return finish(&l, binary ? load_binary : load_xml, error);
}

mjModel *mjcf_model(const bike_bicycle *bicycle, const mjcf_options *options, const mjcf_key *key,
                    mjcf_error *error) {
  char *text = mjcf_text(bicycle, options, key, error);
  if (!text) return NULL;
  mjModel *model = mjcf_compile(text, error);
  free(text);
  return model;
}
