// SPDX-License-Identifier: Apache-2.0
// The bicycle's parameters out of a compiled model, by MuJoCo's own kinematics: nothing of what
// made the model is used.
#include "engine_mujoco.h"
#include "runner_guard.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// As bike_assembly; a rider who moves is a body of his own, rigid to the rear frame in the file.
enum { RIDER = 4, BODIES };
static const char *const body_names[BODIES] = {"rear_frame", "rear_wheel", "front_frame",
                                               "front_wheel", "rider"};

typedef struct reading {
  const mjModel *m;
  mjData *d;        // positions at qpos0: upright and unsteered
  int body[BODIES]; // -1: no such body
  int steer;        // joint
} reading;

static term_exit find_names(reading *r, problem *p) {
  for (int i = 0; i < BODIES; i++) {
    r->body[i] = mj_name2id(r->m, mjOBJ_BODY, body_names[i]);
    if (r->body[i] < 0 && i != RIDER)
      return problem_set(p, TERM_USAGE, "the model has no body '%s'", body_names[i]);
  }
  r->steer = mj_name2id(r->m, mjOBJ_JOINT, "steer");
  if (r->steer < 0) return problem_set(p, TERM_USAGE, "the model has no joint 'steer'");
  return TERM_DONE;
}

// Radius of a wheel from the marker tuple of rolling discs, or of discs on contacts; 0 when it is
// not marked.
static double marked_radius(const mjModel *m, int body) {
  int tuple = mj_name2id(m, mjOBJ_TUPLE, "rolling_discs");
  if (tuple < 0) tuple = mj_name2id(m, mjOBJ_TUPLE, "contact_discs");
  for (int i = 0; tuple >= 0 && i < m->tuple_size[tuple]; i++) {
    int element = m->tuple_adr[tuple] + i;
    int type = m->tuple_objtype[element], id = m->tuple_objid[element];
    if ((type == mjOBJ_BODY && id == body) || (type == mjOBJ_GEOM && m->geom_bodyid[id] == body))
      return m->tuple_objprm[element];
  }
  return 0;
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The five lengths from both hubs and the steering axis, e_S up along it and e_p forward across it.
static void read_geometry(bike_geometry *out, const reading *r) {
  const double *rear = r->d->xpos + 3 * r->body[BIKE_REAR_WHEEL];
  const double *front = r->d->xpos + 3 * r->body[BIKE_FRONT_WHEEL];
  const double *anchor = r->d->xanchor + 3 * r->steer;
  const double *e_S = r->d->xaxis + 3 * r->steer;
  const double e_p[3] = {e_S[2], 0, -e_S[0]};
  double to_front[3], to_rear[3], hubs[3];
  for (int k = 0; k < 3; k++) {
    to_front[k] = front[k] - anchor[k];
    to_rear[k] = rear[k] - anchor[k];
    hubs[k] = rear[k] - front[k];
  }
  out->L_f = dot(e_p, to_front);
  out->L_r = -dot(e_p, to_rear);
  out->L_s = dot(e_S, hubs);
  out->R_r = marked_radius(r->m, r->body[BIKE_REAR_WHEEL]);
  out->R_f = marked_radius(r->m, r->body[BIKE_FRONT_WHEEL]);
}

// A body as a part; `origin` is the rear contact point.
static void read_part(bike_part *out, const reading *r, int index, const double origin[3]) {
  int body = r->body[index];
  snprintf(out->name, sizeof out->name, "%s", body_names[index]);
  out->assembly = index == RIDER ? BIKE_REAR_FRAME : (bike_assembly)index;
  out->mass = r->m->body_mass[body];
  for (int k = 0; k < 3; k++) out->position[k] = r->d->xipos[3 * body + k] - origin[k];
  mjcf_body_inertia(out->inertia, r->m, body);
}

term_exit engine_mujoco_read_back(bike_bicycle *out, const mjModel *model, problem *p) {
  reading r = {.m = model};
  term_exit code = find_names(&r, p);
  if (code != TERM_DONE) return code;
  r.d = guard_make_data(model);
  if (!r.d) return problem_memory(p);
  mj_kinematics(model, r.d);
  *out = bike_default_bicycle();
  snprintf(out->name, sizeof out->name, "%s", "mujoco");
  read_geometry(&out->geometry, &r);
  out->gravity = -model->opt.gravity[2];
  out->steer_damping = model->dof_damping[model->jnt_dofadr[r.steer]];
  const double *hub = r.d->xpos + 3 * r.body[BIKE_REAR_WHEEL];
  const double origin[3] = {hub[0], hub[1], hub[2] - out->geometry.R_r};
  for (int i = 0; i < BODIES; i++)
    if (r.body[i] >= 0) read_part(&out->parts[out->part_count++], &r, i, origin);
  mj_deleteData(r.d);
  return TERM_DONE;
}
