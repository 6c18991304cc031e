// SPDX-License-Identifier: Apache-2.0
// Whether the equations hold at an instant.
#ifndef BICYCLE_EQUATIONS_REGULAR_H
#define BICYCLE_EQUATIONS_REGULAR_H

#include <bicycle/error.h>
#include <float.h>

#include "equations/rear_angle.h"

// Where the steering axis' point on the ground lies as far before the rear contact as behind the
// front one, seen along the front wheel, the yaw rate (13) is not determined.
static inline bool yaw_determined(const checks *c, const bike_model *model) {
  return fabs(c->D) > 64 * DBL_EPSILON * model->reach;
}

static inline bool regular(const checks *c) {
  // the pivots are those of a positive definite matrix; relative to the diagonal entry a pivot
  // below this is lost in the rounding of the entries (some tens of operations each)
  const double smallest = 64 * DBL_EPSILON;
  return c->pivot_v > 0 && c->pivot_kap > smallest * c->diagonal_kap &&
         c->pivot_phi > smallest * c->diagonal_phi;
}

// BIKE_OK, BIKE_ERROR_GEOMETRY where Newton's method has not found beta_r, or BIKE_ERROR_SINGULAR.
static inline int judged(const checks *c, const bike_model *model) {
  if (!rear_angle_found(c->root, model)) return BIKE_ERROR_GEOMETRY;
  return yaw_determined(c, model) && regular(c) ? BIKE_OK : BIKE_ERROR_SINGULAR;
}

#endif
