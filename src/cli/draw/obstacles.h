// SPDX-License-Identifier: Apache-2.0
// What already stands in a drawing, so that a label can be put where there is room.
#ifndef BICYCLE_CLI_DRAW_OBSTACLES_H
#define BICYCLE_CLI_DRAW_OBSTACLES_H

#include <stdbool.h>
#include <stddef.h>

// Pixels; x to the right, y DOWN as in SVG.
typedef struct draw_point {
  double x, y;
} draw_point;

typedef struct draw_box {
  draw_point low, high;
} draw_box;

typedef struct draw_segment {
  draw_point a, b;
} draw_segment;

typedef struct draw_obstacles {
  draw_box *boxes;
  size_t box_count, box_room;
  draw_segment *segments;
  size_t segment_count, segment_room;
  bool lost; // out of memory
} draw_obstacles;

void draw_obstacles_free(draw_obstacles *obstacles);

void draw_add_box(draw_obstacles *obstacles, draw_box box);
void draw_add_segment(draw_obstacles *obstacles, draw_point a, draw_point b);

enum { DRAW_CROSSED_PIXEL_COST = 4 }; // of each pixel of a line within a box

// How badly a box would sit: the lines that cross it count, and, much more, covered boxes.
double draw_box_cost(const draw_obstacles *obstacles, draw_box box);

// Whether a line passes a point at less than a distance.
bool draw_is_near_line(const draw_obstacles *obstacles, draw_point at, double distance);

draw_point draw_along(draw_point from, draw_point direction, double distance);
double draw_distance(draw_point a, draw_point b);

// Unit vector from a to b; a != b.
draw_point draw_direction(draw_point a, draw_point b);

#endif
