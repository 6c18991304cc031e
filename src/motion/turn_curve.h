// SPDX-License-Identifier: Apache-2.0
// A curve of stationary motions, at a fixed speed or a fixed rider offset, in coordinates in which
// it is smooth everywhere, straight riding included:
//   y = (lean, steer, z),  z = rider offset at a fixed speed, z = v^2 sin(steer)/g at a fixed
//   offset
#ifndef BICYCLE_MOTION_TURN_CURVE_H
#define BICYCLE_MOTION_TURN_CURVE_H

#include "motion/turn_forces.h"
#include "motion/turn_newton.h"

#include <bicycle/turn.h>

enum { Y_LEAN, Y_STEER, Y_LAST, Y_SIZE };

typedef struct turn_curve {
  const turn_bicycle *bicycle;
  const bike_turn_def *def; // limits
  bool at_speed;            // fixed speed, else fixed rider offset
  double square, offset;    // v^2, w: the one that is fixed
} turn_curve;

// A place on it, or near it.
typedef struct turn_point {
  double y[Y_SIZE];
  double along[Y_SIZE]; // unit tangent
} turn_point;

// The curve of what is given: of the speed if `at_speed`, else of the rider offset (0 if not
// given).
turn_curve turn_curve_of(const turn_bicycle *bicycle, const bike_turn_def *def, bool at_speed);

// Residuals, rad/s^2, and their derivatives (may be NULL) for y. A geometry error, or 0.
int turn_curve_equations(double f[TURN_ROWS], double J[TURN_ROWS][Y_SIZE], const turn_curve *curve,
                         const double y[Y_SIZE]);

// Moves y onto the curve within the plane through `from` + `distance` * along; improves it from
// where it is. The tangent found points along `from`'s. BIKE_ERROR_NO_CONVERGENCE, a geometry
// error, or 0.
int turn_curve_correct(turn_point *out, double *residual, const turn_curve *curve, newton *solver,
                       const turn_point *from, double distance);

// The same between two points of the branch, near which it is known to be: more may be left, as
// what is found is improved and judged again.
int turn_curve_correct_between(turn_point *out, double *residual, const turn_curve *curve,
                               newton *solver, const turn_point *from, double distance);

// The unit tangent at y, with a positive product with `direction`.
int turn_curve_tangent(double along[Y_SIZE], const turn_curve *curve, const double y[Y_SIZE],
                       const double direction[Y_SIZE]);

// Whether one of the equations is nothing but rounding at y, as the steer's is where nothing turns
// it: solutions there are no curve. False also where the geometry ends.
bool turn_curve_degenerate(const turn_curve *curve, const double y[Y_SIZE]);

// v^2 (negative where no speed would do, not finite at zero steer) and the rider's offset.
double turn_curve_square(const turn_curve *curve, const double y[Y_SIZE]);
double turn_curve_offset(const turn_curve *curve, const double y[Y_SIZE]);

// A function whose zeros along the curve are where a variable has the value, and one whose zeros
// are where it is largest or smallest.
double turn_curve_beyond(const turn_curve *curve, const turn_point *at, bike_turn_variable variable,
                         double value);
double turn_curve_slope(const turn_curve *curve, const turn_point *at, bike_turn_variable variable);

// How fast the first of them grows along the curve.
double turn_curve_growth(const turn_curve *curve, const turn_point *at, bike_turn_variable variable,
                         double value);

// Whether lean and steer lie within the limits.
bool turn_curve_within(const turn_curve *curve, const double y[Y_SIZE]);

#endif
