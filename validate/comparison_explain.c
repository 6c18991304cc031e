// SPDX-License-Identifier: Apache-2.0
#include "comparison_explain.h"

#include "layer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void comparison_say(comparison *c, const char *format, ...) {
  size_t used = strlen(c->cause);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(c->cause + used, sizeof c->cause - used, format, arguments);
  va_end(arguments);
}

comparison_text comparison_words(const char *signal) {
  comparison_text words;
  snprintf(words.text, sizeof words.text, "%s", signal);
  for (char *at = words.text; *at; at++)
    if (*at == '_') *at = ' ';
  return words;
}

const char *comparison_name(const comparison *c, int side) {
  static const char *const names[] = {"the reference", "the candidate"};
  const char *engine_name = c->side[side].engine->name, *other = c->side[1 - side].engine->name;
  if (strcmp(engine_name, other) == 0) return names[side];
  return strcmp(engine_name, "file") == 0 ? "the recording" : c->side[side].label;
}

// Counts a layer's gates on some signals, and those that fail.
static int count_gates(int *failed, const comparison *c, const layer *l,
                       const char *const *signals) {
  int count = 0;
  *failed = 0;
  for (size_t i = 0; i < c->gates.count; i++) {
    const gate *g = &c->gates.items[i];
    if (strcmp(g->what.layer, l->name) != 0 || !layer_names(signals, g->what.signal)) continue;
    count++;
    *failed += !g->pass;
  }
  return count;
}

// "; so do trail, head angle and 3 more": a wrong length shows in all that is measured from it.
static void list_others(comparison *c, const gate *worst) {
  enum { SHOWN = 6 };
  int others = 0;
  for (size_t i = 0; i < c->gates.count; i++) {
    const gate *g = &c->gates.items[i];
    if (g->pass || g == worst || strcmp(g->what.layer, worst->what.layer) != 0) continue;
    if (others++ < SHOWN)
      comparison_say(c, "%s%s", others == 1 ? "; so do " : ", ",
                     comparison_words(g->what.signal).text);
  }
  if (others > SHOWN) comparison_say(c, " and %d more", others - SHOWN);
}

void comparison_say_limit(comparison *c, const gate *worst) {
  const measurement *m = &worst->what;
  char metric[MEASUREMENT_METRIC];
  comparison_say(c, "%s %.3g%s%s, limit %.3g",
                 measurement_metric(metric, m->metric, m->from, m->to), m->value,
                 *m->unit ? " " : "", m->unit, worst->rule->limit);
  if (isfinite(m->time)) comparison_say(c, ", at %g s", m->time);
}

// That two rides end together is asked of all, and says nothing of what is between.
bool comparison_is_gated(const comparison *c, const layer *l) {
  for (size_t i = 0; i < c->gates.count; i++) {
    const measurement *m = &c->gates.items[i].what;
    if (strcmp(m->layer, l->name) == 0 && strcmp(m->signal, "end_time") != 0) return true;
  }
  return false;
}

// "the engines agree on instants, but ": of the layers before the first that fails, the last that
// had a gate. What nothing was asked of is not known to agree.
void comparison_say_agreed(comparison *c) {
  const layer *passed = NULL;
  for (int i = 0; layer_at(i) && layer_at(i) != c->first_failure; i++)
    if (layer_at(i)->agreed && comparison_is_gated(c, layer_at(i))) passed = layer_at(i);
  if (passed) comparison_say(c, "%s, but ", passed->agreed);
}

//---------------------------------- what each layer means -----------------------------------------

// 'front frame Ixz differs: -0.00756 against 0.00756 kg m^2'
static void explain_parameters(comparison *c, const gate *worst) {
  comparison_say(c, "%s differs: %s (%s: ", comparison_words(worst->what.signal).text,
                 worst->what.detail, worst->what.source);
  comparison_say_limit(c, worst);
  comparison_say(c, ")");
  list_others(c, worst);
}

// "velocities agree, energies differ": of each group of quantities that has a gate. Accelerations
// and forces are asked of the same velocities, these of the same states.
static void say_groups(comparison *c) {
  static const struct {
    const char *words, *signals[10];
  } groups[] = {
      {"velocities of rolling",
       {"yaw_rate", "pitch_rate", "rear_wheel_rate", "front_wheel_rate", "pitch"}},
      {"energies", {"kinetic", "potential"}},
      {"mass matrices", {"mass_matrix"}},
      {"accelerations",
       {"lean_acceleration", "steer_acceleration", "yaw_acceleration", "pitch_acceleration",
        "rear_wheel_acceleration", "front_wheel_acceleration", "speed_rate"}},
      {"ground forces", {"rear_force", "front_force"}},
  };
  const char *separator = ": ";
  for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) {
    int failed, count = count_gates(&failed, c, &layer_instant, groups[i].signals);
    if (count == 0) continue;
    comparison_say(c, "%s%s %s", separator, groups[i].words, failed ? "differ" : "agree");
    separator = ", ";
  }
}

static void explain_instant(comparison *c, const gate *worst) {
  comparison_say_agreed(c);
  comparison_say(c, "the engines differ at an instant, most in %s: ",
                 comparison_words(worst->what.signal).text);
  comparison_say_limit(c, worst);
  if (*worst->what.detail) comparison_say(c, " (%s)", worst->what.detail);
  say_groups(c);
}

void comparison_say_order(comparison *c) {
  const study_convergence *study = &c->study.convergence;
  if (study->count == 0 || study->verdict == STUDY_SAME) return;
  for (int i = 0; i < STUDY_SIGNALS; i++) {
    const study_signal *s = &study->signal[i];
    if (s->verdict != study->verdict) continue;
    // The power is a whole order where one was measured, else the expected one.
    if (s->verdict == STUDY_UNDECIDED)
      comparison_say(c, "; with smaller steps they get closer with order %.2g, not %.2g%s",
                     s->order, study->order,
                     s->power != study->order ? ": another integrator" : "");
    else
      comparison_say(c, "; no smaller step brings them closer than %.3g rad: another model",
                     s->plateau);
    return;
  }
}

// A gate without a value: on a part of the ride in which there is nothing, or on what no engine of
// the scenario knows. Nothing is known to differ there.
static void explain_nothing_measured(comparison *c, const gate *worst) {
  bool any = strcmp(worst->what.signal, "any") == 0; // of a gate that names no signal
  comparison_say_agreed(c);
  comparison_say(c, "nothing of %s was measured: ",
                 any ? c->first_failure->title : comparison_words(worst->what.signal).text);
  comparison_say_limit(c, worst);
  if (*worst->what.detail) comparison_say(c, " (%s)", worst->what.detail);
  for (int i = REFERENCE; i <= CANDIDATE && c->ridden; i++)
    if (!c->side[i].trace.complete)
      comparison_say(c, "; the ride of %s ends at %g s", c->side[i].label,
                     c->side[i].trace.end_time);
}

static bool is_unmeasured(const comparison *c, size_t index) {
  const gate *g = &c->gates.items[index];
  return !g->pass && isnan(g->what.value) && strcmp(g->what.layer, c->first_failure->name) == 0;
}

// "; nothing of yaw, x was measured": signals of the layer that have a limit and no value, beside
// one that has both; each once, whatever number of metrics is asked.
static void say_unmeasured(comparison *c) {
  const gate *items = c->gates.items;
  int count = 0;
  for (size_t i = 0; i < c->gates.count; i++) {
    bool said = !is_unmeasured(c, i);
    for (size_t k = 0; k < i && !said; k++)
      said = is_unmeasured(c, k) && strcmp(items[k].what.signal, items[i].what.signal) == 0;
    if (said) continue;
    comparison_say(c, "%s%s", count++ ? ", " : "; nothing of ",
                   comparison_words(items[i].what.signal).text);
  }
  if (count) comparison_say(c, " was measured");
}

static void explain_any(comparison *c, const gate *worst) {
  char name[MEASUREMENT_FULL_NAME];
  const measurement *m = &worst->what;
  comparison_say_agreed(c);
  comparison_say(c, "%s; largest in %s: ", c->first_failure->failure,
                 measurement_full_name(name, m));
  comparison_say_limit(c, worst);
  if (*m->detail) comparison_say(c, " (%s)", m->detail);
  if (c->first_failure == &layer_convergence) comparison_say_order(c);
}

void comparison_explain(comparison *c, const gate *worst) {
  static const struct {
    const layer *layer;
    void (*explain)(comparison *c, const gate *worst);
  } known[] = {{&layer_parameters, explain_parameters},
               {&layer_instant, explain_instant},
               {&layer_traces, comparison_explain_traces}};
  void (*explain)(comparison *, const gate *) = explain_any;
  c->first_failure = layer_find(worst->what.layer);
  c->cause[0] = '\0';
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (known[i].layer == c->first_failure) explain = known[i].explain;
  if (isnan(worst->what.value)) explain = explain_nothing_measured;
  explain(c, worst);
  if (!isnan(worst->what.value)) say_unmeasured(c);
}
