// SPDX-License-Identifier: Apache-2.0
// Labels in a plot: at a point, or on a curve where there is room, turned along it.
#include "../draw/escape.h"
#include "plot.h"
#include "plot_frame.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL_FONT = 13 };

static double text_width(const char *text) {
  return 0.64 * LABEL_FONT * draw_count_characters(text); // digits of DejaVu Sans
}

static void put_label(plot *p, const char *text, draw_point middle, double degrees) {
  // wide enough that a dash of the line is not taken for a minus sign
  double width = text_width(text) + 10, height = LABEL_FONT + 2;
  fprintf(p->gaps,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" "
          "transform=\"translate(%.2f %.2f) rotate(%.1f)\"/>\n",
          -0.5 * width, -0.5 * height, width, height, middle.x, middle.y, degrees);
  fprintf(p->labels,
          "<text class=\"on\" text-anchor=\"middle\" transform=\"translate(%.2f %.2f) "
          "rotate(%.1f)\" y=\"%.1f\">",
          middle.x, middle.y, degrees, 0.36 * LABEL_FONT);
  for (; *text == '-'; text++) fputs("\u2212", p->labels);
  draw_put_escaped(p->labels, text);
  fputs("</text>\n", p->labels);
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
  draw_point middle = plot_pixel(p, at);
  draw_add_box(&p->obstacles, box_of(middle, text_width(text), 0));
  put_label(p, text, middle, 0);
}

// A curve in pixels with the length up to each point.
typedef struct track {
  int count;
  draw_point *at;
  double *length;
} track;

static bool track_make(track *out, const plot *p, const plot_point *points, int count) {
  *out = (track){count, calloc((size_t)count, sizeof *out->at),
                 calloc((size_t)count, sizeof *out->length)};
  if (!out->at || !out->length) return false;
  for (int i = 0; i < count; i++) {
    out->at[i] = plot_pixel(p, points[i]);
    if (i > 0) out->length[i] = out->length[i - 1] + draw_distance(out->at[i - 1], out->at[i]);
  }
  return true;
}

static void track_free(track *t) {
  free(t->at);
  free(t->length);
}

static draw_point point_at(const track *t, double length) {
  int low = 0, high = t->count - 1;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (t->length[middle] <= length)
      low = middle;
    else
      high = middle;
  }
  double span = t->length[high] - t->length[low];
  double part = span > 0 ? (length - t->length[low]) / span : 0;
  return (draw_point){t->at[low].x + part * (t->at[high].x - t->at[low].x),
                      t->at[low].y + part * (t->at[high].y - t->at[low].y)};
}

typedef struct label_place {
  draw_point middle;
  double angle, cost; // rad, screen
  draw_box box;
} label_place;

// The place around a length of the curve; cost DBL_MAX where it does not fit.
static label_place place_at(const plot *p, const track *t, double length, double width) {
  draw_point a = point_at(t, length - 0.5 * width), b = point_at(t, length + 0.5 * width);
  draw_point middle = point_at(t, length);
  label_place place = {.middle = middle, .angle = atan2(b.y - a.y, b.x - a.x), .cost = DBL_MAX};
  if (place.angle > M_PI / 2) place.angle -= M_PI;
  if (place.angle < -M_PI / 2) place.angle += M_PI;
  place.box = box_of(middle, width, place.angle);
  double bend = fabs(middle.x - 0.5 * (a.x + b.x)) + fabs(middle.y - 0.5 * (a.y + b.y));
  const double most_bent = 5; // pixels: beyond, the label leaves its curve
  if (!is_in_frame(place.box) || bend > most_bent) return place;
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

// The best place between two lengths of the curve.
static label_place best_place(const plot *p, const track *t, double from, double to, double width) {
  const double step = 5, margin = 0.5 * width + 4; // pixels
  label_place best = {.cost = DBL_MAX};
  for (double s = from + margin; s < to - margin; s += step) {
    label_place place = place_at(p, t, s, width);
    if (place.cost < best.cost) best = place;
  }
  return best;
}

void plot_label_line(plot *p, const char *text, const plot_point *points, int count) {
  const double apart = 420; // pixels: about one label for the width of the frame
  track t;
  if (count < 2) return;
  if (track_make(&t, p, points, count)) {
    double total = t.length[count - 1], width = text_width(text);
    int labels = 1 + (int)(total / apart);
    for (int i = 0; i < labels; i++) {
      // not near the ends of its part, where the next part's label may stand
      double part = total / labels, off = labels > 1 ? 0.15 * part : 0;
      label_place best = best_place(p, &t, part * i + off, part * (i + 1) - off, width);
      if (best.cost == DBL_MAX) continue;
      for (int k = 0; k < square_count(width); k++)
        draw_add_box(&p->obstacles, square_of(best.middle, width, best.angle, k));
      put_label(p, text, best.middle, best.angle * 180 / M_PI);
    }
  } else {
    p->obstacles.lost = true;
  }
  track_free(&t);
}
