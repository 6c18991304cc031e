// SPDX-License-Identifier: Apache-2.0
// Maps: a full point, that is a stationary turn with its stability, and eigenvalues alone.
#include "peers/python.h"
#include "point.h"
#include "terminal/json.h"
#include "work.h"

#include <bicycle/linear.h>
#include <bicycle/stability.h>
#include <math.h>

// Matrices of one call: a row of a map.
enum { MATRICES = 256 };

typedef struct map_cases {
  bench_subject *subject;
  python_peer *python;
  bench_row row;
  bool has_row;
  double A[MATRICES][16];
  double sink;
} map_cases;

static bool prepare_row(void *context, bench_notes *notes) {
  map_cases *c = context;
  if (!c->has_row) c->has_row = bench_row_begin(&c->row, &c->subject->model);
  return c->has_row || bench_note_reason(notes, "no stationary turn to start from");
}

//---------------------------------- eigenvalues ---------------------------------------------------

static void own_eigenvalues(void *context, long repeats) {
  map_cases *c = context;
  bike_eigenvalues e = {0};
  double sum = 0;
  for (long i = 0; i < repeats; i++) {
    for (int k = 0; k < MATRICES; k++) {
      bike_eigenvalues_of(&e, c->A[k]);
      sum += e.re[0];
    }
  }
  c->sink = sum;
}

static double numpy_eigenvalues(void *context, long repeats) {
  map_cases *c = context;
  return python_seconds(
      c->python, json_pack("{s:s, s:I}", "do", "eigenvalues", "repeats", (json_int_t)repeats));
}

// Upright riding from 1 to 10 m/s: real eigenvalues and pairs, stable and not.
static bool fill_matrices(map_cases *c) {
  for (int k = 0; k < MATRICES; k++) {
    bike_linear linear;
    bike_state state = {.speed = 1 + 9.0 * k / (MATRICES - 1)};
    if (bike_linearize(&linear, &c->subject->model, &state, NULL)) return false;
    for (int i = 0; i < 16; i++) c->A[k][i] = linear.A[i];
  }
  return true;
}

static double at(const json_t *answer, const char *key, int index) {
  const json_t *value = json_array_get(json_object_get(answer, key), (size_t)index);
  return json_is_number(value) ? json_number_value(value) : NAN;
}

// Relative to the largest of each matrix.
static double disagreement(const map_cases *c, const json_t *answer) {
  double worst = 0;
  for (int k = 0; k < MATRICES; k++) {
    bike_eigenvalues e;
    if (bike_eigenvalues_of(&e, c->A[k])) return INFINITY;
    double scale = 0, off = 0;
    for (int i = 0; i < 4; i++) {
      double error =
          hypot(e.re[i] - at(answer, "re", 4 * k + i), e.im[i] - at(answer, "im", 4 * k + i));
      if (isnan(error)) return INFINITY;
      off = fmax(off, error);
      scale = fmax(scale, hypot(e.re[i], e.im[i]));
    }
    worst = fmax(worst, off / scale);
  }
  return worst;
}

// Two that are about to meet carry the root of the rounding, some 1e-8; others a hundred roundings.
// No speed of the row is that close to a meeting.
static const double EIGENVALUES_AGREE = 1e-10;

static bool prepare_eigenvalues(void *context, bench_notes *notes) {
  map_cases *c = context;
  if (!fill_matrices(c)) return bench_note_reason(notes, "the bicycle has no linearisation");
  json_t *rows = term_json_matrix(c->A[0], MATRICES, 16);
  json_t *answer =
      python_ask(c->python, json_pack("{s:s, s:o}", "do", "matrices", "rows", rows), notes);
  if (!answer) return false;
  bench_note_check(notes, "disagreement", disagreement(c, answer), EIGENVALUES_AGREE);
  json_decref(answer);
  return true;
}

bool bench_map_cases(bench_list *list) {
  map_cases *c = bench_new(list, sizeof *c, NULL);
  c->subject = list->subject;
  c->python = list->python;
  const bench_runner point = {"bike_turn_near", bench_exact_points, .context = &c->row};
  const bench_contest contests[] = {
      {.name = "map-point",
       .question = "full (speed, lean) point / one right-hand side",
       .ours = point,
       .theirs = {"bike_rates_of", bench_right_hand_sides, .context = c->subject},
       .sense = BENCH_AT_MOST,
       .asked = 18,
       .possible = 17.4,
       .prepare = prepare_row},
      {.name = "map-differences",
       .question = "full point by finite differences and dgeev / ours",
       .ours = point,
       .theirs = {"finite differences", bench_difference_points, .context = &c->row},
       .prepare = prepare_row},
      {.name = "map-eigenvalues",
       .question = "eigenvalues of one 4 x 4: numpy's batched eigvals / ours",
       .ours = {"bike_eigenvalues_of", own_eigenvalues, .context = c, .units = MATRICES},
       .theirs = {"numpy eigvals", .timed = numpy_eigenvalues, .context = c, .units = MATRICES},
       .prepare = prepare_eigenvalues}};
  bench_add_all(list, contests, sizeof contests / sizeof contests[0], c);
  return true;
}
