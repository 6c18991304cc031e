// SPDX-License-Identifier: Apache-2.0
// Starts of models that others have made: any root, any axes. The same conditions as in
// runner_start.c, solved with Newton's method in the model's own coordinates.
#include "runner_guard.h"
#include "runner_internal.h"

#include <math.h>

enum { ROOT = 6, ALL = 9 };

static void refresh(const runner *r, mjData *d) {
  mj_kinematics(r->model, d);
  mj_comPos(r->model, d);
  mj_comVel(r->model, d);
}

// The freedoms of the root: all but steer and wheels.
static void find_root_dofs(int out[ROOT], const runner *r) {
  const runner_map *map = &r->map;
  int count = 0;
  for (int i = 0; i < r->model->nv && count < ROOT; i++)
    if (i != map->steer.dof && i != map->wheel[0].hinge.dof && i != map->wheel[1].hinge.dof)
      out[count++] = i;
}

// Place of the rear contact, heights of both discs, yaw, lean.
static void find_place(double out[ROOT], const runner *r, const mjData *d) {
  runner_disc disc[RUNNER_WHEELS];
  runner_posture p;
  for (int i = 0; i < RUNNER_WHEELS; i++) runner_find_disc(&disc[i], r, d, i);
  runner_read_posture(&p, r, d);
  out[0] = disc[0].point[0], out[1] = disc[0].point[1];
  out[2] = disc[0].height, out[3] = disc[1].height;
  out[4] = p.angle[0], out[5] = p.angle[1];
}

// And their rates; of the contact those of the wheel's material, which differ from them by what the
// other conditions make zero: Newton's method needs no more.
static void find_place_rates(double out[ROOT], const runner *r, const mjData *d) {
  runner_disc disc[RUNNER_WHEELS];
  runner_posture p;
  for (int i = 0; i < RUNNER_WHEELS; i++) runner_find_disc(&disc[i], r, d, i);
  runner_read_posture(&p, r, d);
  out[0] = disc[0].velocity[0], out[1] = disc[0].velocity[1];
  out[2] = disc[0].velocity[2], out[3] = disc[1].velocity[2];
  out[4] = p.rate[0], out[5] = p.rate[1];
}

// One step towards a lean; false where the conditions do not determine it.
static bool step_towards(double *off, const runner *r, mjData *d, const int dof[ROOT],
                         double lean) {
  double A[ROOT * ROOT], b[ROOT], change[ALL] = {0};
  find_place(b, r, d);
  b[5] -= lean;
  *off = 0;
  for (int i = 0; i < ROOT; i++) *off = fmax(*off, fabs(b[i]));
  for (int k = 0; k < ROOT; k++) {
    double column[ROOT];
    mju_zero(d->qvel, r->model->nv);
    d->qvel[dof[k]] = 1;
    mj_comVel(r->model, d);
    find_place_rates(column, r, d);
    for (int i = 0; i < ROOT; i++) A[ROOT * i + k] = column[i];
  }
  if (!runner_solve(ROOT, A, b)) return false;
  for (int k = 0; k < ROOT; k++) change[dof[k]] = -b[k];
  mj_integratePos(r->model, d->qpos, change, 1);
  refresh(r, d);
  return true;
}

// Newton's method in stages of at most 0.2 rad of lean and steer from upright: each is close to the
// one before, and the posture at qpos 0 need not be.
static bool find_position(const runner *r, mjData *d, const bike_state *state) {
  enum { ITERATIONS = 30 };
  const runner_hinge *steer = &r->map.steer;
  int dof[ROOT];
  int stages = 1 + (int)ceil(fmax(fabs(state->lean), fabs(state->steer)) / 0.2);
  double off = INFINITY;
  find_root_dofs(dof, r);
  refresh(r, d);
  for (int s = 1; s <= stages; s++) {
    double share = (double)s / stages;
    d->qpos[steer->qpos] = steer->zero + steer->sign * share * state->steer;
    refresh(r, d);
    // To rounding, and twice more: it costs nothing.
    int extra = 2;
    for (int i = 0; i < ITERATIONS && extra > 0; i++) {
      if (!step_towards(&off, r, d, dof, share * state->lean)) return false;
      extra -= off <= RUNNER_START_TOLERANCE;
    }
  }
  return off <= RUNNER_START_TOLERANCE;
}

// Velocities of the two contacts, speed, lean rate, steer rate: linear in the nine rates.
static void find_rates(double out[ALL], const runner *r, mjData *d) {
  runner_posture p;
  mj_comVel(r->model, d);
  runner_read_posture(&p, r, d);
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    runner_disc disc;
    runner_find_disc(&disc, r, d, i);
    mju_copy3(out + 3 * i, disc.velocity);
  }
  const runner_wheel *rear = &r->map.wheel[RUNNER_REAR];
  out[6] = rear->radius * (p.rate[2] + rear->hinge.sign * d->qvel[rear->hinge.dof]);
  out[7] = p.rate[1];
  out[8] = r->map.steer.sign * d->qvel[r->map.steer.dof];
}

static bool find_velocity(const runner *r, mjData *d, const bike_state *state) {
  double A[ALL * ALL], column[ALL];
  double b[ALL] = {0, 0, 0, 0, 0, 0, state->speed, state->lean_rate, state->steer_rate};
  for (int k = 0; k < ALL; k++) {
    mju_zero(d->qvel, ALL);
    d->qvel[k] = 1;
    find_rates(column, r, d);
    for (int i = 0; i < ALL; i++) A[ALL * i + k] = column[i];
  }
  if (!runner_solve(ALL, A, b)) return false;
  mju_copy(d->qvel, b, ALL);
  mj_comVel(r->model, d);
  return true;
}

bool runner_place_foreign(const runner *r, mjData *d, const bike_state *state) {
  mj_resetData(r->model, d);
  return find_position(r, d, state) && find_velocity(r, d, state) &&
         runner_residual(r, d) <= RUNNER_START_TOLERANCE;
}
