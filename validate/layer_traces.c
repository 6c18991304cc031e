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
// Times and differences (candidate - reference) of one signal.
typedef struct residual {
  double *time, *error;
  size_t count;
  size_t first; // row of the trace at which they begin
} residual;

static residual part_of(const comparison *c, const residual *r, double from, double to) {
  residual part = *r;
  double sample = c->scenario->sample;
  for (; part.count > 0 && !gate_covers(from, 0, *part.time, sample); part.count--)
    part.time++, part.error++, part.first++;
  while (part.count > 0 && !gate_covers(0, to, part.time[part.count - 1], sample)) part.count--;
  return part;
}

static void add(comparison *c, const char *signal, const char *metric, const char *unit,
                metrics_peak peak) {
  measurement m = measurement_of(layer_traces.name, signal, metric, unit);
  m.value = peak.value;
  m.time = peak.time;
  measurement_add(&c->measurements, &m);
}

//---------------------------------- metrics -------------------------------------------------------

// Of a part of the ride with a row at least. `signal` is NULL of a force, `rule` where none asks.
typedef metrics_peak metric_function(comparison *c, const residual *part,
                                     const trace_signal *signal, const gate_rule *rule);

static metrics_peak find_max(comparison *c, const residual *part, const trace_signal *signal,
                             const gate_rule *rule) {
  (void)c, (void)signal, (void)rule;
  return metrics_max(part->time, part->error, part->count);
}

static metrics_peak find_scaled_max(comparison *c, const residual *part, const trace_signal *signal,
                                    const gate_rule *rule) {
  (void)signal, (void)rule;
  return metrics_scaled_max(part->time, part->error, part->count, c->growth_rate);
}

static metrics_peak find_rmse(comparison *c, const residual *part, const trace_signal *signal,
                              const gate_rule *rule) {
  (void)c, (void)signal, (void)rule;
  return (metrics_peak){metrics_rms(part->error, part->count), NAN};
}

static metrics_peak find_end(comparison *c, const residual *part, const trace_signal *signal,
                             const gate_rule *rule) {
  (void)c, (void)signal, (void)rule;
  size_t last = part->count - 1;
  return (metrics_peak){fabs(part->error[last]), part->time[last]};
}

static metrics_peak find_start(comparison *c, const residual *part, const trace_signal *signal,
                               const gate_rule *rule) {
  (void)c, (void)signal, (void)rule;
  return (metrics_peak){fabs(part->error[0]), part->time[0]};
}

// Root mean square over what the signal does: its range, or where that is less the nominal size
// below which nobody looks: the rule's, or 1 cm, 1 cm/s or half a degree.
static metrics_peak find_nrmse(comparison *c, const residual *part, const trace_signal *signal,
                               const gate_rule *rule) {
  static const double nominal = 0.01;
  double low = INFINITY, high = -INFINITY;
  for (size_t k = 0; k < part->count; k++) {
    double value = trace_value(&c->side[REFERENCE].trace.rows[part->first + k], signal);
    low = fmin(low, value), high = fmax(high, value);
  }
  double size = fmax(high - low, rule && rule->nominal > 0 ? rule->nominal : nominal);
  return (metrics_peak){metrics_rms(part->error, part->count) / size, NAN};
}

// How far the candidate leaves the tube about the reference whose half width in time is the rule's;
// the half width in value is its limit.
static metrics_peak find_tube(comparison *c, const residual *part, const trace_signal *signal,
                              const gate_rule *rule) {
  metrics_peak peak = {NAN, NAN};
  double *a = calloc(part->count, sizeof *a), *b = calloc(part->count, sizeof *b);
  for (size_t k = 0; a && b && k < part->count; k++) {
    a[k] = trace_value(&c->side[REFERENCE].trace.rows[part->first + k], signal);
    b[k] = trace_value(&c->side[CANDIDATE].trace.rows[part->first + k], signal);
  }
  if (a && b)
    peak = metrics_tube(part->time, a, b, part->count, rule->time_tolerance);
  else
    c->measurements.lost = true;
  free(a);
  free(b);
  return peak;
}

static const struct {
  const char *name;
  metric_function *find;
  bool of_values;  // of a signal's values, which a force has not here
  bool on_request; // only where a rule asks
  bool relative;   // a pure number
} metrics[] = {
    {"max", find_max, false, false, false},    {"scaled_max", find_scaled_max, false, false, false},
    {"rmse", find_rmse, false, false, false},  {"end", find_end, false, false, false},
    {"nrmse", find_nrmse, true, false, true},  {"tube", find_tube, true, true, false},
    {"start", find_start, true, false, false},
};
enum { METRIC_COUNT = sizeof metrics / sizeof *metrics };

//---------------------------------- signals -------------------------------------------------------

// One signal: `of` is NULL for a force.
typedef struct subject {
  const char *name, *unit;
  const trace_signal *of;
} subject;

// A metric of a part of the ride, which without a row is no success.
static void measure_part(comparison *c, const residual *r, const subject *s, int metric,
                         double from, double to) {
  measurement m = measurement_of(layer_traces.name, s->name, metrics[metric].name,
                                 metrics[metric].relative ? "" : s->unit);
  m.from = from;
  m.to = to;
  const gate_rule *rule = gate_rule_for(&m, &c->scenario->rules);
  residual part = part_of(c, r, from, to);
  if (!rule && metrics[metric].on_request) return;
  if (part.count > 0) {
    metrics_peak peak = metrics[metric].find(c, &part, s->of, rule);
    m.value = peak.value;
    m.time = peak.time;
  } else if (from > 0 || to > 0) {
    measurement_detail(&m, "no comparable row from %g s on within the window", from);
  }
  measurement_add(&c->measurements, &m);
}

// Whether an earlier rule has asked for the same part.
static bool is_repeated(const gate_rules *rules, size_t index, const measurement *m) {
  for (size_t i = 0; i < index; i++)
    if (gate_rule_names(&rules->items[i], m) && rules->items[i].from == rules->items[index].from &&
        rules->items[i].to == rules->items[index].to)
      return true;
  return false;
}

// Of the whole ride, and of each part of it for which there is a rule.
static void measure_metric(comparison *c, const residual *r, const subject *s, int metric) {
  const gate_rules *rules = &c->scenario->rules;
  const measurement m = measurement_of(layer_traces.name, s->name, metrics[metric].name, "");
  measure_part(c, r, s, metric, 0, 0);
  for (size_t i = 0; i < rules->count; i++) {
    const gate_rule *rule = &rules->items[i];
    if ((rule->from > 0 || rule->to > 0) && gate_rule_names(rule, &m) && !is_repeated(rules, i, &m))
      measure_part(c, r, s, metric, rule->from, rule->to);
  }
}

// What is judged is as much of a ride as can be predicted; the rest is told.
static void sum_up(comparison *c, const residual *r, const subject *s) {
  size_t all = comparison_rows(c);
  for (int i = 0; i < METRIC_COUNT; i++)
    if (s->of || !metrics[i].of_values) measure_metric(c, r, s, i);
  if (all > r->count)
    add(c, s->name, "beyond_horizon", s->unit,
        metrics_max(r->time + r->count, r->error + r->count, all - r->count));
}

static void compare_signal(comparison *c, residual *r, const trace_signal *signal) {
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  if (!trace_has(a, signal) || !trace_has(b, signal)) return;
  for (size_t k = 0; k < comparison_rows(c); k++)
    r->error[k] = trace_value(&b->rows[k], signal) - trace_value(&a->rows[k], signal);
  sum_up(c, r, &(subject){signal->name, signal->unit, signal});
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
  sum_up(c, r, &(subject){forces[wheel], "", NULL});
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
    const char *what = t->complete ? "the whole ride" : trace_ending(t);
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
    compare_shape(c, &r, "lean", "lean_rate", &c->study.shift[0]);
    compare_shape(c, &r, "steer", "steer_rate", &c->study.shift[1]);
  } else {
    code = problem_memory(p);
  }
  free(r.time);
  free(r.error);
  return code;
}

static bool knows(const char *signal, const char *metric) {
  if (strcmp(metric, "difference") == 0) return !signal || strcmp(signal, "end_time") == 0;
  for (int i = 0; i < METRIC_COUNT; i++)
    if (strcmp(metrics[i].name, metric) == 0)
      return !signal || layer_names(compared, signal) ||
             (layer_names(forces, signal) && !metrics[i].of_values);
  return false;
}

// What both sides have is compared, judged or not.
static bool needs(const comparison *c, const trace_signal *signal, size_t row) {
  const comparison_side *a = &c->side[REFERENCE], *b = &c->side[CANDIDATE];
  if (row >= comparison_rows(c)) return false;
  for (int i = 0; forces[i]; i++)
    if (strncmp(signal->name, forces[i], strlen(forces[i])) == 0)
      return has_force(a, i) && has_force(b, i);
  return layer_names(compared, signal->name) && trace_has(&a->trace, signal) &&
         trace_has(&b->trace, signal);
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
    .failure = "the rides differ",
    .knows = knows,
    .needs = needs,
    .measure = measure,
    .rules = rules,
    .rule_count = sizeof rules / sizeof rules[0],
};
