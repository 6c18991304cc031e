// SPDX-License-Identifier: Apache-2.0
// A folder in the manner of google-deepmind/mujoco_menagerie: model, scene, picture, README.md and
// the bicycle file they come from.
#include "cmd.h"
#include "picture.h"

#include "files/memory_stream.h"
#include "terminal/data.h"
#include "terminal/folder.h"

#include <bicycle/error.h>
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum {
  NAME_SIZE = 48, // MuJoCo's files in memory have names of at most 100 characters
  FILE_SIZE = NAME_SIZE + 8
};

// Places of the files in the set.
enum { MODEL, SCENE, README, SOURCE, PICTURE, FILES };

typedef struct names {
  char stem[NAME_SIZE];
  char file[FILES][FILE_SIZE];
  char path[TERM_PATH_SIZE]; // of the bicycle file
  bool shipped;
} names;

// The bicycle file's name without folder and kind; what might mean something to a shell, to XML or
// to Markdown becomes an underscore.
static void find_stem(char out[NAME_SIZE], const char *path) {
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
  const char *end = strrchr(base, '.');
  size_t length = end && end > base ? (size_t)(end - base) : strlen(base);
  snprintf(out, NAME_SIZE, "%.*s", (int)(length < NAME_SIZE ? length : NAME_SIZE - 1), base);
  for (char *c = out; *c; c++)
    if (!isalnum((unsigned char)*c) && *c != '-' && *c != '_') *c = '_';
  if (strcmp(out, "scene") == 0 || strcmp(out, "README") == 0 || !*out)
    snprintf(out, NAME_SIZE, "bicycle");
}

static bool find_names(names *out, const char *file) {
  if (!term_bicycle_path(out->path, file)) return false;
  out->shipped = strcmp(out->path, file) != 0;
  find_stem(out->stem, out->path);
  bool plain = term_ends_with(out->path, ".txt"); // BicycleParameters' other form
  snprintf(out->file[MODEL], FILE_SIZE, "%s.xml", out->stem);
  snprintf(out->file[SCENE], FILE_SIZE, "scene.xml");
  snprintf(out->file[README], FILE_SIZE, "README.md");
  snprintf(out->file[SOURCE], FILE_SIZE, "%s.%s", out->stem, plain ? "txt" : "yml");
  snprintf(out->file[PICTURE], FILE_SIZE, "%s.png", out->stem);
  return true;
}

//---------------------------------- contents ------------------------------------------------------

static bool read_source(term_file *out, const names *n, mjcf_error *error) {
  FILE *in = fopen(n->path, "re");
  if (!in && errno == ENOMEM) return mjcf_fail_memory(error);
  if (!in) return mjcf_fail(error, "%s", strerror(errno));
  char *bytes = NULL, block[4096];
  FILE *copy = bike_memory_stream(&bytes, &out->size);
  for (size_t count = 1; copy && count > 0;) {
    count = fread(block, 1, sizeof block, in);
    fwrite(block, 1, count, copy);
  }
  bool whole = copy && !ferror(in) && !ferror(copy);
  fclose(in);
  if (copy && fclose(copy) != 0) whole = false;
  out->bytes = bytes;
  return whole || mjcf_fail_memory(error);
}

static void keep_text(term_file *out, char *text) {
  out->bytes = text;
  out->size = text ? strlen(text) : 0;
}

static bool make_texts(term_file files[FILES], const cmd_set *set, const names *n,
                       mjcf_error *error) {
  const mjcf_origin origin = {.name = n->stem,
                              .source = n->file[SOURCE],
                              .command = set->command,
                              .version = term_version(),
                              .shipped = n->shipped,
                              .picture = !set->no_picture,
                              .start = *set->start};
  keep_text(&files[MODEL], mjcf_model_text(set->bicycle, set->options, set->key, error));
  if (files[MODEL].bytes)
    keep_text(&files[SCENE], mjcf_scene_text(set->bicycle, n->file[MODEL], error));
  if (files[SCENE].bytes)
    keep_text(&files[README], mjcf_readme_text(set->bicycle, set->options, &origin, error));
  return files[README].bytes && read_source(&files[SOURCE], n, error);
}

// The scene at its keyframe.
static picture_status take_picture(term_file *out, const mjModel *model, const double *qpos,
                                   mjcf_error *error) {
  picture_status status;
  picture *p = picture_create(model, (picture_size){1280, 800}, NULL, &status, error);
  char *bytes = NULL;
  FILE *stream = p ? bike_memory_stream(&bytes, &out->size) : NULL;
  if (p && !stream) {
    mjcf_fail_memory(error);
    status = PICTURE_MEMORY;
  }
  if (stream) {
    status = picture_write(stream, p, qpos, error);
    if (fclose(stream) != 0 && status == PICTURE_OK) status = PICTURE_MEMORY;
  }
  picture_free(p);
  out->bytes = bytes;
  return status;
}

// Compiled, so that no file leaves here that MuJoCo would refuse.
static term_exit fill(term_file files[FILES], const cmd_set *set, const names *n,
                      mjcf_error *error) {
  if (!make_texts(files, set, n, error)) return cmd_exit_of(error);
  mjModel *model = mjcf_compile_scene((const char *)files[SCENE].bytes, n->file[MODEL],
                                      (const char *)files[MODEL].bytes, error);
  if (!model) return cmd_exit_of(error);
  picture_status status = PICTURE_OK;
  if (!set->no_picture) status = take_picture(&files[PICTURE], model, set->key->qpos, error);
  mj_deleteModel(model);
  return status == PICTURE_OK ? TERM_DONE : TERM_INVALID;
}

term_exit cmd_write_set(const cmd_set *set) {
  names n;
  mjcf_error error = {.text = ""};
  if (!find_names(&n, set->file))
    return term_fail(TERM_USAGE, "%s: the path is too long", set->file);
  term_file files[FILES];
  for (int i = 0; i < FILES; i++) files[i] = (term_file){.name = n.file[i]};
  term_exit code = term_folder_check(set->output, files, FILES);
  if (code != TERM_DONE) return code;
  code = fill(files, set, &n, &error);
  if (code == TERM_DONE)
    code = term_folder_write(set->output, files, FILES);
  else
    term_fail(code, "%s: %s", set->file, error.text);
  for (int i = 0; i < FILES; i++) free((void *)files[i].bytes);
  return code;
}
