// SPDX-License-Identifier: Apache-2.0
#include "view.h"

#include "dimensions.h"

#include <bicycle/error.h>
#include <math.h>

// The bicycle's longer side in the picture, in pixels; the dimension lines come on top.
static const double picture_size = 820;

draw_point draw_place(const draw_view *view, double forward, double up) {
  return (draw_point){view->scale * forward, -view->scale * up};
}

double draw_extent(const draw_view *view, draw_point direction) {
  const bike_bicycle *bicycle = view->bicycle;
  double rear = draw_coordinate(view->rear_hub, direction) + view->scale * bicycle->geometry.R_r;
  double front = draw_coordinate(view->front_hub, direction) + view->scale * bicycle->geometry.R_f;
  double extent = fmax(rear, front);
  for (int i = 0; i < bicycle->part_count; i++) {
    const double *position = bicycle->parts[i].position;
    draw_point place = draw_place(view, position[0], position[2]);
    extent = fmax(extent, draw_coordinate(place, direction));
  }
  return extent;
}

static double longer_side(const draw_view *view) {
  static const draw_point right = {1, 0}, left = {-1, 0}, down = {0, 1}, up = {0, -1};
  return fmax(draw_extent(view, right) + draw_extent(view, left),
              draw_extent(view, down) + draw_extent(view, up));
}

static void place_points(draw_view *view) {
  const bike_geometry *geometry = &view->bicycle->geometry;
  const bike_upright *upright = &view->upright;
  view->axis = (draw_point){-sin(upright->tilt), -cos(upright->tilt)};
  view->across = (draw_point){cos(upright->tilt), -sin(upright->tilt)};
  view->rear_contact = draw_place(view, 0, 0);
  view->front_contact = draw_place(view, upright->wheelbase, 0);
  view->rear_hub = draw_place(view, upright->rear_hub[0], upright->rear_hub[2]);
  view->front_hub = draw_place(view, upright->front_hub[0], upright->front_hub[2]);
  view->origin = draw_place(view, upright->axis_ground, 0);
  view->front_foot = draw_along(view->origin, view->axis, view->scale * upright->foot_height);
  view->rear_foot = draw_along(view->front_foot, view->axis, view->scale * geometry->L_s);
}

int draw_view_init(draw_view *view, const bike_bicycle *bicycle) {
  *view = (draw_view){.bicycle = bicycle, .scale = 1};
  int error = bike_upright_position(&view->upright, &bicycle->geometry);
  if (error != BIKE_OK) return error;
  place_points(view); // at one pixel per metre, to see how large it is
  view->scale = picture_size / longer_side(view);
  place_points(view);
  return draw_open(&view->canvas) ? BIKE_OK : BIKE_ERROR_MEMORY;
}

void draw_view_free(draw_view *view) {
  draw_close(&view->canvas);
}
