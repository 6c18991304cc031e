// SPDX-License-Identifier: Apache-2.0
// L2: the rides of both engines, signal by signal, at the same times.
#include "layer.h"

#include "metrics.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const compared[] = {"lean",  "steer",      "lean_rate",   "steer_rate",
                                       "speed", "yaw",        "x",           "y",
                                       "pitch", "rear_angle", "front_angle", NULL};
static const char *const forces[] = {"rear_force", "front_force", NULL};
static const char *const metrics[] = {"max", "scaled_max", "rmse", "end", NULL};

// Times and differences (candidate - reference) of one signal.
typedef struct residual {
  double *time, *error;
  size_t count;
} residual;

static void add(comparison *c, const char *signal, const char *metric, const char *unit,
                metrics_peak peak) {
  measurement m = measurement_of(layer_traces.name, signal, metric, unit);
  m.value = peak.value;
  m.time = peak.time;
  measurement_add(&c->measurements, &m);
}

static void sum_up(comparison *c, const residual *r, const char *signal, const char *unit) {
  size_t n = r->count;
  add(c, signal, "max", unit, metrics_max(r->time, r->error, n));
  add(c, signal, "scaled_max", unit, metrics_scaled_max(r->time, r->error, n, c->growth_rate));
  add(c, signal, "rmse", unit, (metrics_peak){metrics_rms(r->error, n), NAN});
  add(c, signal, "end", unit,
      n ? (metrics_peak){fabs(r->error[n - 1]), r->time[n - 1]} : (metrics_peak){NAN, NAN});
}

static void compare_signal(comparison *c, residual *r, const trace_signal *signal) {
  for (size_t k = 0; k < r->count; k++)
    r->error[k] = trace_value(&c->side[CANDIDATE].trace.rows[k], signal) -
                  trace_value(&c->side[REFERENCE].trace.rows[k], signal);
  sum_up(c, r, signal->name, signal->unit);
}

static const double *force_of(const comparison_side *side, size_t row, int wheel) {
  const bike_sample_more *more = &side->trace.rows[row].more;
  return wheel == 0 ? more->rear_force : more->front_force;
}

// |F - F_reference| over the total weight
static void compare_force(comparison *c, residual *r, int wheel) {
  for (size_t k = 0; k < r->count; k++) {
    const double *a = force_of(&c->side[REFERENCE], k, wheel);
    const double *b = force_of(&c->side[CANDIDATE], k, wheel);
    double sum = 0;
    for (int i = 0; i < 3; i++) sum += (b[i] - a[i]) * (b[i] - a[i]);
    r->error[k] = sqrt(sum) / c->weight;
  }
  sum_up(c, r, forces[wheel], "");
}

// How a ride ended, for the message.
static void describe_ends(measurement *m, const comparison *c) {
  char end[2][96];
  for (int i = 0; i < 2; i++) {
    const trace *t = &c->side[i].trace;
    const char *what = t->complete ? "the whole ride" : bike_event_string(t->end_event.kind);
    snprintf(end[i], sizeof end[i], "%s to %.9g s (%.40s)", c->side[i].label, t->end_time, what);
  }
  measurement_detail(m, "%s, %s", end[0], end[1]);
}

// The time by which the ends of the two rides differ; NaN if they ended in different ways.
static void compare_ends(comparison *c) {
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  measurement m = measurement_of(layer_traces.name, "end_time", "difference", "s");
  if (a->complete && b->complete)
    m.value = 0;
  else if (!a->complete && !b->complete && a->end_event.kind == b->end_event.kind)
    m.value = fabs(b->end_event.time - a->end_event.time);
  if (!a->complete || !b->complete) describe_ends(&m, c);
  measurement_add(&c->measurements, &m);
}

static term_exit measure(comparison *c, problem *p) {
  term_exit code = comparison_ride(c, p);
  if (code != TERM_DONE) return code;
  size_t count = comparison_rows(c);
  residual r = {calloc(count + 1, sizeof(double)), calloc(count + 1, sizeof(double)), count};
  if (r.time && r.error) {
    compare_ends(c);
    for (size_t k = 0; k < count; k++) r.time[k] = c->side[REFERENCE].trace.rows[k].sample.time;
    for (int i = 0; compared[i]; i++) compare_signal(c, &r, trace_find_signal(compared[i]));
    for (int i = 0; forces[i]; i++) compare_force(c, &r, i);
  } else {
    code = problem_memory(p);
  }
  free(r.time);
  free(r.error);
  return code;
}

static bool knows(const char *signal, const char *metric) {
  if (strcmp(metric, "difference") == 0) return !signal || strcmp(signal, "end_time") == 0;
  return layer_names(metrics, metric) &&
         (!signal || layer_names(compared, signal) || layer_names(forces, signal));
}

// Events are located within a step of some milliseconds, by interpolation.
static const gate_rule rules[] = {
    {.metric = "difference",
     .signals = {"end_time"},
     .signal_count = 1,
     .limit = 1e-3,
     .reason = "both rides end in the same way and, if an event ends them, at the same time to "
               "within one integration step"},
};

const layer layer_traces = {
    .name = "L2",
    .title = "traces",
    .failure = "the engines agree on instants, but not on the ride: the integration or the start "
               "differs",
    .knows = knows,
    .measure = measure,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};
