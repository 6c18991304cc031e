// SPDX-License-Identifier: Apache-2.0
// L0: both engines at the same states: the start, and seeded random ones. What they say of an
// instant must agree whatever their integrators do.
#include "layer.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

// To what an error is compared.
typedef enum scale {
  SCALE_UNIT,   // max(1, |value|): relative, absolute near zero
  SCALE_ENERGY, // the energy at that state
} scale;

typedef struct quantity {
  const char *name, *unit;
  size_t offset; // of a double within engine_instant
  scale scale;
} quantity;

#define INSTANT(name, unit, member, scale)                                                         \
  { name, unit, offsetof(engine_instant, member), scale }

static const quantity quantities[] = {
    INSTANT("lean_acceleration", "rad/s^2", lean_acceleration, SCALE_UNIT),
    INSTANT("steer_acceleration", "rad/s^2", steer_acceleration, SCALE_UNIT),
    INSTANT("speed_rate", "m/s^2", speed_rate, SCALE_UNIT),
    INSTANT("yaw_acceleration", "rad/s^2", yaw_acceleration, SCALE_UNIT),
    INSTANT("pitch_acceleration", "rad/s^2", pitch_acceleration, SCALE_UNIT),
    INSTANT("rear_wheel_acceleration", "rad/s^2", wheel_acceleration[0], SCALE_UNIT),
    INSTANT("front_wheel_acceleration", "rad/s^2", wheel_acceleration[1], SCALE_UNIT),
    INSTANT("yaw_rate", "rad/s", yaw_rate, SCALE_UNIT),
    INSTANT("pitch_rate", "rad/s", pitch_rate, SCALE_UNIT),
    INSTANT("rear_wheel_rate", "rad/s", wheel_rate[0], SCALE_UNIT),
    INSTANT("front_wheel_rate", "rad/s", wheel_rate[1], SCALE_UNIT),
    INSTANT("pitch", "rad", pitch, SCALE_UNIT),
    INSTANT("kinetic", "J", kinetic, SCALE_ENERGY),
    INSTANT("potential", "J", potential, SCALE_ENERGY),
};

enum {
  QUANTITY_COUNT = sizeof quantities / sizeof quantities[0],
  FORCE_COUNT = 2,
  MASS = QUANTITY_COUNT + FORCE_COUNT, // index of the mass matrix, the last
  ERROR_COUNT
};

static const char *const force_names[FORCE_COUNT + 1] = {"rear_force", "front_force", NULL};
static const char mass_name[] = "mass_matrix";

// The largest errors so far, each with the state at which it stands.
typedef struct extremes {
  measurement error[ERROR_COUNT];
  int64_t stopped; // states left out because a stop of the model acts there
} extremes;

static double value_of(const engine_instant *instant, const quantity *q) {
  double value;
  memcpy(&value, (const char *)instant + q->offset, sizeof value);
  return value;
}

// Keeps the larger of two errors; NaN counts as larger than any number and stays.
static bool is_worse(double error, double so_far) {
  return !isnan(so_far) && !(error <= so_far);
}

static void describe(measurement *m, const bike_state *s, double reference, double candidate,
                     const char *unit) {
  measurement_detail(m,
                     "%.9g against %.9g %s at lean %.4g, steer %.4g, lean rate %.4g, steer rate "
                     "%.4g, speed %.4g",
                     candidate, reference, unit, s->lean, s->steer, s->lean_rate, s->steer_rate,
                     s->speed);
}

static void compare_quantities(extremes *out, const bike_state *state, const engine_instant *a,
                               const engine_instant *b) {
  for (int i = 0; i < QUANTITY_COUNT; i++) {
    const quantity *q = &quantities[i];
    double x = value_of(a, q), y = value_of(b, q);
    double size = q->scale == SCALE_ENERGY ? a->kinetic + a->potential : fmax(1, fabs(x));
    double error = fabs(y - x) / size;
    if (!is_worse(error, out->error[i].value)) continue;
    out->error[i].value = error;
    describe(&out->error[i], state, x, y, q->unit);
  }
}

static double norm(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void compare_forces(extremes *out, const bike_state *state, const engine_instant *a,
                           const engine_instant *b, double weight) {
  for (int i = 0; i < FORCE_COUNT; i++) {
    measurement *m = &out->error[QUANTITY_COUNT + i];
    double difference[3];
    for (int k = 0; k < 3; k++) difference[k] = b->force[i][k] - a->force[i][k];
    double error = norm(difference) / fmax(weight, norm(a->force[i]));
    if (!is_worse(error, m->value)) continue;
    m->value = error;
    describe(m, state, norm(a->force[i]), norm(b->force[i]), "N");
  }
}

// Each element is compared to those of the diagonal that it couples: sqrt(M_ii M_jj).
static void compare_masses(extremes *out, const bike_state *state, const double a[9],
                           const double b[9]) {
  measurement *m = &out->error[MASS];
  for (int i = 0; i < 9; i++) {
    double error = fabs(b[i] - a[i]) / sqrt(a[4 * (i / 3)] * a[4 * (i % 3)]);
    if (!is_worse(error, m->value)) continue;
    m->value = error;
    describe(m, state, a[i], b[i], "(SI)");
  }
}

static bool knows_masses(const comparison *c) {
  return c->side[REFERENCE].engine->mass_matrix && c->side[CANDIDATE].engine->mass_matrix;
}

// A state that was evaluated has a mass matrix: to refuse it is a difference, not the state's.
static term_exit compare_masses_at(extremes *out, comparison *c, const bike_state *state,
                                   problem *p) {
  double M[2][9];
  for (int i = 0; i < 2; i++) {
    const comparison_side *side = &c->side[i == 0 ? REFERENCE : CANDIDATE];
    term_exit code = side->engine->mass_matrix(M[i], side->instance, state, p);
    if (code == TERM_USAGE) {
      out->error[MASS].value = NAN;
      measurement_detail(&out->error[MASS], "%s: %.120s", side->label, p->text);
      return TERM_DONE;
    }
    if (code != TERM_DONE) return problem_prefix(p, code, side->label);
  }
  compare_masses(out, state, M[0], M[1]);
  return TERM_DONE;
}

// A state that only the candidate refuses is a difference like any other.
static void note_refusal(extremes *out, const bike_state *s, const char *why) {
  for (int i = 0; i < ERROR_COUNT; i++) {
    out->error[i].value = NAN;
    measurement_detail(&out->error[i], "at lean %.4g, steer %.4g, speed %.4g: %.120s", s->lean,
                       s->steer, s->speed, why);
  }
}

// Compares at a state. `*admissible` is false where the reference refuses the state, or where a
// stop acts.
static term_exit compare_at(extremes *out, bool *admissible, comparison *c, const bike_state *state,
                            problem *p) {
  engine_instant instant[2];
  const comparison_side *reference = &c->side[REFERENCE], *candidate = &c->side[CANDIDATE];
  term_exit code = reference->engine->evaluate(&instant[0], reference->instance, state, p);
  *admissible = code != TERM_USAGE;
  if (!*admissible) return TERM_DONE;
  if (code != TERM_DONE) return problem_prefix(p, code, reference->label);
  code = candidate->engine->evaluate(&instant[1], candidate->instance, state, p);
  if (code == TERM_USAGE) {
    note_refusal(out, state, p->text);
    return TERM_DONE;
  }
  if (code != TERM_DONE) return problem_prefix(p, code, candidate->label);
  if (instant[0].at_stop || instant[1].at_stop) {
    *admissible = false;
    out->stopped++;
    problem_set(p, TERM_USAGE, "it is beyond a stop of the model: %s", c->scenario->stops);
    return TERM_DONE;
  }
  compare_quantities(out, state, &instant[0], &instant[1]);
  compare_forces(out, state, &instant[0], &instant[1], c->weight);
  return knows_masses(c) ? compare_masses_at(out, c, state, p) : TERM_DONE;
}

// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): uniform in [low, high).
static double draw(uint64_t *state, double low, double high) {
  uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
  z ^= z >> 31;
  return low + (high - low) * ((double)(z >> 11) * 0x1p-53);
}

static bike_state draw_state(uint64_t *seed, const scenario_instants *range) {
  bike_state s;
  s.lean = draw(seed, -range->lean, range->lean);
  s.steer = draw(seed, -range->steer, range->steer);
  s.lean_rate = draw(seed, -range->rate, range->rate);
  s.steer_rate = draw(seed, -range->rate, range->rate);
  s.speed = draw(seed, range->slow, range->fast);
  return s;
}

// A range of which the bicycle can take up less than one in this many states is a mistake.
enum { DRAWS_PER_STATE = 100 };

static term_exit compare_all(extremes *out, comparison *c, problem *p) {
  const scenario_instants *range = &c->scenario->instants;
  uint64_t seed = range->seed;
  bool admissible;
  term_exit code = compare_at(out, &admissible, c, &c->scenario->start, p);
  if (code == TERM_DONE && !admissible) {
    if (!*p->text) problem_set(p, TERM_USAGE, "the bicycle cannot take up this state");
    return problem_prefix(p, TERM_USAGE, "start");
  }
  int64_t draws = 0, most = (int64_t)DRAWS_PER_STATE * range->count;
  for (int found = 0; code == TERM_DONE && found < range->count; draws++) {
    if (draws == most)
      return problem_set(p, TERM_USAGE, "instants: the bicycle can take up %d of %lld states",
                         found, (long long)draws);
    bike_state state = draw_state(&seed, range);
    admissible = fabs(state.lean) < scenario_lean_limit(); // rides end there
    if (admissible) code = compare_at(out, &admissible, c, &state, p);
    found += admissible;
  }
  return code;
}

static void note_stops(extremes *out, const scenario *s) {
  for (int i = 0; i < ERROR_COUNT && out->stopped > 0; i++) {
    size_t used = strlen(out->error[i].detail);
    snprintf(out->error[i].detail + used, sizeof out->error[i].detail - used,
             "; %lld states beyond stops left out (%s)", (long long)out->stopped, s->stops);
  }
}

static const char *name_of(int error) {
  if (error < QUANTITY_COUNT) return quantities[error].name;
  return error < MASS ? force_names[error - QUANTITY_COUNT] : mass_name;
}

static term_exit measure(comparison *c, problem *p) {
  if (!c->side[REFERENCE].engine->evaluate || !c->side[CANDIDATE].engine->evaluate)
    return TERM_DONE; // an engine that knows rides only
  extremes worst = {.stopped = 0};
  for (int i = 0; i < ERROR_COUNT; i++) {
    worst.error[i] = measurement_of(layer_instant.name, name_of(i), "relative", "");
    worst.error[i].value = -1; // less than any error, replaced by the first
  }
  term_exit code = compare_all(&worst, c, p);
  if (code != TERM_DONE) return code;
  note_stops(&worst, c->scenario);
  int count = knows_masses(c) ? ERROR_COUNT : MASS;
  for (int i = 0; i < count; i++) measurement_add(&c->measurements, &worst.error[i]);
  return TERM_DONE;
}

static bool knows(const char *signal, const char *metric) {
  static const char *const metrics[] = {"relative", NULL};
  if (!layer_names(metrics, metric)) return false;
  if (!signal || layer_names(force_names, signal)) return true;
  for (int i = 0; i < QUANTITY_COUNT; i++)
    if (strcmp(quantities[i].name, signal) == 0) return true;
  return strcmp(mass_name, signal) == 0;
}

const layer layer_instant = {
    .name = "L0",
    .title = "instant",
    .agreed = "the engines agree on instants",
    .failure = "the engines differ at an instant",
    .knows = knows,
    .measure = measure,
};
