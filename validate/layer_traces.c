// SPDX-License-Identifier: Apache-2.0
// L2: the rides of both engines, signal by signal, at the same times.
#include "layer.h"

#include "gate.h"
#include "metrics.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const compared[] = {"lean",  "steer",      "lean_rate",   "steer_rate",
                                       "speed", "yaw",        "x",           "y",
                                       "pitch", "rear_angle", "front_angle", NULL};
static const char *const forces[] = {"rear_force", "front_force", NULL};
static const char *const metrics[] = {"max", "scaled_max", "rmse", "nrmse", "end", "tube", NULL};

// Times and differences (candidate - reference) of one signal.
typedef struct residual {
  double *time, *error;
  size_t count;
  size_t first; // row of the trace at which they begin
} residual;

static const gate_rule *rule_of(const comparison *c, const char *signal, const char *metric) {
  measurement m = measurement_of(layer_traces.name, signal, metric, "");
  return gate_rule_for(&m, &c->scenario->rules);
}

// What of a residual lies within the window of the metric's rule. Rows are at k sample, which is
// not to the last digit what people write: a millionth of a row is no difference.
static residual windowed(const comparison *c, const residual *r, const char *signal,
                         const char *metric) {
  residual part = *r;
  const gate_rule *rule = rule_of(c, signal, metric);
  if (!rule) return part;
  double slack = 1e-6 * c->scenario->sample;
  for (; part.count > 0 && *part.time < rule->from - slack; part.count--)
    part.time++, part.error++, part.first++;
  while (rule->to > 0 && part.count > 0 && part.time[part.count - 1] > rule->to + slack)
    part.count--;
  return part;
}

static void add(comparison *c, const char *signal, const char *metric, const char *unit,
                metrics_peak peak) {
  measurement m = measurement_of(layer_traces.name, signal, metric, unit);
  m.value = peak.value;
  m.time = peak.time;
  measurement_add(&c->measurements, &m);
}

// The same of a part of the ride, which without a row is no success.
static void add_part(comparison *c, const residual *part, const char *signal, const char *metric,
                     const char *unit, metrics_peak peak) {
  measurement m = measurement_of(layer_traces.name, signal, metric, unit);
  m.value = part->count ? peak.value : NAN;
  m.time = part->count ? peak.time : NAN;
  const gate_rule *rule = rule_of(c, signal, metric);
  if (!part->count && rule && (rule->from > 0 || rule->to > 0))
    measurement_detail(&m, "no comparable row from %g s on within the window", rule->from);
  measurement_add(&c->measurements, &m);
}

static void sum_up(comparison *c, const residual *r, const char *signal, const char *unit) {
  residual p = windowed(c, r, signal, "max");
  add_part(c, &p, signal, "max", unit, metrics_max(p.time, p.error, p.count));
  p = windowed(c, r, signal, "scaled_max");
  add_part(c, &p, signal, "scaled_max", unit,
           metrics_scaled_max(p.time, p.error, p.count, c->growth_rate));
  p = windowed(c, r, signal, "rmse");
  add_part(c, &p, signal, "rmse", unit, (metrics_peak){metrics_rms(p.error, p.count), NAN});
  p = windowed(c, r, signal, "end");
  size_t last = p.count ? p.count - 1 : 0;
  metrics_peak end = {NAN, NAN};
  if (p.count) end = (metrics_peak){fabs(p.error[last]), p.time[last]};
  add_part(c, &p, signal, "end", unit, end);
}

// What is judged is as much of a ride as can be predicted; the rest is told.
static void tell_of_rest(comparison *c, const residual *r, const char *signal, const char *unit,
                         size_t all) {
  if (all > r->count)
    add(c, signal, "beyond_horizon", unit,
        metrics_max(r->time + r->count, r->error + r->count, all - r->count));
}

// Root mean square over what the signal does: its range, or where that is less the nominal size
// below which nobody looks: the rule's, or 1 cm, 1 cm/s or half a degree.
static void add_nrmse(comparison *c, const residual *r, const trace_signal *signal) {
  static const double nominal = 0.01;
  const gate_rule *rule = rule_of(c, signal->name, "nrmse");
  residual p = windowed(c, r, signal->name, "nrmse");
  double low = INFINITY, high = -INFINITY;
  for (size_t k = 0; k < p.count; k++) {
    double value = trace_value(&c->side[REFERENCE].trace.rows[p.first + k], signal);
    low = fmin(low, value), high = fmax(high, value);
  }
  double size = fmax(high - low, rule && rule->nominal > 0 ? rule->nominal : nominal);
  add_part(c, &p, signal->name, "nrmse", "",
           (metrics_peak){metrics_rms(p.error, p.count) / size, NAN});
}

// How far the candidate leaves the tube about the reference whose half width in time is the rule's;
// the half width in value is its limit. Only where a rule asks.
static void add_tube(comparison *c, const residual *r, const trace_signal *signal) {
  const gate_rule *rule = rule_of(c, signal->name, "tube");
  if (!rule) return;
  residual p = windowed(c, r, signal->name, "tube");
  double *a = calloc(p.count + 1, sizeof *a), *b = calloc(p.count + 1, sizeof *b);
  for (size_t k = 0; a && b && k < p.count; k++) {
    a[k] = trace_value(&c->side[REFERENCE].trace.rows[p.first + k], signal);
    b[k] = trace_value(&c->side[CANDIDATE].trace.rows[p.first + k], signal);
  }
  if (a && b)
    add_part(c, &p, signal->name, "tube", signal->unit,
             metrics_tube(p.time, a, b, p.count, rule->time_tolerance));
  else
    c->measurements.lost = true;
  free(a);
  free(b);
}

static void compare_signal(comparison *c, residual *r, const trace_signal *signal) {
  size_t all = comparison_rows(c);
  if (!trace_has(&c->side[REFERENCE].trace, signal) ||
      !trace_has(&c->side[CANDIDATE].trace, signal))
    return;
  for (size_t k = 0; k < all; k++)
    r->error[k] = trace_value(&c->side[CANDIDATE].trace.rows[k], signal) -
                  trace_value(&c->side[REFERENCE].trace.rows[k], signal);
  sum_up(c, r, signal->name, signal->unit);
  add_nrmse(c, r, signal);
  add_tube(c, r, signal);
  tell_of_rest(c, r, signal->name, signal->unit, all);
}

// All components of the force on a wheel.
static bool has_force(const comparison_side *side, int wheel) {
  size_t length = strlen(forces[wheel]);
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++)
    if (strncmp(trace_signals[i].name, forces[wheel], length) == 0 &&
        !trace_has(&side->trace, &trace_signals[i]))
      return false;
  return true;
}

static const double *force_of(const comparison_side *side, size_t row, int wheel) {
  const bike_sample_more *more = &side->trace.rows[row].more;
  return wheel == 0 ? more->rear_force : more->front_force;
}

// |F - F_reference| over the total weight
static void compare_force(comparison *c, residual *r, int wheel) {
  for (size_t k = 0; k < comparison_rows(c); k++) {
    const double *a = force_of(&c->side[REFERENCE], k, wheel);
    const double *b = force_of(&c->side[CANDIDATE], k, wheel);
    double sum = 0;
    for (int i = 0; i < 3; i++) sum += (b[i] - a[i]) * (b[i] - a[i]);
    r->error[k] = sqrt(sum) / c->weight;
  }
  sum_up(c, r, forces[wheel], "");
  tell_of_rest(c, r, forces[wheel], "", comparison_rows(c));
}

// When a ride ended, s. A complete one of an engine that rounds ends with the scenario.
static double end_of(const comparison *c, const trace *t) {
  return t->complete ? c->scenario->duration : t->end_event.time;
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

// The time by which the ends of the two rides differ, whatever ended them: the analytic model ends
// where its coordinates do ("end of the model's validity"), MuJoCo's rides on there, and how much
// longer is what is measured.
static void compare_ends(comparison *c) {
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  measurement m = measurement_of(layer_traces.name, "end_time", "difference", "s");
  m.value = fabs(end_of(c, b) - end_of(c, a));
  if (c->study.horizon.asked && fmin(a->end_time, b->end_time) > c->study.horizon.time)
    m.value = 0; // what cannot be predicted is not judged
  if (!a->complete || !b->complete) describe_ends(&m, c);
  measurement_add(&c->measurements, &m);
}

// Time shift and amplitude ratio of an angle whose rate is a signal too.
static void compare_shape(comparison *c, residual *r, const char *name, const char *rate_name,
                          study_shift *shift) {
  const trace_signal *signal = trace_find_signal(name), *rate = trace_find_signal(rate_name);
  const comparison_side *a = &c->side[REFERENCE], *b = &c->side[CANDIDATE];
  if (!trace_has(&a->trace, rate) || !trace_has(&a->trace, signal) || !trace_has(&b->trace, signal))
    return;
  double *rates = calloc(r->count + 1, sizeof *rates), ab = 0, aa = 0;
  for (size_t k = 0; rates && k < r->count; k++) {
    double is = trace_value(&a->trace.rows[k], signal),
           has = trace_value(&b->trace.rows[k], signal);
    r->error[k] = has - is;
    rates[k] = trace_value(&a->trace.rows[k], rate);
    ab += is * has;
    aa += is * is;
  }
  if (rates) {
    // All rides start alike, late ones too: the first row says nothing.
    size_t first = r->count > 0;
    metrics_time_shift(&shift->time, &shift->share, r->error + first, rates + first,
                       r->count - first);
    add(c, name, "time_shift", "s", (metrics_peak){shift->time, NAN});
    add(c, name, "amplitude_ratio", "", (metrics_peak){ab / aa, NAN});
  }
  free(rates);
}

static term_exit measure(comparison *c, problem *p) {
  term_exit code = comparison_ride(c, p);
  if (code != TERM_DONE) return code;
  size_t count = comparison_rows(c);
  residual r = {calloc(count + 1, sizeof(double)), calloc(count + 1, sizeof(double)),
                comparison_judged_rows(c), 0};
  if (r.time && r.error) {
    compare_ends(c);
    for (size_t k = 0; k < count; k++) r.time[k] = c->side[REFERENCE].trace.rows[k].sample.time;
    for (int i = 0; compared[i]; i++) compare_signal(c, &r, trace_find_signal(compared[i]));
    for (int i = 0; forces[i]; i++)
      if (has_force(&c->side[REFERENCE], i) && has_force(&c->side[CANDIDATE], i))
        compare_force(c, &r, i);
    study_shift steer;
    compare_shape(c, &r, "steer", "steer_rate", &steer);
    compare_shape(c, &r, "lean", "lean_rate", &c->study.shift);
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
     .reason = "both rides end at the same time to within one integration step, be it with the "
               "scenario or by an event; the detail names what ended them"},
};

const layer layer_traces = {
    .name = "L2",
    .title = "traces",
    .agreed = "the rides agree",
    .failure = "the rides differ: the integration or the start does",
    .knows = knows,
    .measure = measure,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};
