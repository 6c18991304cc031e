// SPDX-License-Identifier: Apache-2.0
// An SVG picture that grows as it is drawn and remembers what stands where.
#ifndef BICYCLE_CLI_DRAW_CANVAS_H
#define BICYCLE_CLI_DRAW_CANVAS_H

#include "obstacles.h"

#include <stdio.h>

typedef struct draw_canvas {
  FILE *body; // the elements, in memory until the size of the picture is known
  char *text;
  size_t size;
  draw_box bounds;
  draw_obstacles obstacles;
} draw_canvas;

// A text: a symbol in italics with a subscript, both may be empty, and what follows, upright.
typedef struct draw_label {
  const char *symbol;
  const char *subscript;
  const char *rest;
} draw_label;

enum { DRAW_FONT_SIZE = 15, DRAW_TITLE_SIZE = 20 }; // pixels

// False when out of memory. Close it in any case.
bool draw_open(draw_canvas *canvas);
void draw_close(draw_canvas *canvas);

// Writes the picture, titled for those who cannot see it. False when it could not be drawn.
bool draw_write(draw_canvas *canvas, const char *title, FILE *stream);

// A straight line that labels should not cross. `style` is a class of the style sheet.
void draw_line(draw_canvas *canvas, const char *style, draw_point a, draw_point b);

// The same without being in the way of labels: hatching, spokes.
void draw_faint_line(draw_canvas *canvas, const char *style, draw_point a, draw_point b);

void draw_circle(draw_canvas *canvas, const char *style, draw_point centre, double radius);

// The arc from a to b about a centre, the short way, clockwise on the screen.
void draw_arc(draw_canvas *canvas, const char *style, draw_point centre, draw_point a,
              draw_point b);

// A filled polygon: arrow heads and the like.
void draw_polygon(draw_canvas *canvas, const char *style, const draw_point *points, int count);

// A quarter disc of the mark for a centre of mass, quarter 0 .. 3 clockwise from the top right.
void draw_quarter(draw_canvas *canvas, const char *style, draw_point centre, double radius,
                  int quarter);

// The box a label fills when its middle stands at a point.
draw_box draw_label_box(draw_point middle, const draw_label *label);

// Writes a label with its middle at a point. A white edge keeps it readable over lines.
void draw_text(draw_canvas *canvas, draw_point middle, const draw_label *label);

// Writes a label where, of all `count` middles, it is least in the way; earlier ones are
// preferred. Returns the place.
draw_point draw_text_best(draw_canvas *canvas, const draw_point *middles, int count,
                          const draw_label *label);

void draw_title(draw_canvas *canvas, draw_point left, const char *text);

#endif
