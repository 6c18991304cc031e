// SPDX-License-Identifier: Apache-2.0
// Two twins of the reference, its lean disturbed at the start:
// - by one unit of rounding of 1 rad, which is what each step of any engine may lose. Where this
//   twin has used up a share of a limit, the other engine may have used up as much, and soon all.
// - by enough for its growth to be seen above the rounding: its exponent.
#include "horizon.h"

#include "terminal/message.h"

#include <bicycle/error.h>
#include <float.h>
#include <math.h>
#include <stdio.h>

// Seen above rounding for a long time, and small enough for linear growth to begin with.
static const double growing_disturbance = 1e-9;

static term_exit ride_twin(trace *out, comparison *c, double disturbance, problem *p) {
  bike_state start = c->scenario->start;
  start.lean += disturbance;
  term_exit code = comparison_ride_also(out, c, &c->scenario->reference, &start, p);
  return code == TERM_DONE ? code : problem_prefix(p, code, "horizon: a twin of the reference");
}

static size_t common_rows(const comparison *c, const trace *twin) {
  size_t rows = c->side[REFERENCE].trace.count;
  return rows < twin->count ? rows : twin->count;
}

// The time of the last row before the twin's signal, within the part of the ride that a rule is
// about, is off by more than `allowance`.
static double time_within(const comparison *c, const trace *twin, const trace_signal *signal,
                          const gate_rule *rule, double allowance) {
  const trace *reference = &c->side[REFERENCE].trace;
  double time = 0;
  for (size_t k = 0; k < common_rows(c, twin); k++) {
    double now = reference->rows[k].sample.time;
    double off = trace_value(&twin->rows[k], signal) - trace_value(&reference->rows[k], signal);
    bool judged = gate_covers(rule->from, rule->to, now, c->scenario->sample);
    if (judged && !(fabs(off) <= allowance)) return time;
    time = now;
  }
  // Events may differ by as little as the rides do, which is within the last row.
  return reference->complete ? c->scenario->duration : time;
}

static void find_time_of(study_horizon *h, const comparison *c, const trace *twin,
                         const trace_signal *signal, const gate_rule *rule) {
  double time = time_within(c, twin, signal, rule, c->scenario->horizon.share * rule->limit);
  if (time >= h->time) return;
  h->time = time;
  if (time < c->scenario->duration) snprintf(h->signal, sizeof h->signal, "%s", signal->name);
}

// Over all rules that limit the largest error of a signal; false without any.
static bool find_time(study_horizon *h, const comparison *c, const trace *twin) {
  const gate_rules *rules = &c->scenario->rules;
  bool limited = false;
  h->time = INFINITY;
  for (int i = 0; i < TRACE_SIGNAL_COUNT; i++) {
    const trace_signal *signal = &trace_signals[i];
    for (size_t k = 0; k < rules->count && trace_has(twin, signal); k++) {
      if (!gate_limits_max(&rules->items[k], rules, signal->name)) continue;
      limited = true;
      find_time_of(h, c, twin, signal, &rules->items[k]);
    }
  }
  return limited;
}

// Size of the difference, rates made angles by the growth they belong to.
static double distance(const trace_row *a, const trace_row *b, double rate) {
  double lean = a->sample.lean - b->sample.lean, steer = a->sample.steer - b->sample.steer;
  double lean_rate = (a->sample.lean_rate - b->sample.lean_rate) / rate;
  double steer_rate = (a->sample.steer_rate - b->sample.steer_rate) / rate;
  return sqrt(lean * lean + steer * steer + lean_rate * lean_rate + steer_rate * steer_rate);
}

// Least squares of log(distance) over time, from where other modes have died out (the first third)
// to where the growth is no longer small. NaN with less than ten rows.
static double find_exponent(const comparison *c, const trace *twin, double rate) {
  const trace_row *reference = c->side[REFERENCE].trace.rows;
  static const double large = 1e-3; // rad: the square is 1e-6, far below what is judged here
  size_t last = 0, first;
  while (last < common_rows(c, twin) && distance(&twin->rows[last], &reference[last], rate) < large)
    last++;
  first = last / 3;
  if (last - first < 10) return NAN;
  double n = (double)(last - first), t0 = 0, y0 = 0, tt = 0, ty = 0;
  for (size_t k = first; k < last; k++) {
    t0 += reference[k].sample.time / n;
    y0 += log(distance(&twin->rows[k], &reference[k], rate)) / n;
  }
  for (size_t k = first; k < last; k++) {
    double t = reference[k].sample.time - t0;
    tt += t * t;
    ty += t * (log(distance(&twin->rows[k], &reference[k], rate)) - y0);
  }
  return ty / tt;
}

static double size_of_mode(const bike_eigenvalues *modes) {
  double size = hypot(modes->re[0], modes->im[0]);
  return size > 0 ? size : 1;
}

static term_exit examine(comparison *c, const trace *twin, const trace *growing, problem *p) {
  study_horizon *h = &c->study.horizon;
  bike_eigenvalues modes;
  const scenario *s = c->scenario;
  int error = bike_upright_eigenvalues(&modes, &s->model, s->start.speed);
  if (error != BIKE_OK)
    return problem_set(p, term_exit_of(error), "horizon: %s", bike_error_string(error));
  *h = (study_horizon){.asked = true, .disturbance = DBL_EPSILON, .eigenvalue = modes.re[0]};
  if (!find_time(h, c, twin))
    return problem_set(p, TERM_USAGE, "horizon: no gate limits 'max' of a signal of layer L2");
  h->exponent = find_exponent(c, growing, size_of_mode(&modes));
  return TERM_DONE;
}

term_exit horizon_find(comparison *c, problem *p) {
  trace twin = {0}, growing = {0};
  term_exit code = ride_twin(&twin, c, DBL_EPSILON, p);
  if (code == TERM_DONE) code = ride_twin(&growing, c, growing_disturbance, p);
  if (code == TERM_DONE) code = examine(c, &twin, &growing, p);
  trace_clear(&twin);
  trace_clear(&growing);
  return code;
}
