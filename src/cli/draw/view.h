// SPDX-License-Identifier: Apache-2.0
// From the bicycle's side view in metres to the picture in pixels.
#ifndef BICYCLE_CLI_DRAW_VIEW_H
#define BICYCLE_CLI_DRAW_VIEW_H

#include "labels.h"

#include <bicycle/bicycle.h>

// The picture being drawn, and the points of the bicycle in it (pixels).
typedef struct draw_view {
  const bike_bicycle *bicycle;
  bike_upright upright;
  double scale; // pixels per metre
  draw_point rear_contact, front_contact;
  draw_point rear_hub, front_hub;
  draw_point origin;     // the steering axis meets the ground
  draw_point front_foot; // foot of the perpendicular from the front hub onto the steering axis
  draw_point rear_foot;  // the same of the rear hub
  draw_point across;     // unit vector of the axis p: forward, at right angles to the axis
  draw_point axis;       // unit vector of the axis S: up along the steering axis
  draw_canvas canvas;
  draw_labels labels;
} draw_view;

// Places the bicycle; BIKE_ERROR_IMPOSSIBLE where it cannot stand, BIKE_ERROR_MEMORY.
int draw_view_init(draw_view *view, const bike_bicycle *bicycle);
void draw_view_free(draw_view *view);

// Pixels of a place given forward of the rear contact and up, in metres.
draw_point draw_place(const draw_view *view, double forward, double up);

// The largest coordinate of the bicycle, its wheels and its parts along a direction, in pixels.
double draw_extent(const draw_view *view, draw_point direction);

#endif
