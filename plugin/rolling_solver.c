// SPDX-License-Identifier: Apache-2.0
// MuJoCo's own constraints (limits, friction loss, equalities, contacts) beside the discs.
//
// MuJoCo solves its rows Je qacc ~ aref after the callback and knows nothing of the discs: its
// forces Je^T f would push the discs off their constraints. Here each row is replaced by its part
// that the discs leave free, in the metric of M, so that J M^-1 Je'^T = 0:
//   z = A^+ J M^-1 Je^T,  Je' = Je - z^T J,  aref' = aref - z.target   (A = J M^-1 J^T).
// With J qacc = target both say the same of qacc, and the solver's forces no longer move the discs;
// the ground's answer to a row's force f is -z f.
#include "rolling_internal.h"

int roll_has_solver_rows(const mjModel *m, const mjData *d) {
  if (d->nefc == 0) return 0;
  if (!mj_isSparse(m)) return 1;
  roll_warn(ROLL_SAY_SPARSE,
            "rolling discs: with a sparse Jacobian limits, friction loss, equalities and contacts "
            "disturb the rolling; set <option jacobian=\"dense\"/>",
            m, d);
  return 0;
}

// mj_forwardSkip leaves the rows as an earlier call made them: this makes the callback a function
// of the state alone.
void roll_reset_solver_rows(const mjModel *m, mjData *d) {
  mj_makeConstraint(m, d);
  mj_referenceConstraint(m, d);
}

void roll_project_solver_rows(mjtNum *reaction, roll_system *s, const mjModel *m, mjData *d) {
  mjtNum *z = s->row_work;
  for (int row = 0; row < d->nefc; row++) {
    mjtNum *Je = d->efc_J + row * m->nv;
    roll_map_force(z, s, Je, m, d);
    roll_solve(z, &s->A, z);
    for (int i = 0; i < s->rows; i++) mju_addToScl(Je, s->J + i * s->nv, -z[i], s->nv);
    d->efc_aref[row] -= mju_dot(z, s->target, s->rows);
    if (reaction) mju_addToScl(reaction, z, -d->efc_force[row], s->rows);
  }
}
