// SPDX-License-Identifier: Apache-2.0
#include "drawing.h"

#include "dimensions.h"
#include "parts.h"
#include "view.h"

#include <bicycle/error.h>
#include <math.h>

// Distances in pixels between the bicycle and a dimension line, and between two of these.
static const double first_lane = 40, next_lane = 42;

static const draw_point right = {1, 0}, left = {-1, 0}, down = {0, 1}, up = {0, -1};

// Along the ground, the shortest first.
static void draw_ground_dimensions(draw_view *view) {
  const bike_upright *upright = &view->upright;
  draw_canvas *canvas = &view->canvas;
  draw_dimension(canvas, &view->labels, view->front_contact, view->origin, down, first_lane, "T",
                 "f", upright->trail);
  draw_dimension(canvas, &view->labels, view->rear_contact, view->front_contact, down,
                 first_lane + next_lane, "w", "", upright->wheelbase);
  draw_dimension(canvas, &view->labels, view->rear_contact, view->origin, down,
                 first_lane + 2 * next_lane, "T", "r", upright->axis_ground);
}

// Along the steering axis, before the bicycle: Z_0, and L_s on the same line if it goes on upwards
// from there.
static void draw_axis_dimensions(draw_view *view) {
  const bike_geometry *geometry = &view->bicycle->geometry;
  double first = fmax(draw_coordinate(view->front_hub, view->across) + view->scale * geometry->R_f,
                      draw_coordinate(view->origin, view->across)) +
                 first_lane;
  bool chained = geometry->L_s > 0 && draw_is_wide(view->scale * geometry->L_s);
  draw_dimension(&view->canvas, &view->labels, view->origin, view->front_hub, view->across, first,
                 "Z", "0", view->upright.foot_height);
  draw_dimension(&view->canvas, &view->labels, view->front_hub, view->rear_foot, view->across,
                 chained ? first : first + next_lane, "L", "s", geometry->L_s);
}

// At right angles to the steering axis, above the bicycle, with the angle on top. Levels are
// coordinates along the axis.
static void draw_cross_dimensions(draw_view *view) {
  const bike_geometry *geometry = &view->bicycle->geometry;
  draw_canvas *canvas = &view->canvas;
  double first = draw_extent(view, view->axis) + first_lane, second = first + next_lane;
  double vertex = second + first_lane, top = vertex + DRAW_TILT_SIZE;
  double origin = draw_coordinate(view->origin, view->axis);
  draw_dimension(canvas, &view->labels, view->front_foot, view->front_hub, view->axis, first, "L",
                 "f", geometry->L_f);
  draw_dimension(canvas, &view->labels, view->rear_hub, view->rear_foot, view->axis, second, "L",
                 "r", geometry->L_r);
  draw_line(canvas, "axis", draw_along(view->origin, view->axis, -20),
            draw_along(view->origin, view->axis, top - origin));
  draw_tilt(canvas, &view->labels, draw_along(view->origin, view->axis, vertex - origin),
            view->axis, view->upright.tilt);
}

// Directions in which nothing else is: back and up at the rear, between the lines of L_f and L_s
// at the front.
static void draw_radii(draw_view *view) {
  const bike_geometry *geometry = &view->bicycle->geometry;
  double rear = 215 * (M_PI / 180), front = view->upright.tilt + 30 * (M_PI / 180);
  draw_radius(&view->canvas, &view->labels, view->rear_hub, (draw_point){cos(rear), -sin(rear)},
              view->scale * geometry->R_r, "r", geometry->R_r);
  draw_radius(&view->canvas, &view->labels, view->front_hub, (draw_point){cos(front), -sin(front)},
              view->scale * geometry->R_f, "f", geometry->R_f);
}

// The longest of 1, 2, 5 times a power of ten that is at most 180 pixels.
static double scale_bar_length(double scale) {
  double longest = 180 / scale, power = pow(10, floor(log10(longest)));
  double share = longest / power;
  return power * (share >= 5 ? 5 : share >= 2 ? 2 : 1);
}

static void draw_scale_bar(draw_view *view) {
  draw_canvas *canvas = &view->canvas;
  double length = scale_bar_length(view->scale), y = first_lane + 3.2 * next_lane;
  draw_point a = {-draw_extent(view, left), y}, b = draw_along(a, right, view->scale * length);
  draw_line(canvas, "ground", a, b);
  draw_line(canvas, "ground", draw_along(a, up, 5), draw_along(a, down, 5));
  draw_line(canvas, "ground", draw_along(b, up, 5), draw_along(b, down, 5));
  draw_offer(draw_new_label(&view->labels, "", "", "%g m", length), b, right, 8);
}

static void draw_all(draw_view *view) {
  draw_ground(view, -draw_extent(view, left) - first_lane, draw_extent(view, right) + first_lane);
  draw_wheels(view);
  draw_ground_dimensions(view);
  draw_axis_dimensions(view);
  draw_cross_dimensions(view);
  draw_frames(view);
  draw_radii(view);
  draw_scale_bar(view);
  draw_centres_of_mass(view);
  draw_place_labels(&view->canvas, &view->labels);
  draw_point corner = view->canvas.bounds.low;
  draw_title(&view->canvas, draw_along(corner, up, 12), view->bicycle->name);
}

int draw_bicycle(const bike_bicycle *bicycle, FILE *stream) {
  draw_view view;
  char title[BIKE_NAME_SIZE + 64];
  int error = draw_view_init(&view, bicycle);
  if (error == BIKE_OK) {
    draw_all(&view);
    snprintf(title, sizeof title, "%s: side view with the lengths of the frame", bicycle->name);
    if (!draw_write(&view.canvas, title, stream)) error = BIKE_ERROR_MEMORY;
  }
  draw_view_free(&view);
  return error;
}
