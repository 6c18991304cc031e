// SPDX-License-Identifier: Apache-2.0
// Plots as inline SVG, styled by the page: what a reader without scripts sees.
#ifndef VALIDATE_REPORT_PLOT_H
#define VALIDATE_REPORT_PLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct report_axis {
  const char *label;
  bool log;         // values are shown by their logarithm; those <= 0 are left out
  double low, high; // of the data; log: both > 0
} report_axis;

typedef struct report_plot {
  FILE *stream;
  report_axis x, y;
} report_plot;

// Opens the picture: frame, ticks, labels. `title` and `description` are text. The axes are widened
// to whole ticks where they are logarithmic, by a margin where they are not.
report_plot report_plot_begin(FILE *stream, const char *title, const char *description,
                              report_axis x, report_axis y);
void report_plot_end(const report_plot *p);

// A line through points of class `style`; of many points in a column of pixels the extremes. It is
// broken where a point cannot be shown.
void report_plot_line(const report_plot *p, const char *style, const double *x, const double *y,
                      size_t count);

// Dots, each with the text of its values for the pointer.
void report_plot_dots(const report_plot *p, const char *style, const double *x, const double *y,
                      size_t count);

// A horizontal line over the whole width, with its name at the right end.
void report_plot_level(const report_plot *p, const char *style, double y, const char *name);

// A vertical line over the whole height, with its name at the top.
void report_plot_mark(const report_plot *p, const char *style, double x, const char *name);

// A triangle that shows the slope `order` on two logarithmic axes, over a factor `width` in x that
// ends at (x, y).
void report_plot_slope(const report_plot *p, double x, double y, double width, double order);

// Widens an axis by values; only those that it can show.
void report_axis_include(report_axis *axis, const double *values, size_t count);

#endif
