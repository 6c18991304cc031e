// SPDX-License-Identifier: Apache-2.0
#include "report_plot.h"

#include "report_markup.h"

#include <math.h>
#include <stdlib.h>

// Units of the picture. 460 wide: 13 high letters are still read on a screen of 400 pixels.
enum { WIDTH = 460, HEIGHT = 210, LEFT = 62, RIGHT = 10, TOP = 10, BOTTOM = 36, COLUMNS = 100 };

static double scaled(const report_axis *axis, double value) {
  return axis->log ? log10(value) : value;
}

// 0..1 along an axis.
static double share(const report_axis *axis, double value) {
  double low = scaled(axis, axis->low), high = scaled(axis, axis->high);
  return (scaled(axis, value) - low) / (high - low);
}

static double pixel_x(const report_plot *p, double value) {
  return LEFT + share(&p->x, value) * (WIDTH - LEFT - RIGHT);
}

static double pixel_y(const report_plot *p, double value) {
  return HEIGHT - BOTTOM - share(&p->y, value) * (HEIGHT - TOP - BOTTOM);
}

static bool is_shown(const report_axis *axis, double value) {
  return isfinite(value) && (!axis->log || value > 0);
}

void report_axis_include(report_axis *axis, const double *values, size_t count) {
  for (size_t i = 0; i < count; i++) {
    if (!is_shown(axis, values[i])) continue;
    if (!(values[i] >= axis->low)) axis->low = values[i]; // also where there is none yet
    if (!(values[i] <= axis->high)) axis->high = values[i];
  }
}

// Whole decades; a margin of a twentieth; something to look at where there is nothing.
static void round_axis(report_axis *axis) {
  if (!(axis->low <= axis->high)) axis->low = axis->high = axis->log ? 1 : 0;
  if (axis->log) {
    axis->low = pow(10, floor(log10(axis->low)));
    axis->high = pow(10, ceil(log10(axis->high)));
    if (axis->high <= axis->low) axis->high = 10 * axis->low;
    return;
  }
  double width = axis->high - axis->low;
  if (!(width > 0)) width = fabs(axis->low) > 0 ? fabs(axis->low) : 1;
  axis->low -= 0.05 * width;
  axis->high += 0.05 * width;
}

// The distance of ticks: 1, 2 or 5 times a power of ten, or whole decades; some five in all.
static double tick_distance(const report_axis *axis) {
  double raw = (scaled(axis, axis->high) - scaled(axis, axis->low)) / 5;
  if (axis->log) return fmax(1, ceil(raw));
  double unit = pow(10, floor(log10(raw))), step = raw / unit;
  return unit * (step > 5 ? 10 : step > 2 ? 5 : step > 1 ? 2 : 1);
}

static void print_tick(const report_plot *p, bool horizontal, double at, const char *name) {
  if (horizontal)
    fprintf(p->stream, "<path class=grid d='M%.1f %dV%d'/><text x=%.1f y=%d class=mid>%s</text>",
            at, TOP, HEIGHT - BOTTOM, at, HEIGHT - BOTTOM + 15, name);
  else
    fprintf(p->stream, "<path class=grid d='M%d %.1fH%d'/><text x=%d y=%.1f class=end>%s</text>",
            LEFT, at, WIDTH - RIGHT, LEFT - 4, at + 4, name);
}

static void print_ticks(const report_plot *p, const report_axis *axis) {
  double distance = tick_distance(axis);
  double low = scaled(axis, axis->low), high = scaled(axis, axis->high);
  double first = ceil(low / distance - 1e-9); // a tick that is the end itself, but for rounding
  for (int i = 0; (first + i) * distance <= high + 1e-9 * distance; i++) {
    double at = (first + i) * distance, value = axis->log ? pow(10, at) : at;
    char name[REPORT_NUMBER];
    if (axis->log)
      snprintf(name, sizeof name, "1e%d", (int)at);
    else
      snprintf(name, sizeof name, "%.6g", fabs(at) < 1e-9 * distance ? 0 : at);
    print_tick(p, axis == &p->x, axis == &p->x ? pixel_x(p, value) : pixel_y(p, value), name);
  }
}

report_plot report_plot_begin(FILE *stream, const char *title, const char *description,
                              report_axis x, report_axis y) {
  report_plot p = {stream, x, y};
  round_axis(&p.y);
  if (p.x.log || !(p.x.low < p.x.high)) round_axis(&p.x);
  report_markup(stream,
                "<figure><figcaption>%s</figcaption><svg viewBox='0 0 460 210' role=img "
                "aria-label='%s'>",
                title, description);
  print_ticks(&p, &p.x);
  print_ticks(&p, &p.y);
  fprintf(stream, "<path class=frame d='M%d %dV%dH%d'/>", LEFT, TOP, HEIGHT - BOTTOM,
          WIDTH - RIGHT);
  fprintf(stream, "<text x=%d y=%d class=end>", WIDTH - RIGHT, HEIGHT - 4);
  report_escape(stream, x.label);
  fprintf(stream, "</text><text transform='translate(13 %d)rotate(-90)' class=mid>",
          (HEIGHT - BOTTOM + TOP) / 2);
  report_escape(stream, y.label);
  fputs("</text>", stream);
  return p;
}

void report_plot_end(const report_plot *p) {
  fputs("</svg></figure>\n", p->stream);
}

// Where a path has got to, in tenths of a unit: whole numbers, so that steps add up exactly.
typedef struct pen {
  long x, y;
  bool down;
} pen;

// Tenths as a decimal number, with a blank before it where the one before would swallow it.
static void print_tenths(FILE *stream, long tenths, bool blank) {
  const char *sign = tenths < 0 ? "-" : blank ? " " : "";
  long size = labs(tenths);
  if (size % 10)
    fprintf(stream, "%s%ld.%ld", sign, size / 10, size % 10);
  else
    fprintf(stream, "%s%ld", sign, size / 10);
}

// Steps are shorter than places: half of the page's pictures are such numbers.
static void print_point(const report_plot *p, pen *at, double x, double y) {
  long to_x = lrint(10 * pixel_x(p, x)), to_y = lrint(10 * pixel_y(p, y));
  fputc(at->down ? 'l' : 'M', p->stream);
  print_tenths(p->stream, at->down ? to_x - at->x : to_x, false);
  print_tenths(p->stream, at->down ? to_y - at->y : to_y, true);
  *at = (pen){to_x, to_y, true};
}

// The extremes of points begin .. end - 1, in the order in which they stand.
static void print_bucket(const report_plot *p, pen *at, const double *x, const double *y,
                         size_t begin, size_t end) {
  size_t low = end, high = end;
  for (size_t k = begin; k < end; k++) {
    if (!is_shown(&p->x, x[k]) || !is_shown(&p->y, y[k])) {
      at->down = false;
      continue;
    }
    if (low == end || y[k] < y[low]) low = k;
    if (high == end || y[k] > y[high]) high = k;
  }
  if (low == end) {
    at->down = false;
    return;
  }
  size_t first = low < high ? low : high, second = low < high ? high : low;
  print_point(p, at, x[first], y[first]);
  if (second != first) print_point(p, at, x[second], y[second]);
}

void report_plot_line(const report_plot *p, const char *style, const double *x, const double *y,
                      size_t count) {
  size_t width = count / COLUMNS + 1;
  pen at = {0, 0, false};
  fprintf(p->stream, "<path class=%s d='", style);
  for (size_t k = 0; k < count; k += width)
    print_bucket(p, &at, x, y, k, k + width < count ? k + width : count);
  fputs("'/>", p->stream);
}

void report_plot_dots(const report_plot *p, const char *style, const double *x, const double *y,
                      size_t count) {
  for (size_t k = 0; k < count; k++)
    if (is_shown(&p->x, x[k]) && is_shown(&p->y, y[k]))
      fprintf(p->stream, "<circle class=%s cx=%.1f cy=%.1f r=4><title>%.3g, %.3g</title></circle>",
              style, pixel_x(p, x[k]), pixel_y(p, y[k]), x[k], y[k]);
}

void report_plot_level(const report_plot *p, const char *style, double y, const char *name) {
  if (!is_shown(&p->y, y)) return;
  double at = pixel_y(p, y);
  if (!(at >= TOP && at <= HEIGHT - BOTTOM)) return;
  fprintf(p->stream, "<path class=%s d='M%d %.1fH%d'/><text x=%d y=%.1f class=end>", style, LEFT,
          at, WIDTH - RIGHT, WIDTH - RIGHT - 2, at < TOP + 14 ? at + 13 : at - 3);
  report_escape(p->stream, name);
  fputs("</text>", p->stream);
}

void report_plot_mark(const report_plot *p, const char *style, double x, const char *name) {
  if (!is_shown(&p->x, x)) return;
  double at = pixel_x(p, x);
  if (!(at >= LEFT && at <= WIDTH - RIGHT)) return;
  fprintf(p->stream, "<path class=%s d='M%.1f %dV%d'/><text x=%.1f y=%d>", style, at, TOP,
          HEIGHT - BOTTOM, at + 3, TOP + 10);
  report_escape(p->stream, name);
  fputs("</text>", p->stream);
}

void report_plot_slope(const report_plot *p, double x, double y, double width, double order) {
  double far = x / width, down = y * pow(width, -order);
  if (!is_shown(&p->x, far) || !is_shown(&p->y, down) || !is_shown(&p->y, y)) return;
  double right = pixel_x(p, x), left = pixel_x(p, far), top = pixel_y(p, y);
  double bottom = pixel_y(p, down);
  fprintf(p->stream, "<path class=slope d='M%.1f %.1fH%.1fV%.1fZ'/><text x=%.1f y=%.1f>%.3g</text>",
          left, bottom, right, top, right + 3, 0.5 * (top + bottom) + 4, order);
}
