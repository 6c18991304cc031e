// SPDX-License-Identifier: Apache-2.0
#include "comparison_explain.h"

#include "layer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void say(comparison *c, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void say(comparison *c, const char *format, ...) {
  size_t used = strlen(c->cause);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(c->cause + used, sizeof c->cause - used, format, arguments);
  va_end(arguments);
}

// "front_frame_Ixz" as a person writes it.
static const char *in_words(char out[MEASUREMENT_NAME], const char *signal) {
  snprintf(out, MEASUREMENT_NAME, "%s", signal);
  for (char *at = out; *at; at++)
    if (*at == '_') *at = ' ';
  return out;
}

static bool fails(const comparison *c, const char *layer_name, const char *signal) {
  for (size_t i = 0; i < c->gates.count; i++) {
    const gate *g = &c->gates.items[i];
    if (!g->pass && strcmp(g->what.layer, layer_name) == 0 && strcmp(g->what.signal, signal) == 0)
      return true;
  }
  return false;
}

static bool fails_any(const comparison *c, const char *layer_name, const char *const *signals) {
  for (; *signals; signals++)
    if (fails(c, layer_name, *signals)) return true;
  return false;
}

// "; so do trail, head angle and 3 more": a wrong length shows in all that is measured from it.
static void list_others(comparison *c, const gate *worst) {
  enum { SHOWN = 6 };
  int others = 0;
  for (size_t i = 0; i < c->gates.count; i++) {
    const gate *g = &c->gates.items[i];
    char words[MEASUREMENT_NAME];
    if (g->pass || g == worst || strcmp(g->what.layer, worst->what.layer) != 0) continue;
    if (others++ < SHOWN)
      say(c, "%s%s", others == 1 ? "; so do " : ", ", in_words(words, g->what.signal));
  }
  if (others > SHOWN) say(c, " and %d more", others - SHOWN);
}

static void say_limit(comparison *c, const gate *worst) {
  const measurement *m = &worst->what;
  char metric[MEASUREMENT_METRIC];
  say(c, "%s %.3g%s%s, limit %.3g", measurement_metric(metric, m->metric, m->from, m->to), m->value,
      *m->unit ? " " : "", m->unit, worst->rule->limit);
  if (isfinite(m->time)) say(c, ", at %g s", m->time);
}

// That two rides end together is asked of all, and says nothing of what is between.
static bool is_gated(const comparison *c, const layer *l) {
  for (size_t i = 0; i < c->gates.count; i++) {
    const measurement *m = &c->gates.items[i].what;
    if (strcmp(m->layer, l->name) == 0 && strcmp(m->signal, "end_time") != 0) return true;
  }
  return false;
}

// "the engines agree on instants, but ": of the layers before the first that fails, the last that
// had a gate. What nothing was asked of is not known to agree.
static void say_agreed(comparison *c) {
  const layer *passed = NULL;
  for (int i = 0; layer_at(i) && layer_at(i) != c->first_failure; i++)
    if (layer_at(i)->agreed && is_gated(c, layer_at(i))) passed = layer_at(i);
  if (passed) say(c, "%s, but ", passed->agreed);
}

//---------------------------------- what each layer means -----------------------------------------

// 'front frame Ixz differs: -0.00756 against 0.00756 kg m^2'
static void explain_parameters(comparison *c, const gate *worst) {
  char words[MEASUREMENT_NAME];
  say(c, "%s differs: %s (%s: ", in_words(words, worst->what.signal), worst->what.detail,
      worst->what.source);
  say_limit(c, worst);
  say(c, ")");
  list_others(c, worst);
}

static const char *instant_suspect(const comparison *c) {
  static const char *const motion[] = {"yaw_rate",         "pitch_rate", "rear_wheel_rate",
                                       "front_wheel_rate", "pitch",      NULL};
  static const char *const energy[] = {"kinetic", "potential", NULL};
  if (fails_any(c, "L0", motion)) return "the geometry of rolling";
  if (fails_any(c, "L0", energy)) return "masses, or the velocities they have";
  return "the rolling constraint or the forces";
}

static void explain_instant(comparison *c, const gate *worst) {
  char words[MEASUREMENT_NAME], refused[MEASUREMENT_DETAIL];
  snprintf(refused, sizeof refused, "%s", worst->what.detail);
  say_agreed(c);
  say(c, "the engines say different things of an instant, largest in %s: ",
      in_words(words, worst->what.signal));
  say_limit(c, worst);
  if (*refused) say(c, " (%s)", refused);
  say(c, ": %s", instant_suspect(c));
}

// The largest difference at the very first row, as a share of the largest at all.
static double share_at_start(const comparison *c, const char *name) {
  const trace *a = &c->side[REFERENCE].trace, *b = &c->side[CANDIDATE].trace;
  const trace_signal *signal = trace_find_signal(name);
  double first = NAN, largest = 0;
  if (!signal) return 0;
  for (size_t k = 0; k < comparison_rows(c); k++) {
    double error = fabs(trace_value(&b->rows[k], signal) - trace_value(&a->rows[k], signal));
    if (k == 0) first = error;
    largest = fmax(largest, error);
  }
  return largest > 0 ? first / largest : 0;
}

static void say_order(comparison *c) {
  const study_convergence *study = &c->study.convergence;
  if (study->count == 0 || study->verdict == STUDY_SAME) return;
  for (int i = 0; i < STUDY_SIGNALS; i++) {
    const study_signal *s = &study->signal[i];
    if (s->verdict != study->verdict) continue;
    if (s->verdict == STUDY_UNDECIDED)
      say(c, "; with smaller steps they get closer with order %.2g, not %.2g: another integrator",
          s->order, study->order);
    else
      say(c, "; no smaller step brings them closer than %.3g rad: another model", s->plateau);
    return;
  }
}

// A gate on a part of the ride in which there is nothing: no rides differ there.
static void explain_nothing_measured(comparison *c, const gate *worst) {
  char words[MEASUREMENT_NAME];
  say_agreed(c);
  say(c, "nothing of %s was measured: ", in_words(words, worst->what.signal));
  say_limit(c, worst);
  if (*worst->what.detail) say(c, " (%s)", worst->what.detail);
  for (int i = REFERENCE; i <= CANDIDATE; i++)
    if (!c->side[i].trace.complete)
      say(c, "; the ride of %s ends at %g s", c->side[i].label, c->side[i].trace.end_time);
}

static void explain_traces(comparison *c, const gate *worst) {
  if (isnan(worst->what.value)) {
    explain_nothing_measured(c, worst);
    return;
  }
  char words[MEASUREMENT_NAME];
  const study_shift *shift = &c->study.shift;
  // Curvature between rows is not seen: it leaves some hundredths of the mean square, other faults
  // leave most of it.
  static const double explained = 0.95;
  say_agreed(c);
  say(c, "the rides differ, largest in %s: ", in_words(words, worst->what.signal));
  say_limit(c, worst);
  if (*worst->what.detail) say(c, " (%s)", worst->what.detail);
  // From a different start rides part at once; from the same one the first row agrees.
  if (share_at_start(c, worst->what.signal) > 0.1)
    say(c, ": they start differently");
  else if (shift->share > explained)
    say(c, ": a time offset, %s is late by %.6g s", c->side[CANDIDATE].label, shift->time);
  else if (strcmp(worst->what.signal, "end_time") == 0)
    say(c, ": one of them ends early");
  else {
    say(c, ": the integration");
    say_order(c);
  }
}

static void explain_any(comparison *c, const gate *worst) {
  char name[MEASUREMENT_FULL_NAME];
  const measurement *m = &worst->what;
  say_agreed(c);
  say(c, "%s; largest in %s: ", c->first_failure->failure, measurement_full_name(name, m));
  say_limit(c, worst);
  if (*m->detail) say(c, " (%s)", m->detail);
  if (strcmp(m->layer, "L4") == 0) say_order(c);
}

void comparison_explain(comparison *c, const gate *worst) {
  static const struct {
    const layer *layer;
    void (*explain)(comparison *c, const gate *worst);
  } known[] = {{&layer_parameters, explain_parameters},
               {&layer_instant, explain_instant},
               {&layer_traces, explain_traces}};
  c->first_failure = layer_find(worst->what.layer);
  c->cause[0] = '\0';
  // A limit on what nobody measured says so itself.
  bool measured = isfinite(worst->what.value) || *worst->what.source;
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (known[i].layer == c->first_failure && (measured || known[i].layer != &layer_parameters)) {
      known[i].explain(c, worst);
      return;
    }
  explain_any(c, worst);
}
