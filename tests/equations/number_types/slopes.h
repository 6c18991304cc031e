// SPDX-License-Identifier: Apache-2.0
// Two other ways to the derivatives of a Jacobian, one direction at a time.
#ifndef BICYCLE_TESTS_SLOPES_H
#define BICYCLE_TESTS_SLOPES_H

#include "equations/tangent/jacobian.h"

// What is differentiated, after the accelerations in the order of OF_STEER ...
enum {
  OF_ENERGY = JACOBIAN_ACCELERATIONS,
  OF_REAR_ANGLE, // sin beta_r
  OF_REAR_FORCE, // three components
  SLOPE_RESULTS = OF_REAR_FORCE + 3
};

typedef struct slope_result {
  double value[SLOPE_RESULTS], slope[SLOPE_RESULTS];
} slope_result;

// By complex step from the root beta_r, at the argument AT_... `which` of one point.
void slope_by_step(slope_result *out, const bike_model *model, const double at[JACOBIAN_ARGUMENTS],
                   double beta_r, int which);

// By tangents with one slope, whose direction only the running program knows.
enum { TANGENT_POINTS = 4 };
void slopes_by_tangent(slope_result out[TANGENT_POINTS], const bike_model *model,
                       const jacobian_points *points, int which);

#endif
