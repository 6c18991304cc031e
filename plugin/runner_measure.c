// SPDX-License-Identifier: Apache-2.0
// One instant of a MuJoCo bicycle in the terms of the analytic model.
#include "runner_guard.h"
#include "runner_internal.h"

#include <math.h>

void runner_find_disc(runner_disc *out, const runner *r, const mjData *d, int wheel) {
  const runner_wheel *w = &r->map.wheel[wheel];
  const double *n = d->xaxis + 3 * w->hinge.joint;
  double hub[3];
  mju_rotVecMat(hub, w->hub, d->xmat + 9 * w->body);
  mju_addTo3(hub, d->xpos + 3 * w->body);
  // e = -(z - n_z n)/s points from the hub to the lowest point;  height = hub_z - R s
  double s = hypot(n[0], n[1]), arm[3];
  for (int k = 0; k < 3; k++) out->point[k] = hub[k] - w->radius * ((k == 2) - n[2] * n[k]) / s;
  out->height = hub[2] - w->radius * s;
  // v_p = v_O + w x (p - O), O being the point that cvel refers to
  const double *rotation = d->cvel + 6 * w->body;
  mju_sub3(arm, out->point, d->subtree_com + 3 * r->model->body_rootid[w->body]);
  mju_cross(out->velocity, rotation, arm);
  mju_addTo3(out->velocity, rotation + 3);
  out->speed = mju_norm3(rotation + 3) + mju_norm3(rotation) * mju_norm3(arm);
}

double runner_residual(const runner *r, const mjData *d) {
  double largest = 0;
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    runner_disc disc;
    runner_find_disc(&disc, r, d, i);
    double length = fmax(1, r->map.wheel[i].radius), speed = fmax(1, disc.speed);
    largest = fmax(largest, fabs(disc.height) / length);
    for (int k = 0; k < 3; k++) largest = fmax(largest, fabs(disc.velocity[k]) / speed);
    // fmax drops a NaN
    if (isnan(disc.height + disc.velocity[0] + disc.velocity[1] + disc.velocity[2])) return NAN;
  }
  return largest;
}

// World force of MuJoCo's contacts on a wheel.
static void sum_contacts(double force[3], const runner *r, const mjData *d, int body) {
  mju_zero3(force);
  for (int i = 0; i < d->ncon; i++) {
    const mjContact *contact = &d->contact[i];
    int second = r->model->geom_bodyid[contact->geom2] == body;
    if (!second && r->model->geom_bodyid[contact->geom1] != body) continue;
    double local[6], world[3];
    mj_contactForce(r->model, d, i, local);
    // Rows of the frame are its axes; the force is on the second geom.
    mju_mulMatTVec(world, contact->frame, local, 3, 3);
    mju_addToScl3(force, world, second ? 1 : -1);
  }
}

// Forces of the ground on the wheels, in the world's axes; a wheel may be marked more than once.
static roll_error sum_forces(double force[RUNNER_WHEELS][3], runner *r) {
  if (!r->map.exact) {
    for (int i = 0; i < RUNNER_WHEELS; i++)
      sum_contacts(force[i], r, r->probe, r->map.wheel[i].body);
    return ROLL_OK;
  }
  roll_error code = roll_discs(r->discs, r->disc_count, r->model, r->probe);
  for (int i = 0; i < r->disc_count; i++)
    for (int k = 0; k < RUNNER_WHEELS; k++)
      if (r->discs[i].body == r->map.wheel[k].body) mju_addTo3(force[k], r->discs[i].force);
  return code;
}

// World to (e_R, left of it, up).
static void turn_into_heading(double out[3], const double world[3], double yaw) {
  out[0] = cos(yaw) * world[0] + sin(yaw) * world[1];
  out[1] = -sin(yaw) * world[0] + cos(yaw) * world[1];
  out[2] = world[2];
}

static void fill_motion(runner_instant *out, const runner *r, const mjData *d) {
  runner_posture p;
  runner_read_posture(&p, r, d);
  const runner_wheel *w = r->map.wheel;
  out->yaw = p.angle[0], out->lean = p.angle[1], out->pitch = p.angle[2];
  out->yaw_rate = p.rate[0], out->lean_rate = p.rate[1], out->pitch_rate = p.rate[2];
  out->yaw_acceleration = p.acceleration[0];
  out->lean_acceleration = p.acceleration[1];
  out->pitch_acceleration = p.acceleration[2];
  const runner_hinge *steer = &r->map.steer;
  out->steer = steer->sign * (d->qpos[steer->qpos] - steer->zero);
  out->steer_rate = steer->sign * d->qvel[steer->dof];
  out->steer_acceleration = steer->sign * d->qacc[steer->dof];
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    const runner_hinge *hinge = &w[i].hinge;
    out->wheel_angle[i] = hinge->sign * (d->qpos[hinge->qpos] - hinge->zero);
    out->wheel_rate[i] = hinge->sign * d->qvel[hinge->dof];
    out->wheel_acceleration[i] = hinge->sign * d->qacc[hinge->dof];
  }
  // v = R_r (pitch' + rear_spin')
  out->speed = w[RUNNER_REAR].radius * (out->pitch_rate + out->wheel_rate[RUNNER_REAR]);
  out->speed_rate =
      w[RUNNER_REAR].radius * (out->pitch_acceleration + out->wheel_acceleration[RUNNER_REAR]);
}

static void fill_contacts(runner_instant *out, const runner *r, const mjData *d) {
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    runner_disc disc;
    runner_find_disc(&disc, r, d, i);
    if (i == RUNNER_REAR) out->x = disc.point[0], out->y = disc.point[1];
    out->slip[i] = hypot(disc.velocity[0], disc.velocity[1]);
    out->height[i] = disc.height;
    out->height_rate[i] = disc.velocity[2];
  }
}

// What was asked for, where the measured value is that but for rounding. A NAN was not asked for.
static void settle(double *is, double asked) {
  if (fabs(*is - asked) <= RUNNER_START_TOLERANCE * fmax(1, fabs(asked))) *is = asked;
}

void runner_settle_start(runner_instant *at, const runner *r) {
  settle(&at->x, 0);
  settle(&at->y, 0);
  settle(&at->yaw, 0);
  settle(&at->lean, r->asked.lean);
  settle(&at->steer, r->asked.steer);
  settle(&at->lean_rate, r->asked.lean_rate);
  settle(&at->steer_rate, r->asked.steer_rate);
  settle(&at->speed, r->asked.speed);
}

typedef struct measuring {
  runner *r;
  double force[RUNNER_WHEELS][3];
  roll_error code;
} measuring;

// All that asks MuJoCo: whatever it has to say then is ours to say.
static void measure(void *argument) {
  measuring *m = (measuring *)argument;
  runner *r = m->r;
  mj_forward(r->model, r->probe);
  if (r->map.foreign) mj_rnePostConstraint(r->model, r->probe);
  m->code = sum_forces(m->force, r);
}

runner_status runner_measure_probe(runner_instant *out, runner *r, mjcf_error *error) {
  guard_report report;
  r->stages = 0;
  r->refused = RUNNER_OK;
  measuring m = {.r = r};
  runner *before = runner_activate(r);
  guard_call(&report, measure, &m);
  runner_activate(before);
  runner_status status = runner_check(r, r->probe, &report, 1, error);
  if (status != RUNNER_OK) return status;

  if (m.code != ROLL_OK) {
    if (runner_discs_roll(r->discs, r->disc_count, r->probe->time, error)) // then it is a drive
      mjcf_fail(error, "%s", roll_error_string(m.code));
    return RUNNER_INVALID_WARNING;
  }
  *out = (runner_instant){.potential = r->probe->energy[0],
                          .kinetic = r->probe->energy[1],
                          .power = runner_probe_power(r)};
  fill_motion(out, r, r->probe);
  fill_contacts(out, r, r->probe);
  for (int i = 0; i < RUNNER_WHEELS; i++) turn_into_heading(out->force[i], m.force[i], out->yaw);
  return RUNNER_OK;
}

bool runner_at_stop(const runner *r) {
  for (int i = 0; i < r->probe->nefc; i++) {
    int type = r->probe->efc_type[i];
    if (type == mjCNSTR_LIMIT_JOINT || type == mjCNSTR_LIMIT_TENDON) return true;
  }
  return false;
}
