// SPDX-License-Identifier: Apache-2.0
#include "obstacles.h"

#include <math.h>
#include <stdlib.h>

// A label may cross a line if it must, but never stand on another label.
static const double covered_box_cost = 1e4;

draw_point draw_along(draw_point from, draw_point direction, double distance) {
  return (draw_point){from.x + distance * direction.x, from.y + distance * direction.y};
}

double draw_distance(draw_point a, draw_point b) {
  return hypot(b.x - a.x, b.y - a.y);
}

draw_point draw_direction(draw_point a, draw_point b) {
  double length = draw_distance(a, b);
  return (draw_point){(b.x - a.x) / length, (b.y - a.y) / length};
}

void draw_obstacles_free(draw_obstacles *obstacles) {
  free(obstacles->boxes);
  free(obstacles->segments);
  *obstacles = (draw_obstacles){0};
}

// Room for one more element of `size` bytes; NULL when there is none, the old array then stays.
static void *grow(void *array, size_t count, size_t *room, size_t size) {
  if (count < *room) return array;
  size_t more = *room ? 2 * *room : 64;
  void *grown = realloc(array, more * size);
  if (grown) *room = more;
  return grown;
}

void draw_add_box(draw_obstacles *obstacles, draw_box box) {
  draw_box *boxes = grow(obstacles->boxes, obstacles->box_count, &obstacles->box_room, sizeof box);
  if (!boxes) {
    obstacles->lost = true;
    return;
  }
  obstacles->boxes = boxes;
  boxes[obstacles->box_count++] = box;
}

void draw_add_segment(draw_obstacles *obstacles, draw_point a, draw_point b) {
  draw_segment *segments = grow(obstacles->segments, obstacles->segment_count,
                                &obstacles->segment_room, sizeof *segments);
  if (!segments) {
    obstacles->lost = true;
    return;
  }
  obstacles->segments = segments;
  segments[obstacles->segment_count++] = (draw_segment){a, b};
}

static bool boxes_overlap(draw_box a, draw_box b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

// Narrows the part of a segment, from[0] to from[1] of its length, to low <= start + t step <=
// high.
static void clip(double part[2], double start, double step, double low, double high) {
  if (step == 0) {
    if (start < low || start > high) part[1] = part[0];
    return;
  }
  double enter = (low - start) / step, leave = (high - start) / step;
  part[0] = fmax(part[0], fmin(enter, leave));
  part[1] = fmin(part[1], fmax(enter, leave));
}

// Length of a segment within a box.
static double length_inside(draw_segment segment, draw_box box) {
  double part[2] = {0, 1};
  clip(part, segment.a.x, segment.b.x - segment.a.x, box.low.x, box.high.x);
  clip(part, segment.a.y, segment.b.y - segment.a.y, box.low.y, box.high.y);
  return part[1] > part[0] ? (part[1] - part[0]) * draw_distance(segment.a, segment.b) : 0;
}

double draw_box_cost(const draw_obstacles *obstacles, draw_box box) {
  double cost = 0;
  for (size_t i = 0; i < obstacles->box_count; i++)
    if (boxes_overlap(obstacles->boxes[i], box)) cost += covered_box_cost;
  for (size_t i = 0; i < obstacles->segment_count; i++)
    cost += DRAW_CROSSED_PIXEL_COST * length_inside(obstacles->segments[i], box);
  return cost;
}

static double distance_to(draw_segment s, draw_point at) {
  double x = s.b.x - s.a.x, y = s.b.y - s.a.y, square = x * x + y * y;
  double along = square > 0 ? ((at.x - s.a.x) * x + (at.y - s.a.y) * y) / square : 0;
  along = fmin(fmax(along, 0), 1);
  return hypot(s.a.x + along * x - at.x, s.a.y + along * y - at.y);
}

// Most segments are told to be far by their box.
bool draw_is_near_line(const draw_obstacles *obstacles, draw_point at, double distance) {
  for (size_t i = 0; i < obstacles->segment_count; i++) {
    draw_segment s = obstacles->segments[i];
    if (fmin(s.a.x, s.b.x) - at.x > distance || at.x - fmax(s.a.x, s.b.x) > distance ||
        fmin(s.a.y, s.b.y) - at.y > distance || at.y - fmax(s.a.y, s.b.y) > distance)
      continue;
    if (distance_to(s, at) < distance) return true;
  }
  return false;
}
