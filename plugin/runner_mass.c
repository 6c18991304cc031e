// SPDX-License-Identifier: Apache-2.0
// The mass matrix that is left of MuJoCo's where both wheels roll.
#include "runner_guard.h"
#include "runner_internal.h"

#include <stdlib.h>

enum { SPEEDS = 3 };

typedef struct projection {
  runner *r;
  double *velocity; // SPEEDS rows of nv: qvel of one unit of each speed
  double *momentum; // nv
  double *out;      // SPEEDS x SPEEDS
} projection;

// V^T M V at the positions of the probe.
static void project(void *argument) {
  projection *p = (projection *)argument;
  const mjModel *m = p->r->model;
  mj_crb(m, p->r->probe);
  for (int j = 0; j < SPEEDS; j++) {
    mj_mulM(m, p->r->probe, p->momentum, p->velocity + j * m->nv);
    for (int i = 0; i < SPEEDS; i++)
      p->out[SPEEDS * i + j] = mju_dot(p->velocity + i * m->nv, p->momentum, m->nv);
  }
}

// A start's positions do not depend on its rates, and its rates are linear in the three speeds.
static runner_status find_velocities(const projection *p, const bike_state *state,
                                     mjcf_error *error) {
  int nv = p->r->model->nv;
  for (int i = 0; i < SPEEDS; i++) {
    bike_state unit = {.lean = state->lean,
                       .steer = state->steer,
                       .lean_rate = i == 0,
                       .steer_rate = i == 1,
                       .speed = i == 2};
    runner_status status = runner_place(p->r, p->r->probe, &unit, error);
    if (status != RUNNER_OK) return status;
    mju_copy(p->velocity + i * nv, p->r->probe->qvel, nv);
  }
  return RUNNER_OK;
}

runner_status runner_mass_matrix(double out[9], runner *r, const bike_state *state,
                                 mjcf_error *error) {
  size_t nv = (size_t)r->model->nv;
  double *room = calloc((SPEEDS + 1) * nv, sizeof *room);
  if (!room) return RUNNER_MEMORY;
  projection p = {r, room, room + SPEEDS * nv, out};
  runner_status status = find_velocities(&p, state, error);
  guard_report report = {0};
  if (status == RUNNER_OK) guard_call(&report, project, &p);
  free(room);
  if (!report.failed) return status;
  mjcf_fail(error, "%s", report.error);
  return RUNNER_INVALID_ERROR;
}
