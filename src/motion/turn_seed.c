// SPDX-License-Identifier: Apache-2.0
// One of the unknowns is eliminated in closed form, which leaves one function of lean and steer
// whose zeros are the curve. At a fixed offset v^2 sin(steer) goes out linearly. At a fixed speed
// the offset goes out through the lean row, a quadratic, whose two roots are two sheets.
#include "motion/turn_seed.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// The mesh: a tenth of the range of lean in which steady turns were ever ridden.
static const double MESH = 2.5 * (3.14159265358979323846 / 180);

enum { SHEETS = 2 };

// The function left and the unknown eliminated, per sheet; NaN where there is none.
typedef struct turn_node {
  double value[SHEETS], last[SHEETS];
} turn_node;

static const turn_node NOWHERE = {{NAN, NAN}, {NAN, NAN}};

// fall + s sweep = 0 for s: crossed rows, then the least squares, in inertia's measure.
static turn_node without_speed(const turn_curve *c, double lean, double steer) {
  turn_forces f;
  if (turn_forces_at(&f, &c->bicycle, lean, steer, c->offset)) return NOWHERE;
  f.fall[TURN_STEER_ROW] += c->torque;
  double dot = 0, square = 0;
  for (int i = 0; i < TURN_ROWS; i++) {
    double fall = f.fall[i] * c->per_inertia[i], sweep = f.sweep[i] * c->per_inertia[i];
    dot += fall * sweep;
    square += sweep * sweep;
  }
  turn_node node = NOWHERE;
  node.value[0] = f.fall[0] * f.sweep[1] - f.fall[1] * f.sweep[0];
  node.last[0] = -dot / square / c->bicycle.model->gravity;
  return node;
}

// Coefficients of the forces in powers of the offset, from offsets of -1, 0 and 1 m.
static int in_offset(double out[TURN_ROWS][3], const turn_curve *c, double lean, double steer) {
  double s = c->square * sin(steer), total[3][TURN_ROWS];
  for (int k = 0; k < 3; k++) {
    turn_forces f;
    int code = turn_forces_at(&f, &c->bicycle, lean, steer, k - 1);
    if (code) return code;
    f.fall[TURN_STEER_ROW] += c->torque;
    for (int i = 0; i < TURN_ROWS; i++) total[k][i] = f.fall[i] + s * f.sweep[i];
  }
  for (int i = 0; i < TURN_ROWS; i++) {
    out[i][0] = total[1][i];
    out[i][1] = 0.5 * (total[2][i] - total[0][i]);
    out[i][2] = 0.5 * (total[2][i] + total[0][i]) - total[1][i];
  }
  return BIKE_OK;
}

static double polynomial(const double a[3], double w) {
  return a[0] + w * (a[1] + w * a[2]);
}

// a0 + a1 w + a2 w^2 = 0. Sheet 0 has the minus sign before the root, sheet 1 the plus sign; each
// is continuous where a1 or a2 change theirs, as long as it stays finite.
static void roots(double out[SHEETS], const double a[3]) {
  double root = sqrt(a[1] * a[1] - 4 * a[0] * a[2]); // NaN: none
  double sum = a[1] > 0 ? -a[1] - root : -a[1] + root;
  out[a[1] > 0 ? 0 : 1] = sum / (2 * a[2]);
  out[a[1] > 0 ? 1 : 0] = 2 * a[0] / sum;
}

static turn_node without_offset(const turn_curve *c, double lean, double steer) {
  double a[TURN_ROWS][3];
  if (in_offset(a, c, lean, steer)) return NOWHERE;
  turn_node node;
  roots(node.last, a[TURN_LEAN_ROW]);
  // a mesh may end beyond the limit
  const double beyond = 1.25;
  for (int k = 0; k < SHEETS; k++) {
    bool reached = fabs(node.last[k]) <= beyond * c->def->offset_limit;
    node.value[k] = reached ? polynomial(a[TURN_STEER_ROW], node.last[k]) : NAN;
  }
  return node;
}

static turn_node node_at(const turn_curve *c, double lean, double steer) {
  return c->at_speed ? without_offset(c, lean, steer) : without_speed(c, lean, steer);
}

static bool crosses(double a, double b) {
  return isfinite(a) && isfinite(b) && (a < 0) != (b < 0);
}

static int keep(turn_seeds *out, const double y[Y_SIZE]) {
  if (out->count == out->room) {
    size_t room = out->room ? 2 * out->room : 64;
    double(*grown)[Y_SIZE] = realloc(out->y, room * sizeof *grown);
    if (!grown) return BIKE_ERROR_MEMORY;
    out->y = grown;
    out->room = room;
  }
  memcpy(out->y[out->count++], y, Y_SIZE * sizeof y[0]);
  return BIKE_OK;
}

typedef struct turn_corner {
  double lean, steer;
  turn_node node;
} turn_corner;

// Halves the edge between two corners until the zero is known to 1e-6 rad.
static int seed_on_edge(turn_seeds *out, const turn_curve *c, turn_corner a, turn_corner b,
                        int sheet) {
  const int halvings = 16; // of the mesh
  for (int i = 0; i < halvings; i++) {
    turn_corner m = {.lean = 0.5 * (a.lean + b.lean), .steer = 0.5 * (a.steer + b.steer)};
    m.node = node_at(c, m.lean, m.steer);
    if (!isfinite(m.node.value[sheet])) return BIKE_OK; // a gap, not a zero
    if (crosses(a.node.value[sheet], m.node.value[sheet]))
      b = m;
    else
      a = m;
  }
  double y[Y_SIZE] = {0.5 * (a.lean + b.lean), 0.5 * (a.steer + b.steer),
                      0.5 * (a.node.last[sheet] + b.node.last[sheet])};
  return keep(out, y);
}

static int seeds_on_edge(turn_seeds *out, const turn_curve *c, turn_corner a, turn_corner b) {
  int code = BIKE_OK;
  for (int sheet = 0; sheet < SHEETS && !code; sheet++)
    if (crosses(a.node.value[sheet], b.node.value[sheet]))
      code = seed_on_edge(out, c, a, b, sheet);
  return code;
}

// Nodes lie symmetrically to zero, none on it: symmetric bicycles have a zero at upright.
static int node_count(double limit) {
  return 2 * (int)ceil(limit / MESH);
}

static double node_place(int i, int count, double limit) {
  return limit * ((2 * i + 1.0) / count - 1);
}

static void fill_row(turn_corner *row, int count, const turn_curve *c, double lean) {
  for (int j = 0; j < count; j++) {
    row[j] = (turn_corner){.lean = lean, .steer = node_place(j, count, c->def->steer_limit)};
    row[j].node = node_at(c, lean, row[j].steer);
  }
}

static int scan(turn_seeds *out, const turn_curve *c, turn_corner *before, turn_corner *row,
                int columns) {
  int rows = node_count(c->def->lean_limit), code = BIKE_OK;
  for (int i = 0; i < rows && !code; i++) {
    fill_row(row, columns, c, node_place(i, rows, c->def->lean_limit));
    for (int j = 0; j < columns && !code; j++) {
      if (j > 0) code = seeds_on_edge(out, c, row[j - 1], row[j]);
      if (i > 0 && !code) code = seeds_on_edge(out, c, before[j], row[j]);
    }
    turn_corner *old = before;
    before = row;
    row = old;
  }
  return code;
}

int turn_seeds_find(turn_seeds *out, const turn_curve *curve) {
  *out = (turn_seeds){0};
  int columns = node_count(curve->def->steer_limit);
  turn_corner *corners = calloc(2 * (size_t)columns, sizeof *corners);
  if (!corners) return BIKE_ERROR_MEMORY;
  int code = scan(out, curve, corners, corners + columns, columns);
  free(corners);
  return code;
}

void turn_seeds_free(turn_seeds *seeds) {
  free(seeds->y);
  *seeds = (turn_seeds){0};
}
