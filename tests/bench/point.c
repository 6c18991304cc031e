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
    bike_turn_def def = question(row, row->start + row->step * (double)(1 + i % ROW));
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
static int sampled(double out[3], const bench_row *row, const double y[5], double offset) {
  bike_state s = {
      .lean = y[1], .steer = y[0], .lean_rate = y[3], .steer_rate = y[2], .speed = y[4]};
  bike_input in = {.rider_offset = offset};
  bike_snapshot now;
  int code = bike_evaluate(&now, row->model, &s, &in);
  out[0] = now.acceleration.steer;
  out[1] = now.acceleration.lean;
  out[2] = now.kinetic + now.potential;
  return code;
}

static int difference_eigenvalues(bike_eigenvalues *out, const bench_row *row, double lean,
                                  const double x[2]) {
  const double h = 1e-6;
  double y[5] = {x[0], lean, 0, 0, row->speed}, slope[3][5];
  for (int j = 0; j < 5; j++) {
    double up[5], down[5], above[3], below[3];
    for (int k = 0; k < 5; k++) up[k] = down[k] = y[k];
    up[j] += h;
    down[j] -= h;
    int code = sampled(above, row, up, x[1]);
    if (!code) code = sampled(below, row, down, x[1]);
    if (code) return code;
    for (int i = 0; i < 3; i++) slope[i][j] = (above[i] - below[i]) / (2 * h);
  }
  double A[16] = {0, 0, 1, 0, 0, 0, 0, 1};
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 4; j++)
      A[4 * (i + 2) + j] = slope[i][j] - slope[i][4] * slope[2][j] / slope[2][4];
  return bike_eigenvalues_of(out, A);
}

void bench_difference_points(void *context, long repeats) {
  bench_row *row = context;
  double x[2] = {row->first.steer, row->first.rider_offset};
  for (long i = 0; i < repeats; i++) {
    if (i % ROW == 0) {
      x[0] = row->first.steer;
      x[1] = row->first.rider_offset;
    }
    double lean = row->start + row->step * (double)(1 + i % ROW);
    bike_eigenvalues e;
    if (equilibrium(x, row, lean) || difference_eigenvalues(&e, row, lean, x)) return;
    row->sink = e.re[0];
  }
}
