// SPDX-License-Identifier: Apache-2.0
// A state on the constraints near a given one.
#include "rolling_internal.h"

#include <math.h>

// Newton's method doubles the digits with each step: a start that needs more than this many is not
// near the ground at all.
static const int most_steps = 50;

// Heights (as a share of 1 + the largest |qpos|) and contact velocities (of 1 + the largest |qvel|)
// of a consistent state: a thousand roundings; Newton's method ends far below where it can.
static const mjtNum consistent = 1e-13;

static mjtNum largest(const mjtNum *x, int n) {
  mjtNum most = 0;
  for (int i = 0; i < n; i++) {
    if (isnan(x[i])) return x[i];
    most = fmax(most, fabs(x[i]));
  }
  return most;
}

// Of each contact's rows their sum, weighted with the ground's normal, and the rows of the driven
// joints. A contact has at least one row: none is overwritten before it is used.
static void keep_positions(mjtNum *rows, const roll_system *s) {
  int nv = s->nv;
  for (int i = 0; i < s->contacts; i++) {
    const roll_contact *contact = s->contact + i;
    for (int k = 0; k < nv; k++) {
      mjtNum sum = 0;
      for (int j = 0; j < contact->rows; j++)
        sum += roll_upward(contact, j) * rows[(contact->row + j) * nv + k];
      rows[i * nv + k] = sum;
    }
  }
  for (int i = 0; i < s->motions; i++)
    mju_copy(rows + (s->contacts + i) * nv, rows + s->motion[i].row * nv, nv);
}

// Leaves of the system what positions must satisfy; target: what is missing.
static void aim_at_positions(roll_system *s) {
  keep_positions(s->J, s);
  keep_positions(s->Y, s);
  s->rows = s->contacts + s->motions;
  roll_factor_system(s);
  for (int i = 0; i < s->contacts; i++) s->target[i] = -s->contact[i].height;
  for (int i = 0; i < s->motions; i++) s->target[s->contacts + i] = -s->motion[i].off;
}

static roll_error build_at(roll_system *s, const mjModel *m, mjData *d) {
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  return roll_build_system(s, m, d);
}

// One step of Newton's method; `off` is the largest error before it.
static roll_error step_to_ground(mjtNum *off, const mjModel *m, mjData *d) {
  mjMARKSTACK;
  roll_system system;
  roll_error error = build_at(&system, m, d);
  if (!error) {
    aim_at_positions(&system);
    *off = largest(system.target, system.rows);
    roll_find_change(&system, system.target, m, d);
    mj_integratePos(m, d->qpos, system.dof_work, 1);
  }
  mjFREESTACK;
  return error;
}

static roll_error project_positions(const mjModel *m, mjData *d) {
  mjtNum off, before = INFINITY;
  for (int step = 0; step < most_steps; step++) {
    roll_error error = step_to_ground(&off, m, d);
    if (error) return error;
    if (!isfinite(off)) return step ? ROLL_NO_CONVERGENCE : ROLL_NOT_FINITE;
    mjtNum small = consistent * (1 + largest(d->qpos, m->nq));
    if (off <= small && !(off < before)) return ROLL_OK; // only rounding is left
    before = off;
  }
  return ROLL_NO_CONVERGENCE;
}

// The largest error of a row's velocity; all are left, with the sign to be taken away, in target.
static mjtNum velocity_error(roll_system *s, const mjData *d) {
  mju_mulMatVec(s->target, s->J, d->qvel, s->rows, s->nv);
  for (int i = 0; i < s->motions; i++) s->target[s->motion[i].row] -= s->motion[i].wanted[1];
  return largest(s->target, s->rows);
}

static roll_error project_velocities(const mjModel *m, mjData *d) {
  mjMARKSTACK;
  roll_system system;
  roll_error error = build_at(&system, m, d);
  mjtNum speed = error ? 0 : velocity_error(&system, d);
  // v -= M^-1 J^T A^+ J v, the second time to remove the rounding of the first
  for (int pass = 0; !error && pass < 2; pass++) {
    roll_find_change(&system, system.target, m, d);
    mju_subFrom(d->qvel, system.dof_work, m->nv);
    speed = velocity_error(&system, d);
  }
  mjFREESTACK;
  if (error) return error;
  if (!isfinite(speed)) return ROLL_NOT_FINITE;
  return speed <= consistent * (1 + largest(d->qvel, m->nv)) ? ROLL_OK : ROLL_NO_CONVERGENCE;
}

roll_error roll_project(const mjModel *m, mjData *d) {
  roll_marker marker = roll_find_marker(m);
  if (!roll_is_marked(&marker)) return ROLL_NO_MARKER;
  if (m->nq + m->nv > d->nstack - d->pstack) return ROLL_NO_STACK;
  mjMARKSTACK;
  mjtNum *qpos = mj_stackAlloc(d, m->nq + m->nv), *qvel = qpos + m->nq;
  mju_copy(qpos, d->qpos, m->nq);
  mju_copy(qvel, d->qvel, m->nv);
  roll_error error = project_positions(m, d);
  if (!error) error = project_velocities(m, d);
  if (error) {
    mju_copy(d->qpos, qpos, m->nq);
    mju_copy(d->qvel, qvel, m->nv);
  }
  mjFREESTACK;
  if (!error) mj_forward(m, d);
  return error;
}
