// SPDX-License-Identifier: Apache-2.0
// What the constraints demand of the accelerations, and the forces that give it.
#include "rolling_internal.h"

// Baumgarte's gains, rad/s and rad^2/s^2: critically damped at ROLL_DECAY. Measured on the wildest
// shipped ride (lean 20 deg, steer -17 deg at 6 m/s, RK4, 1 ms): the error of the steer is 8.4e-12
// rad at 5 rad/s, 1.0e-11 at 10, 1.5e-11 at 20, 5.8e-11 at 100, as the pull back to the ground
// feeds integration error of the constraint into the motion; without it the heights drift (8e-12
// rad and 5e-12 m in 10 s). Unstable near velocity_gain * timestep = 2.7.
static const mjtNum velocity_gain = 2 * ROLL_DECAY, position_gain = ROLL_DECAY * ROLL_DECAY;

// d/dt of a row (d.v) is d'.v + d.(Jdot qvel + J qacc);  d.J qacc = -d.Jdot qvel - d'.v - bv d.v -
// bp g (d.u)
static void aim_contact(mjtNum *target, const roll_contact *contact) {
  for (int k = 0; k < contact->rows; k++) {
    const mjtNum *direction = contact->direction[k];
    target[k] = -mju_dot3(direction, contact->convective) -
                velocity_gain * mju_dot3(direction, contact->velocity) -
                position_gain * contact->height * roll_upward(contact, k);
  }
  if (contact->skate) target[1] -= mju_dot3(contact->sideways_rate, contact->velocity);
}

void roll_set_target(roll_system *s, const mjModel *m, const mjData *d) {
  for (int i = 0; i < s->contacts; i++) {
    if (s->contact[i].error) continue;
    roll_move_contact(s->contact + i, m, d);
    aim_contact(s->target + s->contact[i].row, s->contact + i);
  }
  for (int i = 0; i < s->motions; i++) {
    const roll_motion *motion = s->motion + i;
    if (motion->error) continue;
    // q'' = w'' - bv (q' - w') - bp (q - w)
    s->target[motion->row] = motion->wanted[2] -
                             velocity_gain * (d->qvel[motion->dof] - motion->wanted[1]) -
                             position_gain * motion->off;
  }
}

// f = passive - bias + applied + actuator + xfrc: what mj_fwdAcceleration will add up.
static void sum_forces(mjtNum *f, const mjModel *m, mjData *d) {
  if (m->nu) mj_fwdActuation(m, d); // at the time of mjcb_control it is that of the moment before
  mju_sub(f, d->qfrc_passive, d->qfrc_bias, m->nv);
  mju_addTo(f, d->qfrc_applied, m->nv);
  if (m->nu) mju_addTo(f, d->qfrc_actuator, m->nv);
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
