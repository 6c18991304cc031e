// SPDX-License-Identifier: Apache-2.0
// The constraints of all discs, skates and driven joints as one linear system on accelerations:
//   M qacc = f + J^T lambda,  J qacc = target  =>  (J M^-1 J^T) lambda = target - J M^-1 f.
#include "rolling_internal.h"

// How many mjtNum an array of n objects takes.
static int numbers(int n, size_t size) {
  return (int)(((size_t)n * size + sizeof(mjtNum) - 1) / sizeof(mjtNum));
}

// mj_stackAlloc ends the program where the stack is too small: looked up before.
static roll_error take_memory(roll_system *s, mjData *d) {
  int nv = s->nv, n = 3 * s->contacts + s->motions;
  int contacts = numbers(s->contacts, sizeof(roll_contact));
  int motions = numbers(s->motions, sizeof(roll_motion));
  int pivots = numbers(n, sizeof(int));
  int size = contacts + motions + pivots + 2 * n * nv + 2 * n * n + 5 * n + nv;
  int for_apply_ft = 6 * nv; // mj_applyFT takes two 3 x nv Jacobians
  if (size + for_apply_ft > d->nstack - d->pstack) return ROLL_NO_STACK;
  mjtNum *next = mj_stackAlloc(d, size);
  s->contact = (roll_contact *)next, next += contacts;
  s->motion = (roll_motion *)next, next += motions;
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

// Of the three rows of a point's velocity, those of a blade: up and sideways.
static void turn_rows(mjtNum *J, const roll_contact *contact, int nv) {
  for (int i = 0; i < nv; i++) {
    const mjtNum v[3] = {J[i], J[nv + i], J[2 * nv + i]};
    for (int k = 0; k < contact->rows; k++) J[k * nv + i] = mju_dot3(contact->direction[k], v);
  }
}

static void note_error(roll_system *s, roll_error error, roll_object where) {
  if (s->error) return; // the first is told of
  s->error = error;
  s->fault = where;
}

// Contact and rows of one disc or skate.
static void add_wheel(roll_system *s, int skate, int address, int ground, const mjModel *m,
                      const mjData *d) {
  roll_contact *contact = s->contact + s->contacts++;
  contact->address = address;
  roll_wheel wheel;
  contact->error = roll_read_wheel(&wheel, m, address, ground, skate);
  if (!contact->error) contact->error = roll_place_contact(contact, &wheel, ground, d);
  if (contact->error) {
    note_error(s, contact->error, roll_wheel_fault(contact->error, m, address, ground));
    return;
  }
  mjtNum *J = s->J + s->rows * s->nv;
  contact->row = s->rows;
  mj_jac(m, d, J, NULL, contact->point, contact->body);
  if (skate) turn_rows(J, contact, s->nv);
  s->rows += contact->rows;
}

static void add_wheels(roll_system *s, roll_span span, int skate, const mjModel *m,
                       const mjData *d) {
  int ground = -1;
  for (int address = span.first; address < span.first + span.count; address++) {
    if (roll_is_ground(m, address))
      ground = m->tuple_objid[address];
    else
      add_wheel(s, skate, address, ground, m, d);
  }
}

static void add_motions(roll_system *s, roll_span span, const mjModel *m, const mjData *d) {
  for (int i = 0; i < span.count; i++) {
    roll_motion *motion = s->motion + s->motions++;
    motion->address = span.first + i;
    motion->error = roll_read_motion(motion, m, d);
    if (motion->error) {
      note_error(s, motion->error, roll_element(m, motion->address));
      continue;
    }
    mjtNum *J = s->J + s->rows * s->nv;
    mju_zero(J, s->nv);
    J[motion->dof] = 1;
    motion->row = s->rows++;
  }
}

roll_error roll_build_system(roll_system *s, const mjModel *m, mjData *d) {
  roll_marker marker = roll_find_marker(m);
  int wheels = roll_count_wheels(m, marker.discs) + roll_count_wheels(m, marker.skates);
  *s = (roll_system){.nv = m->nv,
                     .contacts = wheels,
                     .motions = marker.driven.count,
                     .fault = {mjOBJ_UNKNOWN, -1}};
  roll_error error = take_memory(s, d);
  s->contacts = s->motions = 0; // counted again while they are added
  if (error) return error;

  add_wheels(s, marker.discs, 0, m, d);
  add_wheels(s, marker.skates, 1, m, d);
  add_motions(s, marker.driven, m, d);
  mj_solveM2(m, d, s->Y, s->J, s->rows);
  roll_factor_system(s);
  return s->error;
}
