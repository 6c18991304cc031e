// SPDX-License-Identifier: Apache-2.0
// The callback that makes the discs roll.
#include "rolling_internal.h"

#include <math.h>

// MuJoCo's solver may start from qacc_warmstart: within the constraints it never leaves them,
// however early it stops.  qacc += M^-1 J^T A^+ (target - J qacc)
static void project_warmstart(roll_system *s, const mjModel *m, mjData *d) {
  mju_mulMatVec(s->row_work, s->J, d->qacc_warmstart, s->rows, s->nv);
  mju_sub(s->row_work, s->target, s->row_work, s->rows);
  roll_find_change(s, s->row_work, m, d);
  mju_addTo(d->qacc_warmstart, s->dof_work, s->nv);
}

static int is_off(const roll_contact *contact) {
  mjtNum most = ROLL_OFF_SHARE * contact->radius, speed2 = 0;
  if (contact->error || contact->radius == 0) return 0;
  for (int k = 0; k < contact->rows; k++) {
    mjtNum speed = mju_dot3(contact->direction[k], contact->velocity);
    speed2 += speed * speed;
  }
  return fabs(contact->height) > most || sqrt(speed2) > ROLL_DECAY * most;
}

static void warn_of_state(const roll_system *s, const mjModel *m, const mjData *d) {
  if (s->A.repeated)
    roll_warn(
        ROLL_SAY_REPEATED,
        "rolling discs: constraints repeat each other (two discs on one axle?): the motion is "
        "exact, of the forces the smallest are reported",
        m, d);
  for (int i = 0; i < s->contacts; i++)
    if (is_off(s->contact + i))
      roll_warn(ROLL_SAY_START,
                "rolling discs: a wheel is off the ground or slips, more than any error of a fit "
                "start under a fit timestep: start from roll_project, or take smaller steps",
                m, d);
}

static void constrain(const mjModel *m, mjData *d) {
  int solver_rows = d->nefc;
  if (solver_rows) roll_reset_solver_rows(m, d);
  mjMARKSTACK;
  roll_system system;
  roll_error error = roll_build_system(&system, m, d);
  if (error) roll_warn_of(ROLL_SAY_DISC, error, system.fault, m, d);
  if (system.rows) {
    roll_set_target(&system, m, d);
    roll_set_lambda(&system, m, d);
    warn_of_state(&system, m, d);
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

// Force and torque sensors need a user sensor beside them, or MuJoCo does not call roll_sensor.
static void warn_of_sensors(const mjModel *m, const mjData *d) {
  int blind = 0;
  for (int i = 0; i < m->nsensor; i++) {
    int type = m->sensor_type[i];
    if (type == mjSENS_USER && m->sensor_needstage[i] == mjSTAGE_ACC) return;
    blind |= type == mjSENS_FORCE || type == mjSENS_TORQUE;
  }
  if (blind)
    roll_warn(ROLL_SAY_BLIND,
              "rolling discs: force and torque sensors do not see the ground's forces unless the "
              "model has a user sensor at stage acc, such as <user name=\"rolling:WHEEL:normal\" "
              "objtype=\"body\" objname=\"WHEEL\" datatype=\"real\" dim=\"1\" needstage=\"acc\"/>",
              m, d);
}

void roll_make_roll(const mjModel *m, mjData *d) {
  roll_marker marker = roll_find_marker(m);
  roll_object where;
  if (roll_check_names(&where, m)) roll_warn_of(ROLL_SAY_NAME, ROLL_BAD_NAME, where, m, d);
  if (!roll_is_marked(&marker)) return;
  constrain(m, d);
  warn_of_sensors(m, d);
}
