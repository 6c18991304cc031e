// SPDX-License-Identifier: Apache-2.0
// Pictures of the studies that a scenario may have: error over step size, error over cost.
#include "report_curves.h"

#include "report_markup.h"
#include "report_plot.h"
#include "report_read.h"

#include <math.h>
#include <string.h>

enum { MOST_POINTS = 64 };

// Points of a study: two members of each object of an array.
typedef struct study {
  double x[MOST_POINTS], y[MOST_POINTS];
  size_t count;
} study;

// Points in the order of x, so that a line through them does not go back.
static void sort(study *s) {
  for (size_t i = 1; i < s->count; i++)
    for (size_t k = i; k > 0 && s->x[k] < s->x[k - 1]; k--) {
      double x = s->x[k], y = s->y[k];
      s->x[k] = s->x[k - 1];
      s->y[k] = s->y[k - 1];
      s->x[k - 1] = x;
      s->y[k - 1] = y;
    }
}

static void load(study *out, const json_t *points, const char *x, const char *y) {
  size_t i;
  const json_t *point;
  out->count = 0;
  json_array_foreach(points, i, point) {
    if (out->count == MOST_POINTS) return;
    out->x[out->count] = report_real(point, x);
    out->y[out->count++] = report_real(point, y);
  }
  sort(out);
}

// The item `index` of an array, or the object itself as item 0.
static const json_t *item(const json_t *block, size_t index) {
  if (json_is_array(block)) return json_array_get(block, index);
  return index == 0 && json_is_object(block) ? block : NULL;
}

static void print_facts(FILE *stream, const json_t *c) {
  char order[REPORT_NUMBER], expected[REPORT_NUMBER], plateau[REPORT_NUMBER],
      uncertainty[REPORT_NUMBER];
  const char *unit = report_text(c, "unit");
  report_markup(stream, "<p class=facts>Observed order <b>%s</b>",
                report_number(order, report_real(c, "order")));
  if (isfinite(report_real(c, "expected_order")))
    report_markup(stream, " (expected %s)",
                  report_number(expected, report_real(c, "expected_order")));
  report_markup(stream, "; plateau, what no smaller step removes: <b>%s</b>, uncertain by %s",
                report_quantity(plateau, report_real(c, "plateau"), unit),
                report_quantity(uncertainty, report_real(c, "uncertainty"), unit));
  if (*report_text(c, "verdict")) report_markup(stream, ": <b>%s</b>", report_text(c, "verdict"));
  fputs(".</p>\n", stream);
}

static void draw_convergence(FILE *stream, const json_t *c) {
  study s;
  char title[128];
  const char *signal = report_text(c, "signal");
  load(&s, json_object_get(c, "points"), "timestep", "error");
  if (s.count == 0) return;
  double plateau = report_real(c, "plateau"), order = report_real(c, "order");
  double expected = report_real(c, "expected_order");
  report_axis x = {"timestep, s", true, NAN, NAN}, y = {"error", true, NAN, NAN};
  report_axis_include(&x, s.x, s.count);
  report_axis_include(&y, s.y, s.count);
  report_axis_include(&y, &plateau, 1);
  snprintf(title, sizeof title, "Convergence%s%.60s%s%.30s", *signal ? " of " : "", signal,
           *report_text(c, "engine") ? ", " : "", report_text(c, "engine"));
  report_plot p = report_plot_begin(stream, title, "error over the size of the step", x, y);
  // The triangle hangs at the largest step; the expected slope, or the observed one.
  size_t top = s.count - 1;
  report_plot_slope(&p, s.x[top], s.y[top], 4, isfinite(expected) ? expected : order);
  report_plot_level(&p, "limit", plateau, "plateau");
  report_plot_line(&p, "cand", s.x, s.y, s.count);
  report_plot_dots(&p, "cand", s.x, s.y, s.count);
  report_plot_end(&p);
}

void report_curves_convergence(FILE *stream, const json_t *entry) {
  const json_t *block = json_object_get(entry, "convergence"), *c;
  if (!item(block, 0)) return;
  fputs("<h3>Convergence</h3>\n<div class=plots>\n", stream);
  for (size_t i = 0; (c = item(block, i)); i++) draw_convergence(stream, c);
  fputs("</div>\n", stream);
  for (size_t i = 0; (c = item(block, i)); i++) print_facts(stream, c);
}

// Engines take the line styles in the order in which they come.
static const char *style_of(size_t index) {
  static const char *const styles[] = {"ref", "cand", "third", "fourth"};
  return styles[index % 4];
}

static void print_legend(FILE *stream, const json_t *block) {
  const json_t *c;
  fputs("<p class=legend>", stream);
  for (size_t i = 0; (c = item(block, i)); i++)
    report_markup(stream, "<span class=%s>%s%s%s</span> ", style_of(i), report_text(c, "engine"),
                  *report_text(c, "label") ? " " : "", report_text(c, "label"));
  fputs("</p>\n", stream);
}

// Points of an engine: cost in right-hand sides, which the same program needs on every machine,
// from the block "cost": [{engine, label, points: [{cost, error}]}].
static void load_evaluations(study *out, const comparison *c, const json_t *player, int side) {
  (void)c;
  (void)side;
  load(out, json_object_get(player, "points"), "cost", "error");
}

static void add_point(study *s, double x, double y) {
  if (s->count == MOST_POINTS) return;
  s->x[s->count] = x;
  s->y[s->count++] = y;
}

// The same points with what they took on this machine; in the document that stands among timings.
static void load_seconds(study *out, const comparison *c, const json_t *player, int side) {
  const study_cost *cost = &c->study.cost;
  const study_convergence *convergence = &c->study.convergence;
  (void)player;
  out->count = 0;
  for (int i = 0; i < cost->count; i++)
    if (cost->run[i].side == side) add_point(out, cost->run[i].cpu, cost->run[i].error);
  for (int i = 0; side == CANDIDATE && i < convergence->count; i++)
    add_point(out, convergence->point[i].cpu_time, convergence->point[i].error[0]);
  sort(out);
}

typedef void load_points(study *out, const comparison *c, const json_t *player, int side);

static void draw_cost(FILE *stream, const comparison *c, const json_t *block, load_points *points,
                      const char *title, const char *label) {
  const json_t *player;
  report_axis x = {label, true, NAN, NAN}, y = {"error", true, NAN, NAN};
  study s;
  size_t total = 0;
  for (int i = 0; (player = item(block, (size_t)i)); i++) {
    points(&s, c, player, i);
    report_axis_include(&x, s.x, s.count);
    report_axis_include(&y, s.y, s.count);
    total += s.count;
  }
  if (total == 0) return;
  report_plot p = report_plot_begin(stream, title, title, x, y);
  for (int i = 0; (player = item(block, (size_t)i)); i++) {
    points(&s, c, player, i);
    report_plot_line(&p, style_of((size_t)i), s.x, s.y, s.count);
    report_plot_dots(&p, style_of((size_t)i), s.x, s.y, s.count);
  }
  report_plot_end(&p);
}

void report_curves_cost(FILE *stream, const comparison *c, const json_t *entry) {
  const json_t *block = json_object_get(entry, "cost");
  if (!item(block, 0)) return;
  fputs("<h3>Work and precision</h3>\n<div class=plots>\n", stream);
  draw_cost(stream, c, block, load_evaluations, "Error over evaluations",
            "right-hand sides evaluated");
  draw_cost(stream, c, block, load_seconds, "Error over processor time, on this machine",
            "processor time, s");
  fputs("</div>\n", stream);
  print_legend(stream, block);
}
