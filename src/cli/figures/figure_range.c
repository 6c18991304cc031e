// SPDX-License-Identifier: Apache-2.0
#include "figure_range.h"

#include "range_curve.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

// Limits are followed beyond the frame, so that curves leave it where they really do.
static const double search_beyond = 4;

// The ends of range `index` over samples first .. last - 1, which all have it.
typedef struct strip {
  const range_curve *curve;
  int first, last, index;
  double factor; // to the unit of the axis
} strip;

static plot_point edge_point(const strip *s, int i, int end) {
  const range_sample *sample = &s->curve->samples[i];
  return (plot_point){s->factor * sample->value, sample->ranges[s->index][end]};
}

// A limit is drawn as far as it is one: not where the search ended or the speed is zero.
static void draw_edge(plot *p, const strip *s, int end, double fastest, plot_style style) {
  plot_point *points = calloc((size_t)(s->last - s->first), sizeof *points);
  int count = 0;
  for (int i = s->first; points && i < s->last; i++) {
    plot_point at = edge_point(s, i, end);
    bool limit = at.y > 0 && at.y < fastest;
    if (limit) points[count++] = at;
    if (limit && i + 1 < s->last) continue;
    plot_line(p, style, points, count);
    count = 0;
  }
  if (!points) p->obstacles.lost = true;
  free(points);
}

static void fill_strip(plot *p, const strip *s) {
  int count = s->last - s->first;
  plot_point *points = calloc(2 * (size_t)count, sizeof *points);
  for (int i = 0; points && i < count; i++) {
    points[i] = edge_point(s, s->first + i, 0);
    points[2 * count - 1 - i] = edge_point(s, s->first + i, 1);
  }
  if (points)
    plot_area(p, PLOT_LIGHT, points, 2 * count);
  else
    p->obstacles.lost = true;
  free(points);
}

typedef void strip_function(plot *p, const strip *s, const void *user);

// Calls the function for every run of samples with the same number of ranges, and every range.
static void each_strip(plot *p, const range_curve *curve, double factor, strip_function *function,
                       const void *user) {
  for (int first = 0, i = 1; i <= curve->count; i++) {
    if (i < curve->count && curve->samples[i].count == curve->samples[first].count) continue;
    for (int k = 0; k < curve->samples[first].count; k++) {
      strip s = {curve, first, i, k, factor};
      function(p, &s, user);
    }
    first = i;
  }
}

typedef struct look {
  plot_style style;
  double fastest;
  bool filled;
} look;

static void draw_strip(plot *p, const strip *s, const void *user) {
  const look *how = user;
  if (how->filled) fill_strip(p, s);
  for (int end = 0; end < 2; end++) draw_edge(p, s, end, how->fastest, how->style);
}

static void draw_curves(plot *p, const range_figure *what, const range_curve curves[2]) {
  for (int k = 0; k < 2; k++) {
    look how = {k ? PLOT_HEAVY_DASHED : PLOT_HEAVY, search_beyond * what->fastest, k == 0};
    each_strip(p, &curves[k], what->factor, draw_strip, &how);
  }
}

static bool is_never_stable(const range_curve *curve) {
  for (int i = 0; i < curve->count; i++)
    if (curve->samples[i].count > 0) return false;
  return true;
}

// What is drawn, and nothing else.
static void draw_key(plot *p, const range_figure *what, const range_curve curves[2]) {
  static const plot_style styles[2] = {PLOT_HEAVY, PLOT_HEAVY_DASHED};
  char limits[2][64];
  plot_entry key[3];
  int count = 0;
  if (!is_never_stable(&curves[0]))
    key[count++] = (plot_entry){.is_area = true, .fill = PLOT_LIGHT, .text = "self-stable"};
  for (int k = 0; k < 2; k++) {
    if (is_never_stable(&curves[k])) continue;
    snprintf(limits[k], sizeof limits[k], "limits, %s", what->families[k].label);
    key[count++] = (plot_entry){.style = styles[k], .text = limits[k]};
  }
  if (count > 0) plot_key(p, key, count);
}

// The bicycle as it is: arrows to its value and its limits.
static void draw_present(plot *p, const range_figure *what, const bike_bicycle *bicycle) {
  double now;
  bike_model model;
  bike_critical_speeds found;
  if (bike_variation_value(&now, bicycle, what->families[0].variation) ||
      bike_model_init(&model, bicycle) ||
      bike_upright_critical_speeds(&found, &model, 0, search_beyond * what->fastest))
    return;
  plot_arrow_x(p, what->factor * now);
  for (int i = 0; i < found.range_count; i++)
    for (int end = 0; end < 2; end++)
      if (found.ranges[i][end] > 0) plot_arrow_y(p, found.ranges[i][end]);
}

static void write_table(FILE *csv, const range_figure *what, const range_curve curves[2]) {
  const double fastest = search_beyond * what->fastest;
  fprintf(csv, "%s,%s,stable_from,stable_to\n", what->family_column, what->value_column);
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < curves[k].count; i++) {
      const range_sample *s = &curves[k].samples[i];
      for (int r = 0; r < s->count; r++) {
        fprintf(csv, "%d,%.17g,%.17g,", k, s->value, s->ranges[r][0]);
        if (s->ranges[r][1] < fastest)
          fprintf(csv, "%.17g\n", s->ranges[r][1]);
        else
          fputs("inf\n", csv); // beyond every speed looked at
      }
    }
  }
}

static int make_curves(range_curve curves[2], const range_figure *what, const bike_bicycle *bicycle,
                       term_progress *progress) {
  int code = BIKE_OK;
  for (int k = 0; k < 2 && !code; k++) {
    const range_family *f = &what->families[k];
    code = range_curve_make(&curves[k], bicycle, f->variation, f->hold, &what->values,
                            search_beyond * what->fastest);
    term_progress_show(progress, what->words.name, 0.5 * (k + 1));
  }
  return code;
}

static double fastest_limit(const range_curve curves[2], double search_end) {
  double most = 0;
  for (int k = 0; k < 2; k++)
    for (int i = 0; i < curves[k].count; i++)
      for (int r = 0; r < curves[k].samples[i].count; r++)
        for (int end = 0; end < 2; end++) {
          double limit = curves[k].samples[i].ranges[r][end];
          if (limit < search_end) most = fmax(most, limit);
        }
  return most;
}

// The end of the axis of speed.
static double axis_end(const range_figure *what, const range_curve curves[2]) {
  double most = what->fit ? fastest_limit(curves, search_beyond * what->fastest) : 0;
  return most > 0 ? fmin(what->fastest, ceil(1.4 * most)) : what->fastest;
}

// The figure with its table. False when out of memory.
static bool finish(figure_set *set, const range_figure *what, const range_curve curves[2],
                   plot *p) {
  char caption[FIGURE_CAPTION];
  figure_words words = what->words;
  int length = snprintf(caption, sizeof caption, "%s", words.caption);
  for (int k = 0; k < 2; k++)
    if (is_never_stable(&curves[k]))
      length += snprintf(caption + length, sizeof caption - (size_t)length, " Never stable: %s.",
                         what->families[k].label);
  words.caption = caption;
  FILE *csv = figure_add(set, &words, p);
  if (csv) write_table(csv, what, curves);
  return csv && fclose(csv) == 0;
}

int figure_add_range(figure_set *set, const range_figure *what, term_progress *progress) {
  range_curve curves[2] = {{0}, {0}};
  plot p = {0};
  int code = make_curves(curves, what, set->bicycle, progress);
  plot_axis x = {what->factor * what->values.first, what->factor * what->values.last, what->axis};
  plot_axis y = {0, axis_end(what, curves), {"speed", "v", "", "m/s"}};
  if (!code && !plot_open(&p, &x, &y)) code = BIKE_ERROR_MEMORY;
  if (!code) {
    draw_curves(&p, what, curves);
    draw_present(&p, what, set->bicycle);
    draw_key(&p, what, curves);
    if (!finish(set, what, curves, &p)) code = BIKE_ERROR_MEMORY;
  }
  plot_close(&p);
  for (int k = 0; k < 2; k++) range_curve_free(&curves[k]);
  return code;
}
