// SPDX-License-Identifier: Apache-2.0
#include "labels.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

draw_waiting *draw_new_label(draw_labels *labels, const char *symbol, const char *subscript,
                             const char *format, ...) {
  if (labels->count < DRAW_MAX_LABELS) labels->count++;
  draw_waiting *label = &labels->items[labels->count - 1];
  *label = (draw_waiting){.symbol = symbol, .subscript = subscript};
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(label->rest, sizeof label->rest, format, arguments);
  va_end(arguments);
  return label;
}

static draw_label text_of(const draw_waiting *label) {
  return (draw_label){label->symbol, label->subscript, label->rest};
}

// Half of the label's extent along a direction.
static double half_extent(const draw_waiting *label, draw_point direction) {
  draw_label text = text_of(label);
  draw_box box = draw_label_box((draw_point){0, 0}, &text);
  return fabs(direction.x) * box.high.x + fabs(direction.y) * box.high.y;
}

void draw_offer(draw_waiting *label, draw_point point, draw_point direction, double gap) {
  if (label->place_count == DRAW_MAX_PLACES) return;
  double distance = gap + half_extent(label, direction);
  label->places[label->place_count++] = draw_along(point, direction, distance);
}

// Offers a place whose nearest side, or corner on a diagonal, is `distance` from a point.
static void offer_beside(draw_waiting *label, draw_point point, int right, int down,
                         double distance) {
  if (label->place_count == DRAW_MAX_PLACES) return;
  double length = hypot(right, down);
  double half_width = half_extent(label, (draw_point){1, 0});
  double half_height = half_extent(label, (draw_point){0, 1});
  label->places[label->place_count++] =
      (draw_point){point.x + right * (distance / length + half_width),
                   point.y + down * (distance / length + half_height)};
}

void draw_offer_around(draw_waiting *label, draw_point point, double gap) {
  static const double reach[] = {0, 22, 50, 90}; // pixels beyond the gap
  static const int side[8][2] = {{1, 0},  {-1, 0}, {0, 1},  {0, -1},
                                 {1, -1}, {1, 1},  {-1, 1}, {-1, -1}};
  for (int ring = 0; ring < 4; ring++)
    for (int i = 0; i < 8; i++)
      offer_beside(label, point, side[i][0], side[i][1], gap + reach[ring]);
  label->has_anchor = true;
  label->anchor = point;
}

// The nearest point of a box.
static draw_point nearest(draw_box box, draw_point point) {
  return (draw_point){fmin(fmax(point.x, box.low.x), box.high.x),
                      fmin(fmax(point.y, box.low.y), box.high.y)};
}

static void join(draw_canvas *canvas, const draw_waiting *label, draw_point place) {
  static const double from = 10, shortest = 16; // pixels: out of the mark; worth a line
  draw_label text = text_of(label);
  draw_point end = nearest(draw_label_box(place, &text), label->anchor);
  if (draw_distance(label->anchor, end) < from + shortest) return;
  draw_point start = draw_along(label->anchor, draw_direction(label->anchor, end), from);
  draw_line(canvas, "leader", start, end);
}

void draw_place_labels(draw_canvas *canvas, const draw_labels *labels) {
  for (int i = 0; i < labels->count; i++) {
    const draw_waiting *label = &labels->items[i];
    draw_label text = text_of(label);
    draw_point place = draw_text_best(canvas, label->places, label->place_count, &text);
    if (label->has_anchor) join(canvas, label, place);
  }
}
