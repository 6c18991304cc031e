// SPDX-License-Identifier: Apache-2.0
#include "comparison_relations.h"

#include "comparison_explain.h"

#include <math.h>
#include <string.h>

static const double degree = 57.295779513082321; // degrees in a radian
static const double kmh = 3.6;                   // km/h in a m/s

typedef struct pair {
  const comparison *c;
  const trace_signal *signal, *of;
} pair;

static double candidate_at(const pair *p, size_t row) {
  return trace_value(&p->c->side[CANDIDATE].trace.rows[row], p->signal);
}

static double reference_at(const pair *p, size_t row) {
  return trace_value(&p->c->side[REFERENCE].trace.rows[row], p->of);
}

// Root of the mean square of candidate/factor - reference over that of the reference. NaN, which
// fits nothing, where the reference is zero throughout.
static double misfit(const pair *p, double factor) {
  double left = 0, size = 0;
  for (size_t k = 0; k < comparison_judged_rows(p->c); k++) {
    double value = reference_at(p, k), error = candidate_at(p, k) / factor - value;
    left += error * error;
    size += value * value;
  }
  return sqrt(left / size);
}

static double largest_left(const pair *p, double factor) {
  double largest = 0;
  for (size_t k = 0; k < comparison_judged_rows(p->c); k++)
    largest = fmax(largest, fabs(candidate_at(p, k) / factor - reference_at(p, k)));
  return largest;
}

static bool both_have(const comparison *c, const trace_signal *signal) {
  return trace_has(&c->side[REFERENCE].trace, signal) &&
         trace_has(&c->side[CANDIDATE].trace, signal);
}

// Keeps the factor that leaves least.
static void try_factor(relation *best, double *least, const pair *p, double factor) {
  double size = misfit(p, factor);
  if (!(size < *least)) return;
  *least = size;
  *best = (relation){p->signal, p->of, factor, largest_left(p, factor)};
}

static void try_units(relation *best, double *least, const pair *p) {
  bool is_angle = strncmp(p->of->unit, "rad", 3) == 0, is_speed = strcmp(p->of->unit, "m/s") == 0;
  double unit = is_angle ? degree : is_speed ? kmh : 1;
  try_factor(best, least, p, -1);
  for (int sign = -1; unit > 1 && sign <= 1; sign += 2) {
    try_factor(best, least, p, sign * unit);
    try_factor(best, least, p, sign / unit);
  }
}

int relations_find(relation out[TRACE_MOTION_COUNT], const comparison *c) {
  static const double small = 0.02; // of the signal's root mean square
  enum { FEWEST_ROWS = 3 };         // two rows can be anything's multiple
  int count = 0;
  if (comparison_judged_rows(c) < FEWEST_ROWS) return 0;
  for (int i = 0; i < TRACE_MOTION_COUNT; i++) {
    const trace_signal *signal = &trace_signals[i];
    const pair same = {c, signal, signal};
    double least = small;
    relation best = {0};
    if (!both_have(c, signal) || misfit(&same, 1) <= small) continue;
    try_units(&best, &least, &same);
    for (int j = 0; j < TRACE_MOTION_COUNT; j++)
      if (j != i && both_have(c, &trace_signals[j]))
        try_factor(&best, &least, &(pair){c, signal, &trace_signals[j]}, 1);
    if (best.signal) out[count++] = best;
  }
  return count;
}

//---------------------------------- in words ------------------------------------------------------

#define WORDS(signal) comparison_words((signal)->name).text

static const relation *relation_of(const relation *relations, int count, const trace_signal *s) {
  for (int i = 0; i < count; i++)
    if (relations[i].signal == s) return &relations[i];
  return NULL;
}

static bool is_swap(const relation *r, const relation *other) {
  return other && other != r && r->of == other->signal && other->of == r->signal;
}

// Whether both are the same multiple of their own signal.
static bool is_alike(const relation *a, const relation *b) {
  return a->of == a->signal && b->of == b->signal && a->factor == b->factor;
}

// "are in degrees and have the other sign"
static void say_factor(comparison *c, double factor, bool plural) {
  double size = fabs(factor);
  const char *is = plural ? "are" : "is", *has = plural ? "have" : "has";
  if (size == degree)
    comparison_say(c, "%s in degrees", is);
  else if (size == kmh)
    comparison_say(c, "%s in km/h", is);
  else if (size != 1)
    comparison_say(c, "%s too small by a factor of %.9g", is, 1 / size);
  if (factor < 0) comparison_say(c, "%s%s the other sign", size == 1 ? "" : " and ", has);
}

// "steer, steer rate of the recording have the other sign (largest difference once corrected: ...)"
static void say_multiples(comparison *c, const relation *relations, int count, int first) {
  const relation *r = &relations[first];
  int said = 0;
  for (int i = first; i < count; i++)
    if (is_alike(&relations[i], r))
      comparison_say(c, "%s%s", said++ ? ", " : "", WORDS(relations[i].signal));
  comparison_say(c, " of %s ", comparison_name(c, CANDIDATE));
  say_factor(c, r->factor, said > 1);
  comparison_say(c, " (largest difference once corrected:");
  said = 0;
  for (int i = first; i < count; i++)
    if (is_alike(&relations[i], r))
      comparison_say(c, "%s %.2g %s", said++ ? "," : "", relations[i].left, relations[i].of->unit);
  comparison_say(c, ")");
}

static void say_column(comparison *c, const relation *r, const relation *other) {
  if (is_swap(r, other))
    comparison_say(
        c, "%s and %s of %s are swapped (largest difference once corrected: %.2g %s, %.2g %s)",
        WORDS(r->signal), WORDS(r->of), comparison_name(c, CANDIDATE), r->left, r->of->unit,
        other->left, other->of->unit);
  else
    comparison_say(c, "%s of %s is the %s of %s (within %.2g %s)", WORDS(r->signal),
                   comparison_name(c, CANDIDATE), WORDS(r->of), comparison_name(c, REFERENCE),
                   r->left, r->of->unit);
}

void relations_say(comparison *c, const relation *relations, int count) {
  for (int i = 0; i < count; i++) {
    const relation *r = &relations[i], *other = relation_of(relations, count, r->of);
    bool known = is_swap(r, other) && other < r;
    for (int j = 0; j < i; j++) known = known || is_alike(r, &relations[j]);
    if (known) continue;
    comparison_say(c, i > 0 ? "; " : ": ");
    if (r->of == r->signal)
      say_multiples(c, relations, count, i);
    else
      say_column(c, r, other);
  }
}
