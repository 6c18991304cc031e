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

// fall + s sweep = 0: the rows crossed, and s of least squares.
static turn_node without_speed(const turn_curve *c, double lean, double steer) {
  turn_forces f;
  if (turn_forces_at(&f, c->bicycle, lean, steer, c->offset)) return NOWHERE;
  double dot = 0, square = 0;
  for (int i = 0; i < TURN_ROWS; i++) {
    dot += f.fall[i] * f.sweep[i];
    square += f.sweep[i] * f.sweep[i];
  }
  turn_node node = NOWHERE;
  node.value[0] = f.fall[0] * f.sweep[1] - f.fall[1] * f.sweep[0];
  node.last[0] = -dot / square / c->bicycle->model->gravity;
  return node;
}

// Coefficients of the forces in powers of the offset, from offsets of -1, 0 and 1 m.
static int in_offset(double out[TURN_ROWS][3], const turn_curve *c, double lean, double steer) {
  double s = c->square * sin(steer), total[3][TURN_ROWS];
  for (int k = 0; k < 3; k++) {
    turn_forces f;
    int code = turn_forces_at(&f, c->bicycle, lean, steer, k - 1);
    if (code) return code;
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
    if (crosses(a.node.value[sheet], b.node.value[sheet])) code = seed_on_edge(out, c, a, b, sheet);
  return code;
}

// Places of the lines of a grid: symmetric to zero, none on it (symmetric bicycles have a zero at
// upright), the outermost at the limits. Meshes shrink within `fine` of zero.
typedef struct turn_lines {
  int count;
  double *at;
} turn_lines;

static double mesh_at(double place, double fine) {
  return MESH * fmin(1, hypot(fine, place));
}

static int lines_init(turn_lines *out, double limit, double fine) {
  int half = 1;
  for (double place = 0.5 * mesh_at(0, fine); place < limit; half++) place += mesh_at(place, fine);
  *out = (turn_lines){2 * half, calloc(2 * (size_t)half, sizeof(double))};
  if (!out->at) return BIKE_ERROR_MEMORY;
  double place = 0.5 * mesh_at(0, fine);
  for (int i = 0; i < half; i++) {
    out->at[half + i] = fmin(place, limit);
    out->at[half - 1 - i] = -out->at[half + i];
    place += mesh_at(place, fine);
  }
  return BIKE_OK;
}

static void fill_row(turn_corner *row, const turn_lines *steer, const turn_curve *c, double lean) {
  for (int j = 0; j < steer->count; j++) {
    row[j] = (turn_corner){.lean = lean, .steer = steer->at[j]};
    row[j].node = node_at(c, lean, row[j].steer);
  }
}

static int scan(turn_seeds *out, const turn_curve *c, const turn_lines *lean,
                const turn_lines *steer, turn_corner *corners) {
  turn_corner *before = corners, *row = corners + steer->count;
  int code = BIKE_OK;
  for (int i = 0; i < lean->count && !code; i++) {
    fill_row(row, steer, c, lean->at[i]);
    for (int j = 0; j < steer->count && !code; j++) {
      if (j > 0) code = seeds_on_edge(out, c, row[j - 1], row[j]);
      if (i > 0 && !code) code = seeds_on_edge(out, c, before[j], row[j]);
    }
    turn_corner *old = before;
    before = row;
    row = old;
  }
  return code;
}

static double from_upright(const double y[Y_SIZE]) {
  return hypot(y[Y_LEAN], y[Y_STEER]);
}

// All numbers count: where qsort finds no memory it takes equals in any order.
static int outwards(const void *a, const void *b) {
  double x = from_upright(a), y = from_upright(b);
  const double *p = a, *q = b;
  for (int i = 0; x == y && i < Y_SIZE; i++) {
    x = p[i];
    y = q[i];
  }
  return (x > y) - (x < y);
}

// Steer that takes a bicycle of some 1 m wheelbase round a circle at 1 g: at high speed everything
// happens within it.
static double fine_steer(const turn_curve *c) {
  double speed = c->def->speed_limit, square = c->at_speed ? c->square : speed * speed;
  return c->bicycle->model->gravity / fmax(square, c->bicycle->model->gravity);
}

int turn_seeds_find(turn_seeds *out, const turn_curve *c) {
  *out = (turn_seeds){0};
  turn_lines lean = {0}, steer = {0};
  int code = lines_init(&lean, c->def->lean_limit, 1);
  if (!code) code = lines_init(&steer, c->def->steer_limit, fine_steer(c));
  turn_corner *corners = code ? NULL : calloc(2 * (size_t)steer.count, sizeof *corners);
  if (!code) code = corners ? scan(out, c, &lean, &steer, corners) : BIKE_ERROR_MEMORY;
  free(corners);
  free(lean.at);
  free(steer.at);
  if (out->count > 0) qsort(out->y, out->count, sizeof out->y[0], outwards);
  return code;
}

void turn_seeds_free(turn_seeds *seeds) {
  free(seeds->y);
  *seeds = (turn_seeds){0};
}
