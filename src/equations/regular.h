// SPDX-License-Identifier: Apache-2.0
// Whether the equations determine the yaw rate and the accelerations at an instant.
#ifndef BICYCLE_EQUATIONS_REGULAR_H
#define BICYCLE_EQUATIONS_REGULAR_H

#include <float.h>

#include "equations/number_double.h"

// Where the steering axis' point on the ground lies as far before the rear contact as behind the
// front one, seen along the front wheel, the yaw rate (13) is not determined.
static inline bool yaw_determined(const position *g, const bike_model *model) {
  return fabs(g->D) > 64 * DBL_EPSILON * model->reach;
}

static inline bool regular(const kane *k) {
  // the pivots are those of a positive definite matrix; relative to the diagonal entry a pivot
  // below this is lost in the rounding of the entries (some tens of operations each)
  const double smallest = 64 * DBL_EPSILON;
  return k->pivot[0] > 0 && k->pivot[1] > smallest * k->M[1] && k->pivot[2] > smallest * k->M[0];
}

#endif
