// SPDX-License-Identifier: Apache-2.0
#include "motion/ride_creep.h"

#include <math.h>

// The edge is wanted to 1e-9 s; shorter steps than this move nothing by more than 1e-10.
static const double SHORTEST = 1e-11; // s

// Near the edge rates are large and the end of the ride is near: what the default tolerance of the
// integrators asks per step is asked here of each variable.
static const double TOLERANCE = 1e-13;

static bool accurate(const ride_point *at, const double error[RIDE_SIZE]) {
  for (int i = 0; i < RIDE_SIZE; i++)
    if (!(fabs(error[i]) <= TOLERANCE * (1 + fabs(at->y[i])))) return false;
  return true;
}

ride_creep_end ride_creep(ride_point *at, bike_snapshot *view, double limit, ride_flow *flow) {
  bool outside = false;
  for (double h = limit - at->t; h >= SHORTEST; h /= 2) {
    ride_point next;
    double error[RIDE_SIZE];
    int failed = ride_table_step(&next, error, &RIDE_TABLE_8, at, at->t + h, flow);
    if (!failed) failed = ride_look(view, &next, flow);
    if (failed > 1) return RIDE_CREEP_FATAL;
    outside = failed;
    if (failed || !accurate(&next, error)) continue;
    *at = next;
    return RIDE_CREEP_STEPPED;
  }
  return outside ? RIDE_CREEP_EDGE : RIDE_CREEP_STUCK;
}
