// SPDX-License-Identifier: Apache-2.0
// A state on the constraints near a given one.
#include "rolling_internal.h"

#include <math.h>

// Newton's method doubles the digits with each step: a start that needs more than this many is not
// near the ground at all.
static const int most_steps = 50;

// Heights (m) and contact velocities (as a share of 1 + the largest |qvel|) of a consistent state:
// a thousand roundings for metre-sized bodies; Newton's method ends far below where it can.
static const mjtNum consistent = 1e-13;

static mjtNum largest(const mjtNum *x, int n) {
  mjtNum most = 0;
  for (int i = 0; i < n; i++) {
    if (isnan(x[i])) return x[i];
    most = fmax(most, fabs(x[i]));
  }
  return most;
}

// Leaves of the system the heights alone: row i becomes u.J of disc i, and row_work the heights.
static void keep_heights(roll_system *s) {
  const mjtNum *u = roll_ground()->normal;
  int nv = s->nv;
  for (int i = 0; i < s->discs; i++) {
    s->row_work[i] = s->contact[i].height;
    for (int k = 0; k < nv; k++) {
      const mjtNum *J = s->J + 3 * i * nv + k, *W = s->MinvJT + 3 * i * nv + k;
      mjtNum column[3] = {J[0], J[nv], J[2 * nv]}, w[3] = {W[0], W[nv], W[2 * nv]};
      s->J[i * nv + k] = mju_dot3(column, u);
      s->MinvJT[i * nv + k] = mju_dot3(w, u);
    }
  }
  s->rows = s->discs;
  roll_factor_system(s);
}

// dof_work = -M^-1 J^T A^+ (what row_work holds): the smallest change that removes it.
static void find_change(roll_system *s) {
  roll_solve(s->row_work, &s->A, s->row_work);
  mju_mulMatTVec(s->dof_work, s->MinvJT, s->row_work, s->rows, s->nv);
  mju_scl(s->dof_work, s->dof_work, -1, s->nv);
}

static roll_error build_at(roll_system *s, const mjModel *m, mjData *d) {
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  return roll_build_system(s, m, d);
}

// One step of Newton's method; `height` is the largest before it.
static roll_error step_to_ground(mjtNum *height, const mjModel *m, mjData *d) {
  mjMARKSTACK;
  roll_system system;
  roll_error error = build_at(&system, m, d);
  if (!error) {
    keep_heights(&system);
    *height = largest(system.row_work, system.rows);
    find_change(&system);
    mj_integratePos(m, d->qpos, system.dof_work, 1);
  }
  mjFREESTACK;
  return error;
}

static roll_error project_positions(const mjModel *m, mjData *d) {
  mjtNum height, before = INFINITY;
  for (int step = 0; step < most_steps; step++) {
    roll_error error = step_to_ground(&height, m, d);
    if (error) return error;
    if (!isfinite(height)) return step ? ROLL_NO_CONVERGENCE : ROLL_NOT_FINITE;
    if (height <= consistent && !(height < before)) return ROLL_OK; // only rounding is left
    before = height;
  }
  return ROLL_NO_CONVERGENCE;
}

static roll_error project_velocities(const mjModel *m, mjData *d) {
  mjMARKSTACK;
  roll_system system;
  mjtNum speed = 0;
  roll_error error = build_at(&system, m, d);
  // v -= M^-1 J^T A^+ J v, the second time to remove the rounding of the first
  for (int pass = 0; !error && pass < 3; pass++) {
    mju_mulMatVec(system.row_work, system.J, d->qvel, system.rows, m->nv);
    speed = largest(system.row_work, system.rows);
    if (pass == 2) break;
    find_change(&system);
    mju_addTo(d->qvel, system.dof_work, m->nv);
  }
  mjFREESTACK;
  if (error) return error;
  return speed <= consistent * (1 + largest(d->qvel, m->nv)) ? ROLL_OK : ROLL_NOT_FINITE;
}

roll_error roll_project(const mjModel *m, mjData *d) {
  if (roll_disc_count(m) == 0) return ROLL_NO_MARKER;
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
