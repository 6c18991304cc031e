// SPDX-License-Identifier: Apache-2.0
// What both SUNDIALS integrators share.
#ifndef BICYCLE_MOTION_RIDE_SUNDIALS_H
#define BICYCLE_MOTION_RIDE_SUNDIALS_H

#include "motion/ride_flow.h"
#include "motion/vector.h"

typedef struct ride_sundials {
  SUNContext context;
  N_Vector y; // over `data`
  double data[RIDE_SIZE];
  ride_flow *flow;
  double rtol, atol;
} ride_sundials;

// 0 or BIKE_ERROR_MEMORY; to be closed in either case.
int ride_sundials_open(ride_sundials *out, const bike_ride_def *def, const ride_point *start,
                       ride_flow *flow);
void ride_sundials_close(ride_sundials *s);

void ride_sundials_put(ride_sundials *s, const ride_point *from);
void ride_sundials_get(ride_point *out, const ride_sundials *s, double t);

// What a call of SUNDIALS means: 0, or BIKE_ERROR_MEMORY, or its own negative code. A vector that
// could not be had is a call that failed.
int ride_sundials_code(const ride_sundials *s, int code);

// SUNDIALS' right-hand side; user data is a ride_sundials, here and below. Positive: try a shorter
// step; negative: give up.
int ride_sundials_rates(realtype t, N_Vector y, N_Vector dy, void *user);

// 1 / (rtol |y| + atol): SUNDIALS' own in one pass instead of five.
int ride_sundials_weights(N_Vector y, N_Vector weights, void *user);

// An error handler: the library never prints, and return values say what went wrong.
void ride_sundials_quiet(int code, const char *module, const char *function, char *text,
                         void *user);

#endif
