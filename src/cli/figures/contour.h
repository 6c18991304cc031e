// SPDX-License-Identifier: Apache-2.0
// Contours of a function on a grid with holes, by marching squares.
#ifndef BICYCLE_CLI_FIGURES_CONTOUR_H
#define BICYCLE_CLI_FIGURES_CONTOUR_H

#include "plot.h"

// Values at x[0] < ... < x[nx - 1], y likewise: value[j * nx + i] at (x[i], y[j]); NaN is a hole.
typedef struct contour_grid {
  int nx, ny;
  const double *x, *y, *value;
  const bool *torn; // like value, may be NULL: the cell up and right of the node is left out
} contour_grid;

// Called for each connected piece of the contour; the points are the callee's to read.
typedef void contour_piece(const plot_point *points, int count, void *user);

// Between grid points the function is taken as linear along the grid's lines. False when out of
// memory.
bool contour_trace(const contour_grid *grid, double level, contour_piece *piece, void *user);

// Called for each polygon (3 to 6 corners) of the region where the function is below the level;
// together they cover it.
void contour_below(const contour_grid *grid, double level, contour_piece *piece, void *user);

#endif
