// SPDX-License-Identifier: Apache-2.0
// Where branches are: all crossings of a curve with the lines of a grid over lean and steer.
#ifndef BICYCLE_MOTION_TURN_SEED_H
#define BICYCLE_MOTION_TURN_SEED_H

#include "motion/turn_curve.h"

#include <stddef.h>

typedef struct turn_seeds {
  size_t count, room;
  double (*y)[Y_SIZE]; // near the curve, to 1e-6 rad; the nearest to upright riding first
} turn_seeds;

// To be released also on error (MEMORY).
int turn_seeds_find(turn_seeds *out, const turn_curve *curve);
void turn_seeds_free(turn_seeds *seeds);

#endif
