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

// Row i of an array of three rows a disc becomes their sum, weighted with the ground's normal.
static void keep_normal_rows(mjtNum *rows, int discs, int nv) {
  const mjtNum *u = roll_ground()->normal;
  for (int i = 0; i < discs; i++)
    for (int k = 0; k < nv; k++) {
      const mjtNum *at = rows + 3 * i * nv + k;
      rows[i * nv + k] = at[0] * u[0] + at[nv] * u[1] + at[2 * nv] * u[2];
    }
}

// Leaves of the system the rates of the heights alone.
static void keep_heights(roll_system *s) {
  keep_normal_rows(s->J, s->discs, s->nv);
  keep_normal_rows(s->Y, s->discs, s->nv);
  s->rows = s->discs;
  roll_factor_system(s);
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
    for (int i = 0; i < system.rows; i++) system.target[i] = -system.contact[i].height;
    *height = largest(system.target, system.rows);
    roll_find_change(&system, system.target, m, d);
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

// The largest velocity of a contact point, left in system->target.
static mjtNum contact_speed(roll_system *s, const mjData *d) {
  mju_mulMatVec(s->target, s->J, d->qvel, s->rows, s->nv);
  return largest(s->target, s->rows);
}

static roll_error project_velocities(const mjModel *m, mjData *d) {
  mjMARKSTACK;
  roll_system system;
  roll_error error = build_at(&system, m, d);
  mjtNum speed = error ? 0 : contact_speed(&system, d);
  // v -= M^-1 J^T A^+ J v, the second time to remove the rounding of the first
  for (int pass = 0; !error && pass < 2; pass++) {
    roll_find_change(&system, system.target, m, d);
    mju_subFrom(d->qvel, system.dof_work, m->nv);
    speed = contact_speed(&system, d);
  }
  mjFREESTACK;
  if (error) return error;
  if (!isfinite(speed)) return ROLL_NOT_FINITE;
  return speed <= consistent * (1 + largest(d->qvel, m->nv)) ? ROLL_OK : ROLL_NO_CONVERGENCE;
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
