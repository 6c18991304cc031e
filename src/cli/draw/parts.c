// SPDX-License-Identifier: Apache-2.0
#include "parts.h"

#include <math.h>

void draw_ground(draw_view *view, double from, double to) {
  static const double step = 14, depth = 9; // of the hatching, pixels
  static const double bare = 28;            // below the ground, where labels would look lost
  draw_canvas *canvas = &view->canvas;
  for (double x = from + step; x <= to; x += step)
    draw_faint_line(canvas, "hatch", (draw_point){x, 1}, (draw_point){x - depth, depth});
  draw_line(canvas, "ground", (draw_point){from, 0}, (draw_point){to, 0});
  draw_add_box(&canvas->obstacles, (draw_box){{from, 0}, {to, bare}});
}

// The tyre's outer edge is the radius: where it rolls.
static void draw_wheel(draw_canvas *canvas, draw_point hub, double radius) {
  enum { SPOKES = 24 };
  double tyre = fmin(3, radius / 4), rim = fmax(radius - 4 * tyre, radius / 2);
  for (int i = 0; i < SPOKES; i++) {
    double angle = 2 * M_PI * i / SPOKES;
    draw_faint_line(canvas, "spoke", hub,
                    draw_along(hub, (draw_point){cos(angle), sin(angle)}, rim));
  }
  draw_circle(canvas, "rim", hub, rim);
  draw_circle(canvas, "tyre", hub, radius - tyre);
}

void draw_wheels(draw_view *view) {
  const bike_geometry *geometry = &view->bicycle->geometry;
  draw_wheel(&view->canvas, view->rear_hub, view->scale * geometry->R_r);
  draw_wheel(&view->canvas, view->front_hub, view->scale * geometry->R_f);
}

void draw_frames(draw_view *view) {
  draw_canvas *canvas = &view->canvas;
  draw_line(canvas, "rear", view->rear_hub, view->rear_foot);
  draw_line(canvas, "front", view->rear_foot, view->front_foot);
  draw_line(canvas, "front", view->front_foot, view->front_hub);
  draw_circle(canvas, "hub", view->rear_hub, 5);
  draw_circle(canvas, "hub", view->front_hub, 5);
}

// The usual mark: a disc with two of its quarters filled.
static void draw_mark(draw_canvas *canvas, draw_point place) {
  static const double radius = 8;
  for (int quarter = 0; quarter < 4; quarter++)
    draw_quarter(canvas, quarter % 2 ? "mass-fill" : "mass-back", place, radius, quarter);
  draw_circle(canvas, "mass-edge", place, radius);
  draw_add_box(&canvas->obstacles, (draw_box){draw_along(place, (draw_point){-1, -1}, radius),
                                              draw_along(place, (draw_point){1, 1}, radius)});
}

void draw_centres_of_mass(draw_view *view) {
  for (int i = 0; i < view->bicycle->part_count; i++) {
    const bike_part *part = &view->bicycle->parts[i];
    draw_point place = draw_place(view, part->position[0], part->position[2]);
    draw_mark(&view->canvas, place);
    draw_waiting *label =
        draw_new_label(&view->labels, "", "", "%s %.4g kg", part->name, part->mass);
    draw_offer_around(label, place, 11);
  }
}
