// SPDX-License-Identifier: Apache-2.0
// Explicit Runge-Kutta methods as tables, and one step of any of them.
#ifndef BICYCLE_MOTION_RIDE_TABLE_H
#define BICYCLE_MOTION_RIDE_TABLE_H

#include "motion/ride_flow.h"

enum { RIDE_MAX_STAGES = 13 };

typedef struct ride_table {
  int stages, order;
  int embedded_order; // 0: the method has no error estimate
  double A[RIDE_MAX_STAGES][RIDE_MAX_STAGES];
  double b[RIDE_MAX_STAGES]; // the step
  double d[RIDE_MAX_STAGES]; // the embedded step of lower order
  double c[RIDE_MAX_STAGES];
} ride_table;

extern const ride_table RIDE_TABLE_8; // Prince and Dormand's RK8(7)13M
extern const ride_table RIDE_TABLE_4; // the classical Runge-Kutta method

// Adaptive steps that get no further than this time, s, are given up.
enum { RIDE_STALL_STEPS = 20000 };
#define RIDE_STALL_TIME 0.02

// One step from `from` to time `t`. `error` receives the difference to the embedded step and may be
// NULL. Returns as ride_rates; `out` is undefined then.
int ride_table_step(ride_point *out, double error[RIDE_SIZE], const ride_table *table,
                    const ride_point *from, double t, ride_flow *flow);

#endif
