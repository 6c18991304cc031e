// SPDX-License-Identifier: Apache-2.0
// A curve of a plot in pixels, walked along by its length.
#ifndef BICYCLE_CLI_FIGURES_TRACK_H
#define BICYCLE_CLI_FIGURES_TRACK_H

#include "plot.h"

typedef struct track {
  int count;
  draw_point *at;
  double *length; // up to each point
} track;

// At least two points. False when out of memory; free it in any case.
bool track_make(track *out, const plot *p, const plot_point *points, int count);
void track_free(track *t);

double track_total(const track *t);

// The point at a length; beyond the ends, on the straight continuation of the curve.
draw_point track_point(const track *t, double length);

// The part of the curve, 0 to 1, that is nearer than `distance` to a line already in the plot.
double track_crowded_part(const track *t, const draw_obstacles *obstacles, double distance);

#endif
