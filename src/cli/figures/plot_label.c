// SPDX-License-Identifier: Apache-2.0
// Labels in a plot: at a point; on a curve where there is room, turned along it; or beside it.
#include "../draw/escape.h"
#include "plot.h"
#include "plot_frame.h"
#include "track.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { LABEL_FONT = 13 };

// Room between a label and the ends of its own line, pixels: twice that between dashes and more, so
// that neither is a dash taken for a minus sign nor a minus sign for a dash.
static const double clear_of_line = 9;

// A label with its proper minus sign, and its width.
typedef struct label {
  char text[40];
  double width; // pixels
} label;

// DejaVu Sans, in units of the font size: digits, the point, the minus sign.
static double width_of(char c) {
  return c == '.' ? 0.32 : c == '-' ? 0.84 : 0.64;
}

static label label_of(const char *text) {
  label l = {.width = 0};
  bool negative = text[0] == '-';
  snprintf(l.text, sizeof l.text, "%s%s", negative ? "\u2212" : "", text + negative);
  for (const char *c = text; *c; c++) l.width += LABEL_FONT * width_of(*c);
  return l;
}

static void put_text(plot *p, const label *l, draw_point middle, double degrees) {
  fprintf(p->labels,
          "<text class=\"on\" text-anchor=\"middle\" transform=\"translate(%.2f %.2f) "
          "rotate(%.1f)\" y=\"%.1f\">",
          middle.x, middle.y, degrees, 0.36 * LABEL_FONT);
  draw_put_escaped(p->labels, l->text);
  fputs("</text>\n", p->labels);
}

// Other lines end at the label's box.
static void put_label(plot *p, const label *l, draw_point middle, double degrees) {
  const double width = l->width + 4, height = LABEL_FONT + 2;
  fprintf(p->gaps,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" "
          "transform=\"translate(%.2f %.2f) rotate(%.1f)\"/>\n",
          -0.5 * width, -0.5 * height, width, height, middle.x, middle.y, degrees);
  put_text(p, l, middle, degrees);
}

static draw_box box_of(draw_point middle, double width, double angle) {
  double along = 0.5 * width + 3, across = 0.5 * LABEL_FONT + 3;
  double half_x = fabs(cos(angle)) * along + fabs(sin(angle)) * across;
  double half_y = fabs(sin(angle)) * along + fabs(cos(angle)) * across;
  return (draw_box){{middle.x - half_x, middle.y - half_y}, {middle.x + half_x, middle.y + half_y}};
}

// A turned label as squares along it, which fill it better than one level box does.
enum { SQUARE = LABEL_FONT + 4 }; // pixels
static int square_count(double width) {
  return 1 + (int)(width / SQUARE);
}

static draw_box square_of(draw_point middle, double width, double angle, int k) {
  double along = width * ((k + 0.5) / square_count(width) - 0.5), half = 0.5 * SQUARE;
  draw_point at = {middle.x + along * cos(angle), middle.y + along * sin(angle)};
  return (draw_box){{at.x - half, at.y - half}, {at.x + half, at.y + half}};
}

static bool is_in_frame(draw_box box) {
  return box.low.x > FRAME_LEFT + 4 && box.high.x < FRAME_LEFT + FRAME_WIDTH - 4 &&
         box.low.y > FRAME_TOP + 4 && box.high.y < FRAME_TOP + FRAME_HEIGHT - 4;
}

void plot_label_at(plot *p, const char *text, plot_point at) {
  label l = label_of(text);
  draw_point middle = plot_pixel(p, at);
  draw_add_box(&p->obstacles, box_of(middle, l.width, 0));
  put_label(p, &l, middle, 0);
}

// Where labels may interrupt a curve: a gap from `first` on, then every `step`. On a dashed line it
// begins where a dash ends and ends where one begins, so that no part of a dash is left that looks
// like a sign or a point.
typedef struct gap_rule {
  double width, first, step; // pixels along the curve
} gap_rule;

static gap_rule rule_for(plot_style style, double label_width) {
  const double period = PLOT_DASH + PLOT_DASH_SPACE, need = label_width + 2 * clear_of_line;
  if (style != PLOT_DASHED) return (gap_rule){need, 0, 5};
  double dashes = ceil((need - PLOT_DASH_SPACE) / period);
  return (gap_rule){dashes * period + PLOT_DASH_SPACE, PLOT_DASH, period};
}

typedef struct label_place {
  draw_point middle;
  double at, angle, cost; // pixels along the curve; rad, screen
} label_place;

// The place around a length of the curve; cost DBL_MAX where it does not fit.
static label_place place_at(const plot *p, const track *t, double length, double width) {
  draw_point a = track_point(t, length - 0.5 * width), b = track_point(t, length + 0.5 * width);
  draw_point middle = track_point(t, length);
  label_place place = {
      .middle = middle, .at = length, .angle = atan2(b.y - a.y, b.x - a.x), .cost = DBL_MAX};
  if (place.angle > M_PI / 2) place.angle -= M_PI;
  if (place.angle < -M_PI / 2) place.angle += M_PI;
  double bend = fabs(middle.x - 0.5 * (a.x + b.x)) + fabs(middle.y - 0.5 * (a.y + b.y));
  const double most_bent = 5; // pixels: beyond, the label leaves its curve
  if (!is_in_frame(box_of(middle, width, place.angle)) || bend > most_bent) return place;
  // a label is read best when it is level
  const double per_bend = 4, per_slope = 6;
  double covered = 0, own = DRAW_CROSSED_PIXEL_COST * SQUARE * square_count(width);
  for (int k = 0; k < square_count(width); k++)
    covered += draw_box_cost(&p->obstacles, square_of(middle, width, place.angle, k));
  // half as much of other lines as of its own at most, and no other label
  if (covered > 1.5 * own) return place;
  place.cost = covered + per_bend * bend + per_slope * fabs(sin(place.angle));
  return place;
}

// The best place between two lengths of the curve, where at least `stub` pixels of line are left on
// either side.
static label_place best_place(const plot *p, const track *t, double from, double to, double stub,
                              const gap_rule *rule, double width) {
  label_place best = {.cost = DBL_MAX};
  double low = from + stub + 0.5 * rule->width, start = rule->first + 0.5 * rule->width;
  for (double s = start + rule->step * fmax(0, ceil((low - start) / rule->step));
       s <= to - stub - 0.5 * rule->width; s += rule->step) {
    label_place place = place_at(p, t, s, width);
    if (place.cost < best.cost) best = place;
  }
  return best;
}

static plot_gaps label_on(plot *p, const label *l, const track *t, const gap_rule *rule,
                          double stub) {
  const double apart = 420; // pixels: about one label for the width of the frame
  double total = track_total(t);
  int labels = (int)fmin(1 + total / apart, PLOT_MOST_GAPS);
  plot_gaps gaps = {.width = rule->width};
  for (int i = 0; i < labels; i++) {
    // not near the ends of its part, where the next part's label may stand
    double part = total / labels, off = labels > 1 ? 0.15 * part : 0;
    label_place best = best_place(p, t, part * i + off, part * (i + 1) - off, stub, rule, l->width);
    if (best.cost == DBL_MAX) continue;
    for (int k = 0; k < square_count(l->width); k++)
      draw_add_box(&p->obstacles, square_of(best.middle, l->width, best.angle, k));
    put_label(p, l, best.middle, best.angle * 180 / M_PI);
    gaps.at[gaps.count++] = best.at;
  }
  return gaps;
}

// A level label whose box touches the curve at a length, on one side (1) or the other (-1).
static draw_point middle_beside(const track *t, double length, double width, int side) {
  const double off = 2; // pixels between the line and the box, which has a margin of its own
  draw_point a = track_point(t, length - 3), b = track_point(t, length + 3);
  draw_point at = track_point(t, length), along = draw_direction(a, b);
  draw_point across = {-side * along.y, side * along.x};
  double reach = fabs(across.x) * 0.5 * width + fabs(across.y) * 0.5 * LABEL_FONT + 3 + off;
  return draw_along(at, across, reach);
}

// A short or bent curve has its label beside it, where no line is in the way.
static bool label_beside(plot *p, const label *l, const track *t) {
  const double step = 4;
  double total = track_total(t), nearest = DBL_MAX;
  draw_point best = {0, 0};
  for (double s = step; s < total - step; s += step) {
    for (int side = -1; side <= 1; side += 2) {
      draw_point middle = middle_beside(t, s, l->width, side);
      draw_box box = box_of(middle, l->width, 0);
      double from_middle = fabs(s - 0.5 * total);
      if (from_middle >= nearest || !is_in_frame(box) || draw_box_cost(&p->obstacles, box) > 0)
        continue;
      best = middle;
      nearest = from_middle;
    }
  }
  if (nearest == DBL_MAX) return false;
  draw_add_box(&p->obstacles, box_of(best, l->width, 0));
  put_label(p, l, best, 0);
  return true;
}

bool plot_label_line(plot_gaps *gaps, plot *p, plot_style style, const char *text,
                     const plot_point *points, int count) {
  const double long_stub = 12, short_stub = 3;
  track t;
  bool room = false;
  *gaps = (plot_gaps){0};
  if (count < 2) return false;
  if (track_make(&t, p, points, count)) {
    label l = label_of(text);
    gap_rule rule = rule_for(style, l.width);
    *gaps = label_on(p, &l, &t, &rule, long_stub);
    if (gaps->count == 0) *gaps = label_on(p, &l, &t, &rule, short_stub);
    room = gaps->count > 0 || label_beside(p, &l, &t);
  } else {
    p->obstacles.lost = true;
  }
  track_free(&t);
  return room;
}
