// SPDX-License-Identifier: Apache-2.0
// The classical Runge-Kutta method with a fixed step: for studies of convergence, and as the twin
// of MuJoCo's integrator of the same name.
#include "motion/ride_method.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

typedef struct rk4 {
  double step; // s
  ride_flow *flow;
} rk4;

static int rk4_create(void **out, const bike_ride_def *def, const ride_point *start,
                      ride_flow *flow) {
  (void)start;
  rk4 *r = malloc(sizeof *r);
  if (!r) return BIKE_ERROR_MEMORY;
  *r = (rk4){def->step, flow};
  *out = r;
  return BIKE_OK;
}

static int rk4_restart(void *self, const ride_point *from) {
  (void)self, (void)from;
  return 0;
}

// A step that would leave less than 1e-6 of itself before the limit goes there: that is rounding of
// the times, and the steps divide the sample interval.
static int rk4_step(void *self, ride_point *at, double limit) {
  const rk4 *r = self;
  double t = limit - at->t > r->step * (1 + 1e-6) ? at->t + r->step : limit;
  ride_point from = *at;
  return ride_table_step(at, NULL, &RIDE_TABLE_4, &from, t, r->flow);
}

const ride_method RIDE_METHOD_RK4 = {.table = &RIDE_TABLE_4,
                                     .create = rk4_create,
                                     .free = free,
                                     .restart = rk4_restart,
                                     .step = rk4_step};
