// SPDX-License-Identifier: Apache-2.0
#include "point.h"

#include <bicycle/error.h>
#include <math.h>

// Points of a row before it starts again.
enum { ROW = 200 };

static bike_turn_def question(const bench_row *row, double lean) {
  bike_turn_def def = bike_default_turn_def();
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_LEAN] = true;
  def.value[BIKE_TURN_SPEED] = row->speed;
  def.value[BIKE_TURN_LEAN] = lean;
  return def;
}

bool bench_row_begin(bench_row *row, const bike_model *model) {
  *row = (bench_row){.model = model, .speed = 6, .start = 0.02, .step = 1e-3};
  bike_turn_def def = question(row, row->start);
  static bike_turns found; // some kilobytes
  if (bike_turns_find(&found, model, &def)) return false;
  for (int i = 0; i < found.count; i++) {
    if (!found.turns[i].main_family) continue;
    row->first = found.turns[i];
    return true;
  }
  return false;
}

void bench_exact_points(void *context, long repeats) {
  bench_row *row = context;
  bike_turn turn = row->first, next;
  for (long i = 0; i < repeats; i++) {
    if (i % ROW == 0) turn = row->first;
    bike_turn_def def = question(row, bench_row_lean(row, i));
    if (bike_turn_near(&next, row->model, &def, &turn)) return;
    turn = next;
    row->sink = turn.eps_max;
  }
}

// Accelerations that have to vanish, over steer and rider offset.
static int residual(double out[2], const bench_row *row, double lean, const double x[2]) {
  bike_state s = {.lean = lean, .steer = x[0], .speed = row->speed};
  bike_input in = {.rider_offset = x[1]};
  bike_acceleration a;
  int code = bike_accelerate(&a, row->model, &s, &in);
  out[0] = a.steer;
  out[1] = a.lean;
  return code;
}

// Newton's method with forward differences, to what these can reach.
static int equilibrium(double x[2], const bench_row *row, double lean) {
  const double h = 1e-7;
  for (int step = 0; step < 6; step++) {
    double r[2], J[2][2];
    int code = residual(r, row, lean, x);
    for (int j = 0; j < 2 && !code; j++) {
      double moved[2] = {x[0], x[1]}, there[2];
      moved[j] += h;
      code = residual(there, row, lean, moved);
      for (int i = 0; i < 2; i++) J[i][j] = (there[i] - r[i]) / h;
    }
    if (code) return code;
    double det = J[0][0] * J[1][1] - J[0][1] * J[1][0];
    double d0 = (r[0] * J[1][1] - r[1] * J[0][1]) / det,
           d1 = (r[1] * J[0][0] - r[0] * J[1][0]) / det;
    x[0] -= d0;
    x[1] -= d1;
    if (fabs(d0) + fabs(d1) < 1e-9) return BIKE_OK;
  }
  return BIKE_ERROR_NO_CONVERGENCE;
}

// Steer'', lean'' and energy at the state (steer, lean, steer rate, lean rate, speed).
static int sampled(double out[3], const bike_model *model, const double y[5], double offset) {
  bike_state s = {
      .lean = y[1], .steer = y[0], .lean_rate = y[3], .steer_rate = y[2], .speed = y[4]};
  bike_input in = {.rider_offset = offset};
  bike_snapshot now;
  int code = bike_evaluate(&now, model, &s, &in);
  out[0] = now.acceleration.steer;
  out[1] = now.acceleration.lean;
  out[2] = now.kinetic + now.potential;
  return code;
}

int bench_differences(double A[16], const bike_model *model, const bike_state *state,
                      double offset) {
  const double h = 1e-6;
  double y[5] = {state->steer, state->lean, state->steer_rate, state->lean_rate, state->speed};
  double slope[3][5];
  for (int j = 0; j < 5; j++) {
    double up[5], down[5], above[3], below[3];
    for (int k = 0; k < 5; k++) up[k] = down[k] = y[k];
    up[j] += h;
    down[j] -= h;
    int code = sampled(above, model, up, offset);
    if (!code) code = sampled(below, model, down, offset);
    if (code) return code;
    for (int i = 0; i < 3; i++) slope[i][j] = (above[i] - below[i]) / (2 * h);
  }
  for (int k = 0; k < 8; k++) A[k] = k == 2 || k == 7;
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 4; j++)
      A[4 * (i + 2) + j] = slope[i][j] - slope[i][4] * slope[2][j] / slope[2][4];
  return BIKE_OK;
}

double bench_row_lean(const bench_row *row, long i) {
  return row->start + row->step * (double)(1 + i % ROW);
}

int bench_difference_point(bike_map_node *out, const bench_row *row, double lean,
                           const bike_map_node *from) {
  double x[2] = {from->steer, from->rider_offset}, A[16];
  int code = equilibrium(x, row, lean);
  if (code) return code;
  bike_state state = {.lean = lean, .steer = x[0], .speed = row->speed};
  code = bench_differences(A, row->model, &state, x[1]);
  if (!code) code = bike_eigenvalues_of(&out->eigenvalues, A);
  out->steer = x[0];
  out->rider_offset = x[1];
  out->eps_max = out->eigenvalues.re[0];
  return code;
}

static bike_map_node first_of(const bench_row *row) {
  return (bike_map_node){.steer = row->first.steer, .rider_offset = row->first.rider_offset};
}

void bench_difference_points(void *context, long repeats) {
  bench_row *row = context;
  bike_map_node node = first_of(row), next;
  for (long i = 0; i < repeats; i++) {
    if (i % ROW == 0) node = first_of(row);
    if (bench_difference_point(&next, row, bench_row_lean(row, i), &node)) return;
    node = next;
    row->sink = node.eps_max;
  }
}

// The largest of steer, rider offset and eps_max.
static double difference(const bike_map_node *a, const bike_map_node *b) {
  double worst = fmax(fabs(a->steer - b->steer), fabs(a->rider_offset - b->rider_offset));
  double rate = fabs(a->eps_max - b->eps_max);
  return isfinite(worst + rate) ? fmax(worst, rate) : INFINITY;
}

double bench_row_disagreement(const bench_row *row) {
  double leans[ROW + 1], worst = 0;
  leans[0] = row->start;
  for (long i = 0; i < ROW; i++) leans[i + 1] = bench_row_lean(row, i);
  static bike_map_node nodes[ROW + 1];
  bike_map_def def = {
      .speeds = &row->speed, .leans = leans, .speed_count = 1, .lean_count = ROW + 1, .threads = 1};
  if (bike_map_turns(nodes, row->model, &def)) return INFINITY;
  bike_map_node node = first_of(row), next = {0};
  bike_turn turn = row->first, beside;
  for (long i = 0; i < ROW; i++) {
    bike_turn_def wanted = question(row, leans[i + 1]);
    if (bench_difference_point(&next, row, leans[i + 1], &node) ||
        bike_turn_near(&beside, row->model, &wanted, &turn))
      return INFINITY;
    bike_map_node near = {
        .steer = beside.steer, .rider_offset = beside.rider_offset, .eps_max = beside.eps_max};
    worst = fmax(worst, fmax(difference(&next, &nodes[i + 1]), difference(&near, &nodes[i + 1])));
    node = next;
    turn = beside;
  }
  return worst;
}
