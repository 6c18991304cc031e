// SPDX-License-Identifier: Apache-2.0
// MuJoCo's own constraints (limits, friction loss, equalities, contacts) beside the discs.
//
// MuJoCo solves its rows Je qacc ~ aref after the callback and knows nothing of the discs: its
// forces Je^T f would push the discs off their constraints. Here each row is replaced by its part
// that the discs leave free, in the metric of M, so that J M^-1 Je'^T = 0:
//   z = A^+ J M^-1 Je^T,  Je' = Je - z^T J,  aref' = aref - z.target   (A = J M^-1 J^T).
// With J qacc = target both say the same of qacc, and the solver's forces no longer move the discs;
// the ground's answer to a row's force f is -z f.
//
// Je' has entries where Je has none. A sparse Jacobian (which MuJoCo keeps in arrays with room for
// all njmax x nv entries) is therefore written with every entry in its place.
#include "rolling_internal.h"

// mj_forwardSkip leaves the rows as an earlier call made them: this makes the callback a function
// of the state alone.
void roll_reset_solver_rows(const mjModel *m, mjData *d) {
  mj_makeConstraint(m, d);
  mj_referenceConstraint(m, d);
}

// Spreads compressed rows to nv entries each. From the last row on, none overwrites one before it.
static void spread_rows(const mjModel *m, mjData *d, mjtNum *scratch) {
  int nv = m->nv;
  for (int row = d->nefc - 1; row >= 0; row--) {
    const int *column = d->efc_J_colind + d->efc_J_rowadr[row];
    const mjtNum *entry = d->efc_J + d->efc_J_rowadr[row];
    mju_zero(scratch, nv);
    for (int i = 0; i < d->efc_J_rownnz[row]; i++) scratch[column[i]] = entry[i];
    mju_copy(d->efc_J + row * nv, scratch, nv);
  }
}

// The pattern of a matrix without empty places: `rows` rows, all of one supernode.
static void fill_pattern(int *rownnz, int *rowadr, int *rowsuper, int *colind, int rows,
                         int columns) {
  for (int row = 0; row < rows; row++) {
    rownnz[row] = columns;
    rowadr[row] = row * columns;
    rowsuper[row] = rows - 1 - row;
    for (int i = 0; i < columns; i++) colind[row * columns + i] = i;
  }
}

static void fill_sparse_rows(const mjModel *m, mjData *d) {
  fill_pattern(d->efc_J_rownnz, d->efc_J_rowadr, d->efc_J_rowsuper, d->efc_J_colind, d->nefc,
               m->nv);
  fill_pattern(d->efc_JT_rownnz, d->efc_JT_rowadr, d->efc_JT_rowsuper, d->efc_JT_colind, m->nv,
               d->nefc);
  mju_transpose(d->efc_JT, d->efc_J, d->nefc, m->nv);
}

void roll_project_solver_rows(mjtNum *reaction, roll_system *s, const mjModel *m, mjData *d) {
  int sparse = mj_isSparse(m);
  if (sparse) spread_rows(m, d, s->dof_work);
  mjtNum *z = s->row_work;
  for (int row = 0; row < d->nefc; row++) {
    mjtNum *Je = d->efc_J + row * m->nv;
    roll_map_force(z, s, Je, m, d);
    roll_solve(z, &s->A, z);
    for (int i = 0; i < s->rows; i++) mju_addToScl(Je, s->J + i * s->nv, -z[i], s->nv);
    d->efc_aref[row] -= mju_dot(z, s->target, s->rows);
    if (reaction) mju_addToScl(reaction, z, -d->efc_force[row], s->rows);
  }
  if (sparse) fill_sparse_rows(m, d);
}
