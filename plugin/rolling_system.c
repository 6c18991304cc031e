// SPDX-License-Identifier: Apache-2.0
// The constraints of all rolling discs as one linear system on accelerations:
//   M qacc = f + J^T lambda,  J qacc = target  =>  (J M^-1 J^T) lambda = target - J M^-1 f.
#include "rolling_internal.h"

// Baumgarte's gains, rad/s and rad^2/s^2: critically damped at 5 rad/s. Measured on the wildest
// shipped ride (lean 20 deg, steer -17 deg at 6 m/s, RK4, 1 ms): the error of the steer is 8.4e-12
// rad at 5 rad/s, 1.0e-11 at 10, 1.5e-11 at 20, 5.8e-11 at 100, as the pull back to the ground feeds
// integration error of the constraint into the motion; without it the heights drift (8e-12 rad and
// 5e-12 m in 10 s). Unstable near velocity_gain * timestep = 2.7.
static const mjtNum velocity_gain = 10, position_gain = 25;

// How many mjtNum an array of n objects takes.
static int numbers(int n, size_t size) {
  return (int)(((size_t)n * size + sizeof(mjtNum) - 1) / sizeof(mjtNum));
}

// mj_stackAlloc ends the program where the stack is too small: looked up before.
static roll_error take_memory(roll_system *s, int discs, int nv, mjData *d) {
  int n = 3 * discs, contacts = numbers(discs, sizeof(roll_contact));
  int pivots = numbers(n, sizeof(int));
  int size = contacts + pivots + 2 * n * nv + 2 * n * n + 5 * n + nv;
  int for_apply_ft = 6 * nv; // mj_applyFT takes two 3 x nv Jacobians
  if (size + for_apply_ft > d->nstack - d->pstack) return ROLL_NO_STACK;
  mjtNum *next = mj_stackAlloc(d, size);
  s->contact = (roll_contact *)next, next += contacts;
  s->A.pivot = (int *)next, next += pivots;
  s->J = next, next += n * nv;
  s->Y = next, next += n * nv;
  s->A.L = next, next += n * n;
  s->A.G = next, next += n * n;
  s->A.inverse = next, next += n;
  s->A.work = next, next += n;
  s->target = next, next += n;
  s->lambda = next, next += n;
  s->row_work = next, next += n;
  s->dof_work = next;
  return ROLL_OK;
}

void roll_factor_system(roll_system *s) {
  // A = Y Y^T; its lower triangle is enough
  s->A.n = s->rows;
  for (int i = 0; i < s->rows; i++)
    for (int k = 0; k <= i; k++)
      s->A.L[i * s->rows + k] = mju_dot(s->Y + i * s->nv, s->Y + k * s->nv, s->nv);
  roll_factorise(&s->A);
}

void roll_map_force(mjtNum *a, roll_system *s, const mjtNum *f, const mjModel *m, mjData *d) {
  mj_solveM2(m, d, s->dof_work, f, 1);
  mju_mulMatVec(a, s->Y, s->dof_work, s->rows, s->nv);
}

void roll_find_change(roll_system *s, const mjtNum *a, const mjModel *m, mjData *d) {
  roll_solve(s->row_work, &s->A, a);
  mju_mulMatTVec(s->dof_work, s->J, s->row_work, s->rows, s->nv);
  mj_solveM(m, d, s->dof_work, s->dof_work, 1);
}

// Contact and rows of one disc.
static roll_error add_disc(roll_system *s, roll_contact *contact, int address, const mjModel *m,
                           const mjData *d) {
  roll_wheel wheel;
  contact->error = roll_read_wheel(&wheel, m, address);
  if (!contact->error) contact->error = roll_place_contact(contact, &wheel, d);
  if (contact->error) return contact->error;
  contact->row = s->rows;
  mj_jac(m, d, s->J + s->rows * s->nv, NULL, contact->point, contact->body);
  s->rows += 3;
  return ROLL_OK;
}

roll_error roll_build_system(roll_system *s, const mjModel *m, mjData *d) {
  roll_marker marker = roll_find_marker(m);
  *s = (roll_system){.nv = m->nv};
  if (take_memory(s, marker.count, m->nv, d)) return ROLL_NO_STACK;

  roll_error first = ROLL_OK;
  s->discs = marker.count;
  for (int i = 0; i < marker.count; i++) {
    roll_error error = add_disc(s, s->contact + i, marker.first + i, m, d);
    if (!first) first = error;
  }
  mj_solveM2(m, d, s->Y, s->J, s->rows);
  roll_factor_system(s);
  return first;
}

void roll_set_target(roll_system *s, const mjModel *m, const mjData *d) {
  const mjtNum *u = roll_ground()->normal;
  for (int i = 0; i < s->discs; i++) {
    roll_contact *contact = s->contact + i;
    if (contact->error) continue;
    roll_move_contact(contact, m, d);
    // J qacc = -Jdot v - bv J v - bp g u
    mjtNum *target = s->target + contact->row;
    for (int k = 0; k < 3; k++)
      target[k] = -contact->convective[k] - velocity_gain * contact->velocity[k] -
                  position_gain * contact->height * u[k];
  }
}

// f = passive - bias + applied + actuator + xfrc: what mj_fwdAcceleration will add up.
static void sum_forces(mjtNum *f, const mjModel *m, mjData *d) {
  mju_sub(f, d->qfrc_passive, d->qfrc_bias, m->nv);
  mju_addTo(f, d->qfrc_applied, m->nv);
  if (m->nu) {
    mj_fwdActuation(m, d); // at the time of mjcb_control it is that of the moment before
    mju_addTo(f, d->qfrc_actuator, m->nv);
  }
  for (int i = 1; i < m->nbody; i++) {
    const mjtNum *force = d->xfrc_applied + 6 * i, *torque = force + 3;
    if (mju_dot(force, force, 6) != 0) mj_applyFT(m, d, force, torque, d->xipos + 3 * i, i, f);
  }
}

void roll_set_lambda(roll_system *s, const mjModel *m, mjData *d) {
  // (J M^-1 J^T) lambda = target - J M^-1 f
  sum_forces(s->dof_work, m, d);
  roll_map_force(s->lambda, s, s->dof_work, m, d);
  mju_sub(s->lambda, s->target, s->lambda, s->rows);
  roll_solve(s->lambda, &s->A, s->lambda);
}
