// SPDX-License-Identifier: Apache-2.0
// CVODE around mj_forward: an integrator of the same model that owes MuJoCo nothing, and has its
// full order with a free joint too.
//
// y = (qpos, qvel, work);  qpos' from qvel joint by joint, qvel' = qacc, work' = power. A right
// side is one mj_forward of the probe.
#include "runner_guard.h"
#include "runner_internal.h"

#include "motion/vector.h"

#include <cvode/cvode.h>
#include <stdlib.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

struct runner_cvode {
  runner *r;
  SUNContext context;
  N_Vector y;
  SUNNonlinearSolver solver;
  void *memory;
  // What the last right side that failed said.
  runner_status status;
  mjcf_error error;
};

// q' = q (0, w)/2, w in the axes of the body as MuJoCo has it (mju_derivQuat takes the world's).
static void find_turning(double rate[4], const double q[4], const double w[3]) {
  const double half[4] = {0, w[0] / 2, w[1] / 2, w[2] / 2};
  mju_mulQuat(rate, q, half);
}

// q' = v; but for the quaternion of a free joint or a ball.
static void find_position_rate(double *rate, const mjModel *m, const double *qpos,
                               const double *qvel) {
  for (int j = 0; j < m->njnt; j++) {
    int q = m->jnt_qposadr[j], v = m->jnt_dofadr[j];
    int type = m->jnt_type[j];
    if (type == mjJNT_FREE) {
      mju_copy3(rate + q, qvel + v);
      q += 3, v += 3;
    }
    if (type == mjJNT_FREE || type == mjJNT_BALL)
      find_turning(rate + q, qpos + q, qvel + v);
    else
      rate[q] = qvel[v];
  }
}

static void forward(void *argument) {
  runner *r = (runner *)argument;
  mj_forward(r->model, r->probe);
}

static int right_side(realtype time, N_Vector at, N_Vector out, void *user) {
  runner_cvode *c = (runner_cvode *)user;
  runner *r = c->r;
  const mjModel *m = r->model;
  const double *y = N_VGetArrayPointer(at);
  double *rate = N_VGetArrayPointer(out);
  guard_report report;
  r->probe->time = time;
  mju_copy(r->probe->qpos, y, m->nq);
  mju_copy(r->probe->qvel, y + m->nq, m->nv);
  // The quaternion of an integrated y is a unit only to the tolerance.
  mj_normalizeQuat(m, r->probe->qpos);
  r->stages = 0;
  r->refused = RUNNER_OK;
  guard_call(&report, forward, r);
  c->status = runner_check(r, r->probe, &report, 1, &c->error);
  if (c->status != RUNNER_OK) return -1;
  find_position_rate(rate, m, y, y + m->nq);
  mju_copy(rate + m->nq, r->probe->qacc, m->nv);
  rate[m->nq + m->nv] = runner_probe_power(r);
  return 0;
}

static bool begin(runner_cvode *c, double tolerance) {
  const mjModel *m = c->r->model;
  const mjData *d = c->r->ride;
  if (SUNContext_Create(NULL, &c->context) != 0) return false;
  c->y = vector_create(m->nq + m->nv + 1, c->context);
  if (!c->y) return false;
  double *y = N_VGetArrayPointer(c->y);
  mju_copy(y, d->qpos, m->nq);
  mju_copy(y + m->nq, d->qvel, m->nv);
  y[m->nq + m->nv] = 0;
  c->solver = SUNNonlinSol_FixedPoint(c->y, 0, c->context);
  void *memory = c->solver ? CVodeCreate(CV_ADAMS, c->context) : NULL;
  // After a CVodeInit that ran out of memory, CVodeFree frees vectors twice (SUNDIALS 6.4): what
  // little it holds is lost.
  if (!memory || CVodeInit(memory, right_side, 0, c->y) != CV_SUCCESS) return false;
  c->memory = memory;
  // Steps enough for a second of stiff contact between two rows.
  enum { MOST_STEPS = 1000000 };
  return CVodeSStolerances(c->memory, tolerance, tolerance) == CV_SUCCESS &&
         CVodeSetNonlinearSolver(c->memory, c->solver) == CV_SUCCESS &&
         CVodeSetUserData(c->memory, c) == CV_SUCCESS &&
         CVodeSetMaxNumSteps(c->memory, MOST_STEPS) == CV_SUCCESS &&
         // What it has to say comes back as a status.
         CVodeSetErrFile(c->memory, NULL) == CV_SUCCESS && !vector_ran_out(c->y);
}

runner_cvode *runner_cvode_create(runner *r, double tolerance) {
  runner_cvode *c = (runner_cvode *)calloc(1, sizeof *c);
  if (!c) return NULL;
  c->r = r;
  if (begin(c, tolerance)) return c;
  runner_cvode_free(c);
  return NULL;
}

void runner_cvode_free(runner_cvode *c) {
  if (!c) return;
  if (c->memory) CVodeFree(&c->memory);
  if (c->solver) SUNNonlinSolFree(c->solver);
  if (c->y) N_VDestroy(c->y);
  if (c->context) SUNContext_Free(&c->context);
  free(c);
}

runner_status runner_cvode_advance(runner_cvode *c, double time, mjcf_error *error) {
  runner *r = c->r;
  const mjModel *m = r->model;
  realtype reached;
  runner *before = runner_activate(r);
  int flag = CVode(c->memory, time, c->y, &reached, CV_NORMAL);
  runner_activate(before);
  if (flag == CV_MEM_FAIL || vector_ran_out(c->y)) {
    mjcf_fail(error, "%s", runner_status_string(RUNNER_MEMORY));
    return RUNNER_MEMORY;
  }
  if (flag < 0 && c->status != RUNNER_OK) {
    *error = c->error;
    return c->status;
  }
  if (flag < 0) {
    mjcf_fail(error, "%s: CVODE, %g s: error %d", runner_status_string(RUNNER_INVALID_INTEGRATOR),
              time, flag);
    return RUNNER_INVALID_INTEGRATOR;
  }
  const double *y = N_VGetArrayPointer(c->y);
  mju_copy(r->ride->qpos, y, m->nq);
  mju_copy(r->ride->qvel, y + m->nq, m->nv);
  mj_normalizeQuat(m, r->ride->qpos);
  r->ride->time = time;
  r->work = y[m->nq + m->nv];
  return RUNNER_OK;
}

long runner_cvode_steps(const runner_cvode *c) {
  long count = 0;
  CVodeGetNumSteps(c->memory, &count);
  return count;
}

long runner_cvode_evaluations(const runner_cvode *c) {
  long count = 0;
  CVodeGetNumRhsEvals(c->memory, &count);
  return count;
}
