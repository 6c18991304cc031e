// SPDX-License-Identifier: Apache-2.0
// The callback, and putting it into MuJoCo.
#include "rolling_internal.h"

// Set by roll_install alone, before threads start; read-only after.
static mjfGeneric previous_control;

static void warn_of_discs(roll_error error, const mjModel *m, const mjData *d) {
  if (error) roll_warn(ROLL_SAY_DISC, roll_error_string(error), m, d);
}

static void warn_of_sensors(const mjModel *m, const mjData *d) {
  for (int i = 0; i < m->nsensor; i++)
    if (m->sensor_type[i] == mjSENS_FORCE || m->sensor_type[i] == mjSENS_TORQUE)
      roll_warn(ROLL_SAY_SENSOR,
                "rolling discs: force and torque sensors do not see the ground's forces", m, d);
}

// MuJoCo's solver may start from qacc_warmstart: within the constraints it never leaves them,
// however early it stops.  qacc += M^-1 J^T A^+ (target - J qacc)
static void project_warmstart(roll_system *s, const mjModel *m, mjData *d) {
  mju_mulMatVec(s->row_work, s->J, d->qacc_warmstart, s->rows, s->nv);
  mju_sub(s->row_work, s->target, s->row_work, s->rows);
  roll_find_change(s, s->row_work, m, d);
  mju_addTo(d->qacc_warmstart, s->dof_work, s->nv);
}

static void constrain(const mjModel *m, mjData *d) {
  int solver_rows = roll_has_solver_rows(m, d);
  if (solver_rows) roll_reset_solver_rows(m, d);
  mjMARKSTACK;
  roll_system system;
  roll_error error = roll_build_system(&system, m, d);
  warn_of_discs(error, m, d);
  if (system.rows) {
    roll_set_target(&system, m, d);
    roll_set_lambda(&system, m, d);
    mju_mulMatTVec(system.dof_work, system.J, system.lambda, system.rows, system.nv);
    mju_addTo(d->qfrc_passive, system.dof_work, system.nv);
    if (solver_rows) {
      roll_project_solver_rows(NULL, &system, m, d);
      project_warmstart(&system, m, d);
    }
  }
  mjFREESTACK;
  if (solver_rows) mj_projectConstraint(m, d); // takes stack itself
}

void roll_control(const mjModel *m, mjData *d) {
  mjfGeneric previous = previous_control;
  if (previous) previous(m, d);
  if (roll_disc_count(m) == 0) return;
  constrain(m, d);
  warn_of_sensors(m, d);
}

void roll_install(void) {
  if (mjcb_control == roll_control) return;
  previous_control = mjcb_control;
  mjcb_control = roll_control;
}

roll_error roll_uninstall(void) {
  if (mjcb_control != roll_control) return ROLL_NOT_INSTALLED;
  mjcb_control = previous_control;
  previous_control = NULL;
  return ROLL_OK;
}

int roll_is_installed(void) {
  return mjcb_control == roll_control;
}
