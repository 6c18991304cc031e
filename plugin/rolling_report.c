// SPDX-License-Identifier: Apache-2.0
// What the discs do at this moment, computed anew from the state: nothing is kept from the
// callback.
#include "rolling_internal.h"

static const char *disc_name(const mjModel *m, int address) {
  const char *name = mj_id2name(m, m->tuple_objtype[address], m->tuple_objid[address]);
  return name ? name : "";
}

static void describe(roll_disc *disc, const roll_contact *contact, const mjtNum *lambda) {
  const mjtNum *u = roll_ground()->normal, *force = lambda + contact->row;
  disc->body = contact->body;
  disc->radius = contact->radius;
  mju_copy3(disc->point, contact->point);
  mju_copy3(disc->force, force);
  disc->normal_force = mju_dot3(force, u);
  disc->height = contact->height;
  disc->height_rate = mju_dot3(contact->velocity, u);
  mju_addScl3(disc->slip, contact->velocity, u, -disc->height_rate);
}

// What the callback added to qfrc_passive is J^T lambda: mj_passive makes the rest anew.
static void find_forces(roll_system *s, const mjModel *m, mjData *d) {
  mju_copy(s->dof_work, d->qfrc_passive, m->nv);
  mj_passive(m, d);
  for (int i = 0; i < m->nv; i++) {
    mjtNum rest = d->qfrc_passive[i];
    d->qfrc_passive[i] = s->dof_work[i];
    s->dof_work[i] -= rest;
  }
  // A lambda = J M^-1 (J^T lambda)
  roll_map_force(s->lambda, s, s->dof_work, m, d);
  roll_solve(s->lambda, &s->A, s->lambda);
}

roll_error roll_discs(roll_disc *discs, int count, const mjModel *m, mjData *d) {
  roll_marker marker = roll_find_marker(m);
  if (marker.count == 0) return ROLL_NO_MARKER;
  int solver_rows = roll_has_solver_rows(m, d);
  if (solver_rows) roll_reset_solver_rows(m, d);
  mjMARKSTACK;
  roll_system system;
  roll_error error = roll_build_system(&system, m, d);
  if (error != ROLL_NO_STACK) {
    roll_set_target(&system, m, d);
    find_forces(&system, m, d);
    if (solver_rows) roll_project_solver_rows(system.lambda, &system, m, d);
  }
  for (int i = 0; i < count; i++) {
    discs[i] = (roll_disc){.name = disc_name(m, marker.first + i)};
    discs[i].error = error == ROLL_NO_STACK ? error : system.contact[i].error;
    if (!discs[i].error) describe(discs + i, system.contact + i, system.lambda);
  }
  mjFREESTACK;
  if (solver_rows) mj_projectConstraint(m, d); // as the callback left it
  return error;
}
