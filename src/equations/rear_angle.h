// SPDX-License-Identifier: Apache-2.0
// Equation (4) where the kernel's fixed Newton steps from upright do not reach its root.
#ifndef BICYCLE_EQUATIONS_REAR_ANGLE_H
#define BICYCLE_EQUATIONS_REAR_ANGLE_H

#include "equations/number_double.h"

// Whether a position solves (4) to rounding, on the branch that upright riding belongs to.
static inline bool rear_angle_found(root_checks g, const bike_model *model) {
  // four roundings of the terms of (4) together; over 3000 random bicycles, small wheels and long
  // frames among them, a converged root left at most two
  const double tolerance = 4 * 2.220446049250313e-16;
  // a wheel that lies flat has no contact point, a level axis none with the ground; within a
  // nanoradian of it (4) is nothing but rounding
  const double flat = 1e-9;
  return fabs(g.residual) <= tolerance * model->reach && g.Q > 0 && g.c_br > flat &&
         g.c_kap > flat && g.c_psi > flat;
}

// Of 1.5 million random postures with a root, on bicycles of any shape, the slowest took 475.
enum { REAR_ANGLE_MOST_STEPS = 500 };

// Follows the root from upright to (phi, kappa) along a straight line. BIKE_ERROR_GEOMETRY where
// it ends: (4) has no root there, or a double one.
int rear_angle_continued(start *out, const bike_model *model, double phi, double kappa);

#endif
