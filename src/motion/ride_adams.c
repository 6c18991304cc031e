// SPDX-License-Identifier: Apache-2.0
// CVODE's Adams-Moulton method of variable order, with fixed-point iteration: no Jacobian.
//
// Its samples come from its own polynomial, which has the order of the step; made to stop at each
// sample instead it takes up to twice the evaluations for the same error or a larger one.
#include "motion/ride_method.h"
#include "motion/ride_sundials.h"

#include <bicycle/error.h>
#include <cvode/cvode.h>
#include <stdlib.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

typedef struct adams {
  ride_sundials sun;
  void *memory;
  SUNNonlinearSolver solver;
} adams;

static void adams_free(void *self) {
  adams *a = self;
  if (a->memory) CVodeFree(&a->memory);
  if (a->solver) SUNNonlinSolFree(a->solver);
  ride_sundials_close(&a->sun);
  free(a);
}

static int set_up(adams *a, const ride_point *start) {
  a->solver = SUNNonlinSol_FixedPoint(a->sun.y, 0, a->sun.context);
  void *m = a->solver ? CVodeCreate(CV_ADAMS, a->sun.context) : NULL;
  if (!m) return BIKE_ERROR_MEMORY;
  // After a CVodeInit that ran out of memory, CVodeFree frees vectors twice (SUNDIALS 6.4): what
  // little it holds is lost.
  if (CVodeSetErrHandlerFn(m, ride_sundials_quiet, NULL) ||
      CVodeInit(m, ride_sundials_rates, start->t, a->sun.y))
    return BIKE_ERROR_MEMORY;
  a->memory = m;
  bool failed = CVodeSetUserData(m, &a->sun) || CVodeWFtolerances(m, ride_sundials_weights) ||
                CVodeSetNonlinearSolver(m, a->solver) || CVodeSetMaxNumSteps(m, -1);
  return failed || vector_ran_out(a->sun.y) ? BIKE_ERROR_MEMORY : BIKE_OK;
}

static int adams_create(void **out, const bike_ride_def *def, const ride_point *start,
                        ride_flow *flow) {
  adams *a = calloc(1, sizeof *a);
  if (!a) return BIKE_ERROR_MEMORY;
  int code = ride_sundials_open(&a->sun, def, start, flow);
  if (!code) code = set_up(a, start);
  if (code)
    adams_free(a);
  else
    *out = a;
  return code;
}

static int adams_restart(void *self, const ride_point *from) {
  adams *a = self;
  ride_sundials_put(&a->sun, from);
  return ride_sundials_code(&a->sun, CVodeReInit(a->memory, from->t, a->sun.y));
}

static int adams_step(void *self, ride_point *at, double limit) {
  adams *a = self;
  double t;
  int code = CVodeSetStopTime(a->memory, limit);
  if (!code) code = CVode(a->memory, limit, a->sun.y, &t, CV_ONE_STEP);
  if (code >= 0) ride_sundials_get(at, &a->sun, t);
  return ride_sundials_code(&a->sun, code);
}

static int adams_inside(ride_point *out, void *self, double t) {
  adams *a = self;
  int code = CVodeGetDky(a->memory, t, 0, a->sun.y);
  ride_sundials_get(out, &a->sun, t);
  return code;
}

const ride_method RIDE_METHOD_ADAMS = {.adaptive = true,
                                       .create = adams_create,
                                       .free = adams_free,
                                       .restart = adams_restart,
                                       .step = adams_step,
                                       .inside = adams_inside};
