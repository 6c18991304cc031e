// SPDX-License-Identifier: Apache-2.0
// ARKODE's explicit Runge-Kutta stepper with the table of order 8.
//
// ARKStep, not ERKStep: the latter takes any table whose last stage is at the step's end for one
// whose last stage is the next step's first (SUNDIALS issue 311), which is wrong for this one.
// ARKStep costs the 13 evaluations a step that the method asks for.
#include "motion/ride_method.h"
#include "motion/ride_sundials.h"

#include <arkode/arkode_arkstep.h>
#include <bicycle/error.h>
#include <stdlib.h>

typedef struct rk8 {
  ride_sundials sun;
  void *memory;
} rk8;

static void rk8_free(void *self) {
  rk8 *r = self;
  if (r->memory) ARKStepFree(&r->memory);
  ride_sundials_close(&r->sun);
  free(r);
}

static ARKodeButcherTable butcher_table(const ride_table *t) {
  double A[RIDE_MAX_STAGES * RIDE_MAX_STAGES];
  double b[RIDE_MAX_STAGES], d[RIDE_MAX_STAGES], c[RIDE_MAX_STAGES];
  for (int i = 0; i < t->stages; i++) {
    for (int j = 0; j < t->stages; j++) A[i * t->stages + j] = t->A[i][j];
    b[i] = t->b[i];
    d[i] = t->d[i];
    c[i] = t->c[i];
  }
  return ARKodeButcherTable_Create(t->stages, t->order, t->embedded_order, c, A, b, d);
}

static int set_up(rk8 *r) {
  ARKodeButcherTable table = butcher_table(&RIDE_TABLE_8);
  if (!table) return BIKE_ERROR_MEMORY;
  void *m = r->memory;
  // The interpolant is asked only at a step's end, up to rounding: with degree 1 it costs no
  // evaluation, with the default degree three at each stop.
  bool failed = ARKStepSetErrHandlerFn(m, ride_sundials_quiet, NULL) ||
                ARKStepSetUserData(m, &r->sun) ||
                ARKStepSetTables(m, RIDE_TABLE_8.order, RIDE_TABLE_8.embedded_order, NULL, table) ||
                ARKStepSetInterpolantDegree(m, 1) ||
                ARKStepWFtolerances(m, ride_sundials_weights) || ARKStepSetMaxNumSteps(m, -1);
  ARKodeButcherTable_Free(table);
  return failed || vector_ran_out(r->sun.y) ? BIKE_ERROR_MEMORY : BIKE_OK;
}

static int rk8_create(void **out, const bike_ride_def *def, const ride_point *start,
                      ride_flow *flow) {
  rk8 *r = calloc(1, sizeof *r);
  if (!r) return BIKE_ERROR_MEMORY;
  int code = ride_sundials_open(&r->sun, def, start, flow);
  if (!code) {
    r->memory = ARKStepCreate(ride_sundials_rates, NULL, start->t, r->sun.y, r->sun.context);
    code = r->memory ? set_up(r) : BIKE_ERROR_MEMORY;
  }
  if (code)
    rk8_free(r);
  else
    *out = r;
  return code;
}

static int rk8_restart(void *self, const ride_point *from) {
  rk8 *r = self;
  ride_sundials_put(&r->sun, from);
  return ride_sundials_code(&r->sun, ARKStepReset(r->memory, from->t, r->sun.y));
}

static int rk8_step(void *self, ride_point *at, double limit) {
  rk8 *r = self;
  double t;
  int code = ARKStepSetStopTime(r->memory, limit);
  if (!code) code = ARKStepEvolve(r->memory, limit, r->sun.y, &t, ARK_ONE_STEP);
  if (code >= 0) ride_sundials_get(at, &r->sun, t);
  return ride_sundials_code(&r->sun, code);
}

const ride_method RIDE_METHOD_RK8 = {.adaptive = true,
                                     .table = &RIDE_TABLE_8,
                                     .create = rk8_create,
                                     .free = rk8_free,
                                     .restart = rk8_restart,
                                     .step = rk8_step};
