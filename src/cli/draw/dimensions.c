// SPDX-License-Identifier: Apache-2.0
#include "dimensions.h"

#include <math.h>

// Pixels.
static const double arrow_length = 11, arrow_width = 3.2; // head, and half of its base
static const double tail = 20;                            // of an arrow that points inwards
static const double helper_gap = 5, helper_over = 6;      // of the lines to what is measured
static const double text_gap = 3;

double draw_coordinate(draw_point point, draw_point direction) {
  return point.x * direction.x + point.y * direction.y;
}

bool draw_is_wide(double length) {
  return length > 4 * arrow_length;
}

static draw_point turned(draw_point direction) {
  return (draw_point){-direction.y, direction.x};
}

static draw_point reversed(draw_point direction) {
  return (draw_point){-direction.x, -direction.y};
}

// An arrow head whose tip, pointing along `direction`, is at a point.
static void arrow_head(draw_canvas *canvas, draw_point tip, draw_point direction) {
  draw_point base = draw_along(tip, direction, -arrow_length);
  draw_point side = turned(direction);
  const draw_point head[3] = {tip, draw_along(base, side, arrow_width),
                              draw_along(base, side, -arrow_width)};
  draw_polygon(canvas, "arrow", head, 3);
}

// The thin line from what is measured to just beyond the dimension line.
static void helper(draw_canvas *canvas, draw_point from, draw_point to) {
  if (draw_distance(from, to) <= helper_gap) return;
  draw_point direction = draw_direction(from, to);
  draw_line(canvas, "helper", draw_along(from, direction, helper_gap),
            draw_along(to, direction, helper_over));
}

// Arrows between the ends, or, where there is no room, from outside.
static void arrows(draw_canvas *canvas, draw_point a, draw_point b, draw_point along, bool wide) {
  draw_point back = reversed(along);
  if (wide) {
    draw_line(canvas, "dimension", a, b);
    arrow_head(canvas, a, back);
    arrow_head(canvas, b, along);
  } else {
    draw_line(canvas, "dimension", draw_along(a, back, tail), draw_along(b, along, tail));
    arrow_head(canvas, a, along);
    arrow_head(canvas, b, back);
  }
}

// Places beside the line, in its middle first; a short one offers those beyond its ends before.
static void offer_places(draw_waiting *label, draw_point a, draw_point b, draw_point along,
                         draw_point normal, bool wide) {
  static const double share[] = {0.5, 0.35, 0.65, 0.2, 0.8};
  draw_point back = reversed(along);
  if (!wide) {
    draw_offer(label, b, along, tail + text_gap);
    draw_offer(label, a, back, tail + text_gap);
  }
  for (int i = 0; i < 5; i++) {
    draw_point place = draw_along(a, along, share[i] * draw_distance(a, b));
    draw_offer(label, place, normal, text_gap);
    draw_offer(label, place, reversed(normal), text_gap);
  }
}

// A sign as long as the digits are wide, as in print.
static const char *sign_of(double value) {
  return value < 0 ? "\u2212" : "";
}

void draw_dimension(draw_canvas *canvas, draw_labels *labels, draw_point a, draw_point b,
                    draw_point normal, double level, const char *symbol, const char *subscript,
                    double value) {
  draw_point end_a = draw_along(a, normal, level - draw_coordinate(a, normal));
  draw_point end_b = draw_along(b, normal, level - draw_coordinate(b, normal));
  double length = draw_distance(end_a, end_b);
  bool wide = draw_is_wide(length);
  // A length of zero has no direction of its own.
  draw_point along = length > 0 ? draw_direction(end_a, end_b) : turned(normal);
  helper(canvas, a, end_a);
  helper(canvas, b, end_b);
  arrows(canvas, end_a, end_b, along, wide);
  draw_waiting *label =
      draw_new_label(labels, symbol, subscript, "= %s%.4g m", sign_of(value), fabs(value));
  offer_places(label, end_a, end_b, along, normal, wide);
}

void draw_radius(draw_canvas *canvas, draw_labels *labels, draw_point centre, draw_point direction,
                 double pixels, const char *subscript, double value) {
  draw_point rim = draw_along(centre, direction, pixels);
  draw_line(canvas, "dimension", centre, rim);
  arrow_head(canvas, rim, direction);
  draw_waiting *label = draw_new_label(labels, "R", subscript, "= %.4g m", value);
  offer_places(label, centre, rim, direction, turned(direction), true);
  draw_offer(label, rim, direction, text_gap);
  // beside the tip, where a small wheel has no room within
  const double tyre = 12; // pixels
  draw_point tip = draw_along(rim, direction, tyre);
  draw_offer(label, tip, turned(direction), text_gap);
  draw_offer(label, tip, reversed(turned(direction)), text_gap);
}

void draw_tilt(draw_canvas *canvas, draw_labels *labels, draw_point vertex, draw_point axis,
               double value) {
  static const double arm = DRAW_TILT_SIZE, radius = 0.84 * DRAW_TILT_SIZE;
  static const draw_point up = {0, -1};
  draw_line(canvas, "upright", vertex, draw_along(vertex, up, arm));
  draw_point on_axis = draw_along(vertex, axis, radius),
             on_upright = draw_along(vertex, up, radius);
  bool back = axis.x < 0; // leans back: the axis is to the left of the vertical
  draw_arc(canvas, "dimension", vertex, back ? on_axis : on_upright, back ? on_upright : on_axis);
  draw_waiting *label =
      draw_new_label(labels, "β", "", "= %s%.4g°", sign_of(value), fabs(value) * (180 / M_PI));
  draw_offer(label, on_upright, (draw_point){1, 0}, 8);
  draw_offer(label, on_axis, (draw_point){-1, 0}, 8);
  draw_offer(label, draw_along(vertex, up, arm), up, 8);
}
