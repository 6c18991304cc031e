// SPDX-License-Identifier: Apache-2.0
// One branch of a curve, followed by pseudo-arclength continuation in both directions.
#ifndef BICYCLE_MOTION_TURN_BRANCH_H
#define BICYCLE_MOTION_TURN_BRANCH_H

#include "motion/turn_curve.h"

#include <stddef.h>

// Points in order, tangents pointing forward. A closed branch ends with its first point; an open
// one with the first point beyond the limits, or where the geometry ends.
typedef struct turn_branch {
  size_t count, room;
  turn_point *at;
} turn_branch;

// The point of the curve next to y, in the plane across the tangent there. NO_CONVERGENCE or a
// geometry error where there is none after all, or none where branches are followed.
int turn_branch_land(turn_point *out, double *residual, const turn_curve *curve, newton *solver,
                     const double y[Y_SIZE]);

// Follows the branch from a point. MEMORY, or 0. To be released in any case.
int turn_branch_trace(turn_branch *out, const turn_curve *curve, newton *solver,
                      const turn_point *start);
void turn_branch_free(turn_branch *branch);

// Whether the branch comes as close to y as its chords are to it.
bool turn_branch_covers(const turn_branch *branch, const double y[Y_SIZE]);

#endif
