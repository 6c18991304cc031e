// SPDX-License-Identifier: Apache-2.0
// A plot for print: a frame with ticks, curves, areas and labels in black and greys, as SVG.
#ifndef BICYCLE_CLI_FIGURES_PLOT_H
#define BICYCLE_CLI_FIGURES_PLOT_H

#include "../draw/obstacles.h"

#include <stdio.h>

// "speed v (m/s)": words, a symbol in italics with a subscript, a unit; each may be empty.
typedef struct plot_title {
  const char *words, *symbol, *subscript, *unit;
} plot_title;

typedef struct plot_axis {
  double low, high; // low < high, in the unit of the title
  plot_title title;
} plot_axis;

// A point in the units of the axes.
typedef struct plot_point {
  double x, y;
} plot_point;

typedef enum plot_style {
  PLOT_THIN,   // contours
  PLOT_DASHED, // contours of negative values, second family
  PLOT_DOTTED, //
  PLOT_HEAVY,  // the contour zero, limits
  PLOT_HEAVY_DASHED,
  PLOT_STYLES
} plot_style;

// Fills, legible without colour.
typedef enum plot_fill {
  PLOT_LIGHT,
  PLOT_MIDDLE,
  PLOT_DARK,
  PLOT_HATCHED,
  PLOT_WHITE,
  PLOT_FILLS
} plot_fill;

enum { PLOT_DASH = 7, PLOT_DASH_SPACE = 4 }; // pixels, of PLOT_DASHED

enum { PLOT_LAYERS = 4 };

typedef struct plot {
  plot_axis x, y;
  FILE *areas, *lines, *labels, *gaps; // layers in memory; gaps: where labels interrupt lines
  char *text[PLOT_LAYERS];
  size_t size[PLOT_LAYERS];
  draw_obstacles obstacles; // pixels: where labels should not be
  int rows_below;           // of a key below the frame
} plot;

// False when out of memory. Close it in any case.
bool plot_open(plot *p, const plot_axis *x, const plot_axis *y);
void plot_close(plot *p);

// Writes the picture: `id` tells it from others of one page, `title` is for those who cannot see
// it, `caption` stands below the axes, broken into lines, {symbols} in italics. False when it could
// not be drawn.
bool plot_write(plot *p, const char *id, const char *title, const char *caption, FILE *stream);

// Where a point stands in the picture, pixels.
draw_point plot_pixel(const plot *p, plot_point at);
bool plot_inside(const plot *p, plot_point at);

// Curves and areas are cut off at the frame; points must be finite.
void plot_line(plot *p, plot_style style, const plot_point *points, int count);
void plot_area(plot *p, plot_fill fill, const plot_point *points, int count);

// Where labels interrupt a curve: middles, rising, along its length in pixels.
enum { PLOT_MOST_GAPS = 16 };
typedef struct plot_gaps {
  int count;
  double width, at[PLOT_MOST_GAPS];
} plot_gaps;

// Curves with labels in three steps, each for all curves: reserve them, so that labels keep off
// them; label them, where the label is least in the way, turned along the curve, on a long curve
// several times, and beside the curve where there is no room on it; draw them.
void plot_reserve_line(plot *p, const plot_point *points, int count);
// Whether there was room.
bool plot_label_line(plot_gaps *gaps, plot *p, plot_style style, const char *text,
                     const plot_point *points, int count);
void plot_interrupted_line(plot *p, plot_style style, const plot_point *points, int count,
                           const plot_gaps *gaps);

// Writes a label with its middle at a point.
void plot_label_at(plot *p, const char *text, plot_point middle);

// An arrow into the frame at a value of the x axis (from below) or of the y axis (from the left).
void plot_arrow_x(plot *p, double x);
void plot_arrow_y(plot *p, double y);

// One line of a key.
typedef struct plot_entry {
  bool is_area;
  plot_style style; // of a line
  plot_fill fill;   // of an area
  const char *text;
} plot_entry;

// The key, in the corner of the frame where it covers least; or below the frame, where the frame is
// full.
void plot_key(plot *p, const plot_entry *entries, int count);
void plot_key_below(plot *p, const plot_entry *entries, int count);

// A filled circle, for single values.
void plot_dot(plot *p, plot_point at);

#endif
