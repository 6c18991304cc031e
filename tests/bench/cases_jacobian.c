// SPDX-License-Identifier: Apache-2.0
// Stability at many states: Jacobians with their eigenvalues, and eigenvalues alone.
#include "list.h"
#include "point.h"
#include "terminal/json.h"

#include <bicycle/batch.h>
#include <math.h>

// Of one call: a row of a map.
enum { STATES = 256 };

typedef struct jacobian_cases {
  bench_subject *subject;
  python_peer *python;
  bike_state states[STATES];
  bike_linear linears[STATES];
  bike_eigenvalues eigenvalues[STATES];
  int codes[STATES];
  double A[STATES][16]; // by differences
  double sink;
} jacobian_cases;

//---------------------------------- Jacobians -----------------------------------------------------

static void batched(void *context, long repeats) {
  jacobian_cases *c = context;
  for (long k = 0; k < repeats; k++) {
    bike_batch_linearize(c->linears, c->codes, &c->subject->model, c->states, NULL, STATES);
    bike_batch_eigenvalues(c->eigenvalues, c->codes, c->linears, STATES);
  }
}

static void by_differences(void *context, long repeats) {
  jacobian_cases *c = context;
  bike_eigenvalues e = {0};
  double sum = 0;
  for (long k = 0; k < repeats; k++)
    for (int i = 0; i < STATES; i++) {
      if (bench_differences(c->A[i], &c->subject->model, &c->states[i], 0)) continue;
      bike_eigenvalues_of(&e, c->A[i]);
      sum += e.re[0];
    }
  c->sink = sum;
}

static void riding(jacobian_cases *c) {
  for (int i = 0; i < STATES; i++) {
    double part = (double)i / (STATES - 1);
    c->states[i] = (bike_state){.lean = 0.4 * part, .steer = 0.05, .speed = 8 - 5 * part};
  }
}

// Steps of 1e-6 over accelerations good to some 1e-15: 1e-9, and a hundredfold for the size of what
// cancels.
static const double DIFFERENCES_AGREE = 1e-7;

static bool prepare_jacobian(void *context, bench_notes *notes) {
  jacobian_cases *c = context;
  riding(c);
  bike_batch_linearize(c->linears, c->codes, &c->subject->model, c->states, NULL, STATES);
  double worst = 0;
  for (int i = 0; i < STATES; i++) {
    if (c->codes[i] || bench_differences(c->A[i], &c->subject->model, &c->states[i], 0))
      return bench_note_reason(notes, "a state has no linearisation");
    double scale = 0, off = 0;
    for (int k = 0; k < 16; k++) {
      double error = fabs(c->A[i][k] - c->linears[i].A[k]);
      if (!(error <= off)) off = isnan(error) ? INFINITY : error;
      scale = fmax(scale, fabs(c->linears[i].A[k]));
    }
    worst = fmax(worst, off / scale);
  }
  bench_note_value(notes, "lanes", bike_batch_width());
  bench_note_check(notes, "disagreement", worst, DIFFERENCES_AGREE);
  return true;
}

//---------------------------------- eigenvalues ---------------------------------------------------

static void own_eigenvalues(void *context, long repeats) {
  jacobian_cases *c = context;
  for (long k = 0; k < repeats; k++)
    bike_batch_eigenvalues(c->eigenvalues, c->codes, c->linears, STATES);
}

static double numpy_eigenvalues(void *context, long repeats) {
  jacobian_cases *c = context;
  return python_seconds(
      c->python, json_pack("{s:s, s:I}", "do", "eigenvalues", "repeats", (json_int_t)repeats));
}

// Upright riding from 1 to 10 m/s: real eigenvalues and pairs, stable and not.
static bool linearize_upright(jacobian_cases *c) {
  for (int i = 0; i < STATES; i++) {
    bike_state state = {.speed = 1 + 9.0 * i / (STATES - 1)};
    if (bike_linearize(&c->linears[i], &c->subject->model, &state, NULL)) return false;
    for (int k = 0; k < 16; k++) c->A[i][k] = c->linears[i].A[k];
  }
  return true;
}

static double at(const json_t *answer, const char *key, int index) {
  const json_t *value = json_array_get(json_object_get(answer, key), (size_t)index);
  return json_is_number(value) ? json_number_value(value) : NAN;
}

// Relative to the largest of each matrix.
static double disagreement(const jacobian_cases *c, const json_t *answer) {
  double worst = 0;
  for (int i = 0; i < STATES; i++) {
    const bike_eigenvalues *e = &c->eigenvalues[i];
    if (c->codes[i]) return INFINITY;
    double scale = 0, off = 0;
    for (int k = 0; k < 4; k++) {
      double error =
          hypot(e->re[k] - at(answer, "re", 4 * i + k), e->im[k] - at(answer, "im", 4 * i + k));
      if (isnan(error)) return INFINITY;
      off = fmax(off, error);
      scale = fmax(scale, hypot(e->re[k], e->im[k]));
    }
    worst = fmax(worst, off / scale);
  }
  return worst;
}

// Two that are about to meet carry the root of the rounding, some 1e-8; others a hundred roundings.
// No speed of the row is that close to a meeting.
static const double EIGENVALUES_AGREE = 1e-10;

static bool prepare_eigenvalues(void *context, bench_notes *notes) {
  jacobian_cases *c = context;
  if (!linearize_upright(c)) return bench_note_reason(notes, "the bicycle has no linearisation");
  bike_batch_eigenvalues(c->eigenvalues, c->codes, c->linears, STATES);
  json_t *rows = term_json_matrix(c->A[0], STATES, 16);
  json_t *answer =
      python_ask(c->python, json_pack("{s:s, s:o}", "do", "matrices", "rows", rows), notes);
  if (!answer) return false;
  bench_note_check(notes, "disagreement", disagreement(c, answer), EIGENVALUES_AGREE);
  json_decref(answer);
  return true;
}

bool bench_jacobian_cases(bench_list *list) {
  jacobian_cases *c = bench_new(list, sizeof *c, NULL);
  c->subject = list->subject;
  c->python = list->python;
  const bench_contest contests[] = {
      {.name = "jacobian-differences",
       .question = "Jacobian with eigenvalues: finite differences and dgeev / lanes",
       .ours = {"bike_batch_linearize", batched, .context = c, .units = STATES},
       .theirs = {"finite differences", by_differences, .context = c, .units = STATES},
       .asked = 8,
       .possible = 10,
       .prepare = prepare_jacobian},
      {.name = "jacobian-eigenvalues",
       .question = "eigenvalues of one 4 x 4: numpy's batched eigvals / lanes",
       .ours = {"bike_batch_eigenvalues", own_eigenvalues, .context = c, .units = STATES},
       .theirs = {"numpy eigvals", .timed = numpy_eigenvalues, .context = c, .units = STATES},
       .prepare = prepare_eigenvalues}};
  bench_add_all(list, contests, sizeof contests / sizeof contests[0], c);
  return true;
}
