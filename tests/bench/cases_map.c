// SPDX-License-Identifier: Apache-2.0
// Maps: a full point, that is a stationary turn with the eigenvalues of its stability.
#include "point.h"
#include "work.h"

#include <math.h>

// A grid like that of figure 2, coarser: speeds and leans.
enum { SPEEDS = 48, LEANS = 91 };
static const double SLOWEST = 4, FASTEST = 9;       // m/s
static const double FARTHEST = 0.78539816339744831; // rad, 45 degrees

typedef struct map_cases {
  bench_subject *subject;
  bench_row row;
  bool has_row;
  double speeds[SPEEDS], leans[LEANS];
  bike_map_node nodes[SPEEDS * LEANS];
} map_cases;

static int whole_map(map_cases *c) {
  bike_map_def def = {.speeds = c->speeds,
                      .leans = c->leans,
                      .speed_count = SPEEDS,
                      .lean_count = LEANS,
                      .threads = 1};
  return bike_map_turns(c->nodes, &c->subject->model, &def);
}

static void maps(void *context, long repeats) {
  for (long k = 0; k < repeats; k++) whole_map(context);
}

// Newton's method by forward differences ends within 1e-9 and eigenvalues by central ones are good
// to some 1e-8, times what the stability changes by per radian.
static const double POINTS_AGREE = 1e-6;

// Points by bike_turn_near and by differences are those of the map.
static bool prepare_row(void *context, bench_notes *notes) {
  map_cases *c = context;
  if (!c->has_row) c->has_row = bench_row_begin(&c->row, &c->subject->model);
  if (!c->has_row) return bench_note_reason(notes, "no stationary turn to start from");
  bench_note_check(notes, "disagreement", bench_row_disagreement(&c->row), POINTS_AGREE);
  return true;
}

static bool prepare_map(void *context, bench_notes *notes) {
  map_cases *c = context;
  if (!prepare_row(c, notes)) return false;
  for (int i = 0; i < SPEEDS; i++) c->speeds[i] = SLOWEST + (FASTEST - SLOWEST) * i / (SPEEDS - 1);
  for (int j = 0; j < LEANS; j++) c->leans[j] = FARTHEST * j / (LEANS - 1);
  if (whole_map(c)) return bench_note_reason(notes, "the bicycle has no map");
  int without = 0;
  for (int k = 0; k < SPEEDS * LEANS; k++) without += c->nodes[k].error != 0;
  bench_note_value(notes, "points", SPEEDS * LEANS);
  bench_note_value(notes, "points without a turn", without);
  return true;
}

bool bench_map_cases(bench_list *list) {
  map_cases *c = bench_new(list, sizeof *c, NULL);
  c->subject = list->subject;
  const bench_runner map = {"bike_map_turns", maps, .context = c, .units = SPEEDS * LEANS};
  const bench_runner one = {"bike_rates_of", bench_right_hand_sides, .context = c->subject};
  const bench_contest contests[] = {
      {.name = "map-point",
       .question = "full (speed, lean) point of a map / one right-hand side",
       .ours = map,
       .theirs = one,
       .sense = BENCH_AT_MOST,
       .asked = 18,
       .possible = 17.4,
       .prepare = prepare_map},
      {.name = "map-point-alone",
       .question = "full (speed, lean) point by bike_turn_near / one right-hand side",
       .ours = {"bike_turn_near", bench_exact_points, .context = &c->row},
       .theirs = one,
       .sense = BENCH_AT_MOST,
       .prepare = prepare_row},
      {.name = "map-differences",
       .question = "full point: finite differences and dgeev / of a map",
       .ours = map,
       .theirs = {"finite differences", bench_difference_points, .context = &c->row},
       .prepare = prepare_map}};
  bench_add_all(list, contests, sizeof contests / sizeof contests[0], c);
  return true;
}
