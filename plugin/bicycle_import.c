// SPDX-License-Identifier: Apache-2.0
#include "bicycle_import_internal.h"

#include "runner_guard.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const char *import_name(char out[64], const char *name, int number) {
  if (*name)
    snprintf(out, 64, "'%.50s'", name);
  else
    snprintf(out, 64, "number %d", number);
  return out;
}

const char *import_joint_name(char out[64], const mjModel *m, int joint) {
  return import_name(out, m->names + m->name_jntadr[joint], joint);
}

const char *import_body_name(char out[64], const mjModel *m, int body) {
  return import_name(out, m->names + m->name_bodyadr[body], body);
}

const double *import_axis(const import_view *v, int joint) {
  return v->d->xaxis + 3 * joint;
}

const double *import_anchor(const import_view *v, int joint) {
  return v->d->xanchor + 3 * joint;
}

void import_hub(double out[3], const import_view *v, int wheel) {
  int body = v->map.wheel[wheel];
  mju_rotVecMat(out, v->map.hub[wheel], v->d->xmat + 9 * body);
  mju_addTo3(out, v->d->xpos + 3 * body);
}

// Bodies stand after their parents.
static void assign_assemblies(import_view *v) {
  v->assembly[0] = 0;
  for (int b = 1; b < v->m->nbody; b++)
    v->assembly[b] = v->m->body_jntnum[b] > 0 ? b : v->assembly[v->m->body_parentid[b]];
}

static void kinematics(void *argument) {
  import_view *v = (import_view *)argument;
  mj_resetData(v->m, v->d);
  mj_kinematics(v->m, v->d);
}

static bool find_all(bike_bicycle *out, import_view *v, mjcf_error *error) {
  guard_report report;
  assign_assemblies(v);
  guard_call(&report, kinematics, v);
  if (report.failed) return guard_fail(error, &report);
  return import_find_joints(v, error) &&
         import_check_physics(v->m, v->map.steer, v->map.spin, error) &&
         import_find_wheels(v, error) && import_find_geometry(v, error) &&
         import_lump(out, v, error);
}

bool import_bicycle(bike_bicycle *out, import_map *map, const mjModel *model, mjcf_error *error) {
  import_view v = {.m = model, .d = guard_make_data(model)};
  v.assembly = (int *)calloc((size_t)model->nbody, sizeof *v.assembly);
  bool found = v.d && v.assembly;
  if (!found)
    mjcf_fail_memory(error);
  else
    found = find_all(out, &v, error);
  if (found && map) *map = v.map;
  if (v.d) mj_deleteData(v.d);
  free(v.assembly);
  return found;
}
