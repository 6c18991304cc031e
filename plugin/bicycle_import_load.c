// SPDX-License-Identifier: Apache-2.0
// A user's model made to roll without an edit: the compiler is given a file that includes it and
// adds the marker of plugin/rolling.h, on two sites that are then moved to the hubs.
#include "bicycle_import.h"

#include "bicycle_mjcf_internal.h"
#include "runner_guard.h"

#include <bicycle/error.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const site_names[IMPORT_WHEELS] = {"rolling:rear_hub", "rolling:front_hub"};

static char *wrapping_text(const char *base) {
  char *text = NULL;
  if (strpbrk(base, "<>&\"")) return NULL;
  int length = asprintf(
      &text,
      "<mujoco><include file=\"%s\"/><worldbody><site name=\"%s\"/><site name=\"%s\"/></worldbody>"
      "<custom><tuple name=\"rolling_discs\"><element objtype=\"site\" objname=\"%s\" prm=\"1\"/>"
      "<element objtype=\"site\" objname=\"%s\" prm=\"1\"/></tuple></custom></mujoco>",
      base, site_names[0], site_names[1], site_names[0], site_names[1]);
  return length < 0 ? NULL : text;
}

static mjModel *compile(const char *name, const char *text, mjcf_error *error) {
  mjVFS *vfs = (mjVFS *)malloc(sizeof *vfs); // 2 MB: too large for a stack
  mjcf_error why = {.text = ""};
  mjModel *model = NULL;
  if (!vfs) return mjcf_fail_memory(error), NULL;
  mj_defaultVFS(vfs);
  if (guard_make_file(vfs, name, (int)strlen(text))) {
    // NOLINTNEXTLINE(bugprone-not-null-terminated-result): a file of that size, not a string
    memcpy(vfs->filedata[0], text, strlen(text));
    model = mjcf_call_compiler(name, vfs, &why);
  } else {
    mjcf_fail_memory(&why);
  }
  mj_deleteVFS(vfs);
  free(vfs);
  if (!model) {
    mjcf_fail(error, "with a marker for its wheels: %.400s", why.text);
    error->no_memory = why.no_memory;
  }
  return model;
}

// The same folder, so that what the model includes is found.
static mjModel *compile_beside(const char *path, mjcf_error *error) {
  const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
  char *name = NULL, *text = wrapping_text(base);
  mjModel *model = NULL;
  if (text && asprintf(&name, "%.*s.rolling-%s", (int)(base - path), path, base) < 0) name = NULL;
  if (text && name)
    model = compile(name, text, error);
  else
    mjcf_fail(error, "the file's name cannot stand in XML");
  free(text);
  free(name);
  return model;
}

static void mark(mjModel *m, const import_map *map) {
  static const double unit[4] = {1, 0, 0, 0};
  int tuple = mj_name2id(m, mjOBJ_TUPLE, "rolling_discs");
  for (int i = 0; i < IMPORT_WHEELS; i++) {
    int site = mj_name2id(m, mjOBJ_SITE, site_names[i]);
    m->site_bodyid[site] = map->wheel[i];
    m->site_sameframe[site] = 0;
    mju_copy3(m->site_pos + 3 * site, map->hub[i]);
    mju_copy4(m->site_quat + 4 * site, unit);
    m->tuple_objprm[m->tuple_adr[tuple] + i] = map->radius[i];
  }
  m->opt.disableflags |= mjDSBL_CONTACT; // the ground would be there twice
}

mjModel *import_load_rolling(const char *path, mjcf_error *error) {
  mjModel *plain = mjcf_load(path, error);
  if (!plain || mj_name2id(plain, mjOBJ_TUPLE, "rolling_discs") >= 0) return plain;
  bike_bicycle bicycle;
  import_map map;
  bool found = import_bicycle(&bicycle, &map, plain, error);
  mj_deleteModel(plain);
  if (!found) return NULL;
  size_t length = strlen(path);
  if (length >= 4 && strcmp(path + length - 4, ".mjb") == 0)
    return mjcf_fail(error, "a compiled model needs a tuple 'rolling_discs' of its own"), NULL;
  mjModel *model = compile_beside(path, error);
  if (!model) return NULL;
  mark(model, &map);
  if (mjcf_apply_inertia(model, error)) return model;
  mj_deleteModel(model);
  return NULL;
}
