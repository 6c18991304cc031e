// SPDX-License-Identifier: Apache-2.0
// The contours of one panel: lines with labels, thinned out where they would run into each other.
#ifndef BICYCLE_CLI_FIGURES_LEVEL_LINES_H
#define BICYCLE_CLI_FIGURES_LEVEL_LINES_H

#include "contour.h"

typedef struct level_set {
  const double *levels; // rising, > 0
  int count;
  bool both;    // the levels with the opposite sign too
  bool zero;    // a heavy contour zero
  bool upright; // contours reach the lowest y when it is zero: else they would be drawn on the axis
  bool inverse; // levels are labelled with L and drawn where the quantity is 1/L
} level_set;

// Of lines that stay nearer to each other than print can tell over more than half of their length,
// that of the least level is kept; and a level whose lines have no room for a label is not drawn.
// *left_out: whether any was not. False when out of memory.
bool level_lines_draw(plot *p, const level_set *set, const contour_grid *grid, bool *left_out);

#endif
