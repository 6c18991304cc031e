// SPDX-License-Identifier: Apache-2.0
// Dimension lines as a drawing office draws them.
#ifndef BICYCLE_CLI_DRAW_DIMENSIONS_H
#define BICYCLE_CLI_DRAW_DIMENSIONS_H

#include "labels.h"

enum { DRAW_TILT_SIZE = 105 }; // pixels from the vertex of the angle to the end of its lines

// The distance of two points at right angles to `normal` (a unit vector), drawn on the line on
// which the points' coordinate along `normal` is `level`. `symbol` and `subscript` name it, `value`
// is its size in metres, with its sign.
void draw_dimension(draw_canvas *canvas, draw_labels *labels, draw_point a, draw_point b,
                    draw_point normal, double level, const char *symbol, const char *subscript,
                    double value);

// A radius: an arrow from the centre to the rim, in a direction.
void draw_radius(draw_canvas *canvas, draw_labels *labels, draw_point centre, draw_point direction,
                 double pixels, const char *subscript, double value);

// The angle beta at `vertex` between the vertical and the steering axis, whose upward direction is
// `axis`, of `value` radians.
void draw_tilt(draw_canvas *canvas, draw_labels *labels, draw_point vertex, draw_point axis,
               double value);

// Whether arrows and all fit between the ends of a dimension of this many pixels.
bool draw_is_wide(double length);

// A point's coordinate along a unit vector.
double draw_coordinate(draw_point point, draw_point direction);

#endif
