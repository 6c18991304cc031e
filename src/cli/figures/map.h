// SPDX-License-Identifier: Apache-2.0
// Stationary motion over a grid of speed and lean: what figure 2 shows.
#ifndef BICYCLE_CLI_FIGURES_MAP_H
#define BICYCLE_CLI_FIGURES_MAP_H

#include "terminal/number.h"
#include "terminal/progress.h"

#include <bicycle/model.h>

// Pictures need a finer grid than tables: eps_max has a crease, across which contours run along
// nodes like stairs.
//
// Arrays of nx speeds times ny leans, [j * nx + i] at (speed[i], lean[j]); NaN where there is no
// such motion.
typedef struct turn_map {
  int nx, ny;
  int stride;                         // every so many nodes is one of those asked for
  double *speed, *lean;               // m/s, rad
  double *steer, *rider_offset, *eps; // rad, m, 1/s
  bool *torn; // between this node and those right of and above it the motion jumps to another one
} turn_map;

// Errors: MEMORY, NO_RIDER, and whatever is wrong with the model. Free it in any case.
int turn_map_make(turn_map *out, const bike_model *model, const term_range *speeds,
                  const term_range *leans, int threads, term_progress *progress);
void turn_map_free(turn_map *map);

#endif
