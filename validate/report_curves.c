// SPDX-License-Identifier: Apache-2.0
#include "report_curves.h"

#include "report_plot.h"
#include "report_read.h"
#include "report_series.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST_LINES = 4 };

// A picture of some lines over time.
typedef struct picture {
  const char *title, *description, *label;
  bool log;
  int count;
  report_series time[MOST_LINES], line[MOST_LINES]; // taken over
  const char *style[MOST_LINES];
  report_series limit; // over time[0]; empty without
  double floor;        // of rounding; 0 without
  double horizon;      // s  up to where the ride can be predicted; 0: nobody asked
} picture;

static void add(picture *p, const char *style, report_series time, report_series line) {
  p->time[p->count] = time;
  p->line[p->count] = line;
  p->style[p->count++] = style;
}

// Sizes below 1e-18 say no more than zero does, and would only stretch the axis.
static const double smallest_shown = 1e-18;

static void take_sizes(report_series *s) {
  for (size_t k = 0; k < s->count; k++)
    s->value[k] = fabs(s->value[k]) < smallest_shown ? 0 : fabs(s->value[k]);
}

static bool is_whole(const picture *p) {
  for (int i = 0; i < p->count; i++)
    if (!p->time[i].value || !p->line[i].value) return false;
  return true;
}

static void clear(picture *p) {
  for (int i = 0; i < p->count; i++) {
    report_series_clear(&p->time[i]);
    report_series_clear(&p->line[i]);
  }
  report_series_clear(&p->limit);
}

static void draw(FILE *stream, picture *p) {
  report_axis x = {"time, s", false, NAN, NAN}, y = {p->label, p->log, NAN, NAN};
  for (int i = 0; i < p->count; i++) {
    if (p->log) take_sizes(&p->line[i]);
    report_axis_include(&x, p->time[i].value, p->time[i].count);
    report_axis_include(&y, p->line[i].value, p->line[i].count);
  }
  report_axis_include(&y, p->limit.value, p->limit.count);
  report_axis_include(&y, &p->floor, p->floor > 0);
  report_plot plot = report_plot_begin(stream, p->title, p->description, x, y);
  if (p->floor > 0) report_plot_level(&plot, "floor", p->floor, "rounding");
  if (p->limit.count)
    report_plot_line(&plot, "limit", p->time[0].value, p->limit.value, p->limit.count);
  for (int i = 0; i < p->count; i++)
    report_plot_line(&plot, p->style[i], p->time[i].value, p->line[i].value, p->line[i].count);
  if (p->horizon > 0) report_plot_mark(&plot, "horizon", p->horizon, "horizon");
  report_plot_end(&plot);
}

static bool finish(FILE *stream, picture *p) {
  bool whole = is_whole(p);
  if (whole) draw(stream, p);
  clear(p);
  return whole;
}

// The gate of a signal and metric; limit NaN where there is none.
static report_gate gate_of(const json_t *entry, const char *signal, const char *metric) {
  for (size_t i = 0; i < report_count(entry, "gates"); i++) {
    report_gate g = report_gate_at(entry, i);
    if (strcmp(g.signal, signal) == 0 && strcmp(g.metric, metric) == 0) return g;
  }
  return (report_gate){.limit = NAN};
}

// Lowers a limit over time to that of a gate, in the part of the ride that it judges.
static void lower(report_series *limit, const comparison *c, const report_gate *g, double growth) {
  const trace_row *rows = c->side[REFERENCE].trace.rows;
  for (size_t k = 0; k < limit->count; k++) {
    double time = rows[k].sample.time;
    if (gate_covers(g->from, g->to, time, c->scenario->sample))
      limit->value[k] = fmin(limit->value[k], g->limit * exp(growth * time)); // fmin skips a NaN
  }
}

// The limit of a signal over time, NaN where nothing is judged; that of an unstable ride grows.
static report_series limit_of(const comparison *c, const json_t *entry, const char *signal) {
  report_series s = report_series_time(c, REFERENCE);
  bool any = false;
  for (size_t k = 0; k < s.count; k++) s.value[k] = NAN;
  for (size_t i = 0; i < report_count(entry, "gates"); i++) {
    report_gate g = report_gate_at(entry, i);
    bool plain = strcmp(g.metric, "max") == 0, scaled = strcmp(g.metric, "scaled_max") == 0;
    if (strcmp(g.signal, signal) != 0 || (!plain && !scaled)) continue;
    lower(&s, c, &g, scaled ? c->growth_rate : 0);
    any = true;
  }
  if (!any) report_series_clear(&s);
  return s;
}

static bool draw_signal(FILE *stream, const comparison *c, const char *title, const char *label,
                        const char *name) {
  picture p = {.title = title, .description = title, .label = label};
  const trace_signal *signal = trace_find_signal(name);
  static const char *const styles[] = {"ref", "cand"};
  for (int i = 0; i < 2; i++)
    add(&p, styles[i], report_series_time(c, i), report_series_of(c, i, signal));
  return finish(stream, &p);
}

static bool draw_residual(FILE *stream, const comparison *c, const json_t *entry, const char *title,
                          const char *label, const char *name) {
  picture p = {.title = title, .description = title, .label = label, .log = true};
  const trace_signal *signal = trace_find_signal(name);
  report_series value = report_series_of(c, REFERENCE, signal);
  double low = 0, high = 0;
  report_series_range(&value, &low, &high);
  p.floor = DBL_EPSILON * fmax(fabs(low), fabs(high));
  report_series_clear(&value);
  add(&p, "diff", report_series_time(c, REFERENCE), report_series_residual(c, signal));
  p.limit = limit_of(c, entry, name);
  p.horizon = report_real(json_object_get(entry, "horizon"), "time");
  return finish(stream, &p);
}

static bool draw_energy(FILE *stream, const comparison *c, const json_t *entry) {
  picture p = {.title = "Energy balance of each engine, of the energy at the start",
               .description = "energy not accounted for, over time",
               .label = "|E - E0 - work| / E0",
               .log = true,
               .floor = DBL_EPSILON};
  static const char *const styles[] = {"ref", "cand"};
  for (int i = 0; i < 2; i++)
    add(&p, styles[i], report_series_time(c, i), report_series_balance(c, i));
  char signal[64];
  snprintf(signal, sizeof signal, "%s.energy", c->side[CANDIDATE].label);
  double limit = gate_of(entry, signal, "balance_max").limit;
  if (!isnan(limit)) p.limit = report_series_time(c, REFERENCE);
  for (size_t k = 0; k < p.limit.count; k++) p.limit.value[k] = limit;
  return finish(stream, &p);
}

static bool draw_contacts(FILE *stream, const comparison *c) {
  picture p = {.title = "Violated constraints: slip (m/s) and height (m) of the wheels",
               .description = "slip and height of both wheels over time",
               .label = "slip, m/s; height, m",
               .log = true};
  static const char *const names[] = {"rear_slip", "front_slip", "rear_height", "front_height"};
  static const char *const styles[] = {"ref", "cand", "third", "fourth"};
  int side = c->side[CANDIDATE].trace.has_contacts ? CANDIDATE : REFERENCE;
  if (!c->side[side].trace.has_contacts) return true;
  for (int i = 0; i < MOST_LINES; i++)
    if (trace_has(&c->side[side].trace, trace_find_signal(names[i])))
      add(&p, styles[i], report_series_time(c, side),
          report_series_of(c, side, trace_find_signal(names[i])));
  return finish(stream, &p);
}

bool report_curves(FILE *stream, const comparison *c, const json_t *entry) {
  return draw_signal(stream, c, "Lean", "lean, rad", "lean") &&
         draw_signal(stream, c, "Steer", "steer, rad", "steer") &&
         draw_residual(stream, c, entry, "Difference in lean", "|difference|, rad", "lean") &&
         draw_residual(stream, c, entry, "Difference in steer", "|difference|, rad", "steer") &&
         draw_energy(stream, c, entry) && draw_contacts(stream, c);
}
