// SPDX-License-Identifier: Apache-2.0
// What the discs do at this moment, computed anew from the state: nothing is kept from the
// callback.
#include "rolling_internal.h"

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

roll_error roll_survey(roll_system *s, const mjModel *m, mjData *d) {
  if (d->nefc) roll_reset_solver_rows(m, d);
  roll_error error = roll_build_system(s, m, d);
  if (error == ROLL_NO_STACK) return error;
  roll_set_target(s, m, d);
  find_forces(s, m, d);
  if (d->nefc) roll_project_solver_rows(s->lambda, s, m, d);
  return error;
}

void roll_restore(const mjModel *m, mjData *d) {
  if (d->nefc) mj_projectConstraint(m, d); // as the callback left it
}

//---------------------------------- one of them ---------------------------------------------------

void roll_describe_disc(roll_disc *disc, const roll_system *s, int index, const mjModel *m) {
  const roll_contact *contact = s->contact + index;
  *disc = (roll_disc){.name = roll_element_name(m, contact->address), .error = contact->error};
  if (contact->error) return;
  const mjtNum *u = contact->ground.normal;
  disc->body = contact->body;
  disc->radius = contact->radius;
  mju_copy3(disc->point, contact->point);
  for (int k = 0; k < contact->rows; k++)
    mju_addToScl3(disc->force, contact->direction[k], s->lambda[contact->row + k]);
  disc->normal_force = mju_dot3(disc->force, u);
  disc->lifts = disc->normal_force < 0;
  disc->height = contact->height;
  disc->height_rate = mju_dot3(contact->velocity, u);
  for (int k = 0; k < contact->rows; k++)
    mju_addToScl3(disc->slip, contact->direction[k],
                  mju_dot3(contact->direction[k], contact->velocity));
  mju_addToScl3(disc->slip, u, -disc->height_rate);
}

void roll_describe_drive(roll_drive *drive, const roll_system *s, int index, const mjModel *m,
                         const mjData *d) {
  const roll_motion *motion = s->motion + index;
  *drive = (roll_drive){.name = roll_element_name(m, motion->address), .error = motion->error};
  if (motion->error) return;
  drive->joint = motion->joint;
  mju_copy3(drive->motion, motion->wanted);
  drive->off = motion->off;
  drive->rate_off = d->qvel[motion->dof] - motion->wanted[1];
  drive->force = s->lambda[motion->row];
  drive->power = drive->force * d->qvel[motion->dof];
}

//---------------------------------- for the host --------------------------------------------------

roll_error roll_discs(roll_disc *discs, int count, const mjModel *m, mjData *d) {
  roll_marker marker = roll_find_marker(m);
  if (!roll_is_marked(&marker)) return ROLL_NO_MARKER;
  mjMARKSTACK;
  roll_system system;
  roll_error error = roll_survey(&system, m, d);
  for (int i = 0; i < count; i++) {
    discs[i] = (roll_disc){.name = "", .error = ROLL_NO_STACK};
    if (error != ROLL_NO_STACK) roll_describe_disc(discs + i, &system, i, m);
  }
  mjFREESTACK;
  roll_restore(m, d);
  return error;
}

roll_error roll_drives(roll_drive *drives, int count, const mjModel *m, mjData *d) {
  roll_marker marker = roll_find_marker(m);
  if (!roll_is_marked(&marker)) return ROLL_NO_MARKER;
  mjMARKSTACK;
  roll_system system;
  roll_error error = roll_survey(&system, m, d);
  for (int i = 0; i < count; i++) {
    drives[i] = (roll_drive){.name = "", .error = ROLL_NO_STACK};
    if (error != ROLL_NO_STACK) roll_describe_drive(drives + i, &system, i, m, d);
  }
  mjFREESTACK;
  roll_restore(m, d);
  return error;
}
