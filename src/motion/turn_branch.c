// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_branch.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Coordinates are of the order of one. Steps between 3 deg, a little over a mesh of the grid, and
// what is still told from rounding where the geometry ends.
static const double FIRST_STEP = 0.02, LONGEST_STEP = 0.05, SHORTEST_STEP = 1e-7;
// A step that turns by more than 15 deg, or lands beside its target by more than a third of its
// length, may have left for another branch.
static const double SMALLEST_COSINE = 0.966, LARGEST_MISS = 0.33;
// Chords of 3 deg on arcs that turn by 15 deg at most miss the branch by a thirtieth of the chord.
static const double CHORD_MISS = 2e-3;
// Points of a branch: an end to walks that never close, far beyond the longest branch seen (700).
enum { MOST_POINTS = 20000 };
// Last coordinates beyond which no rider (m) and no road (v^2/(g R)) go.
static const double FARTHEST = 100;

static double distance(const double a[Y_SIZE], const double b[Y_SIZE]) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

static double ahead(const turn_point *from, const double y[Y_SIZE]) {
  double sum = 0;
  for (int j = 0; j < Y_SIZE; j++) sum += from->along[j] * (y[j] - from->y[j]);
  return sum;
}

static int append(turn_branch *b, const turn_point *point) {
  if (b->count == b->room) {
    size_t room = b->room ? 2 * b->room : 128;
    turn_point *grown = realloc(b->at, room * sizeof *grown);
    if (!grown) return BIKE_ERROR_MEMORY;
    b->at = grown;
    b->room = room;
  }
  b->at[b->count++] = *point;
  return BIKE_OK;
}

// Beside a place where v^2 sin(steer) is infinite, with a wheel turned across, two arcs come so
// close that a step may leave one for the other. Their last coordinates differ in sign, and so does
// what they multiply; where a branch passes zero speed that keeps its sense.
static bool jumps(const turn_curve *curve, const turn_point *from, const turn_point *to) {
  if (curve->at_speed || (from->y[Y_LAST] < 0) == (to->y[Y_LAST] < 0)) return false;
  double f[TURN_ROWS], a[TURN_ROWS][Y_SIZE], b[TURN_ROWS][Y_SIZE], sense = 0;
  if (turn_curve_equations(f, a, curve, from->y) || turn_curve_equations(f, b, curve, to->y))
    return true;
  for (int i = 0; i < TURN_ROWS; i++) sense += a[i][Y_LAST] * b[i][Y_LAST];
  return sense < 0;
}

// One step of a length; false where it must be shorter.
static bool step(turn_point *out, const turn_curve *curve, newton *solver, const turn_point *from,
                 double length) {
  turn_point next;
  for (int j = 0; j < Y_SIZE; j++) next.y[j] = from->y[j] + length * from->along[j];
  double target[Y_SIZE], residual, cosine = 0;
  memcpy(target, next.y, sizeof target);
  if (turn_curve_correct(&next, &residual, curve, solver, from, length)) return false;
  for (int j = 0; j < Y_SIZE; j++) cosine += from->along[j] * next.along[j];
  if (!(cosine >= SMALLEST_COSINE) || !(distance(target, next.y) <= LARGEST_MISS * length))
    return false;
  if (jumps(curve, from, &next)) return false;
  *out = next;
  return true;
}

// Whether the step from a to b passes the branch's first point.
static bool passes_start(const turn_branch *b, const turn_point *from, const turn_point *to) {
  const size_t too_few = 4; // the start itself is left behind
  if (b->count < too_few) return false;
  double length = ahead(from, to->y), reached = ahead(from, b->at[0].y), beside[Y_SIZE];
  if (!(reached > 0 && reached <= length)) return false;
  for (int j = 0; j < Y_SIZE; j++) beside[j] = from->y[j] + reached * from->along[j];
  return distance(beside, b->at[0].y) <= LARGEST_MISS * length;
}

static bool beyond(const turn_curve *curve, const double y[Y_SIZE]) {
  return !turn_curve_within(curve, y) || fabs(y[Y_LAST]) > FARTHEST;
}

// Appends points until the branch ends; `closed` tells whether it came back.
static int walk(turn_branch *b, bool *closed, const turn_curve *curve, newton *solver) {
  double length = FIRST_STEP;
  *closed = false;
  while (b->count < MOST_POINTS) {
    turn_point from = b->at[b->count - 1], to;
    if (beyond(curve, from.y)) return BIKE_OK;
    while (!step(&to, curve, solver, &from, length))
      if ((length *= 0.5) < SHORTEST_STEP) return BIKE_OK;
    *closed = passes_start(b, &from, &to);
    int code = append(b, *closed ? &b->at[0] : &to);
    if (code || *closed) return code;
    length = fmin(1.5 * length, LONGEST_STEP);
  }
  return BIKE_OK;
}

static void reverse(turn_branch *b) {
  for (size_t i = 0, k = b->count; i < k--; i++) {
    turn_point swapped = b->at[i];
    b->at[i] = b->at[k];
    b->at[k] = swapped;
  }
  for (size_t i = 0; i < b->count; i++)
    for (int j = 0; j < Y_SIZE; j++) b->at[i].along[j] *= -1;
}

int turn_branch_land(turn_point *out, double *residual, const turn_curve *curve, newton *solver,
                     const double y[Y_SIZE]) {
  const double any[Y_SIZE] = {1, 1, 1}; // sense of a tangent
  turn_point near;
  memcpy(near.y, y, sizeof near.y);
  int code = turn_curve_tangent(near.along, curve, y, any);
  if (code) return code;
  turn_point found = near;
  code = turn_curve_correct(&found, residual, curve, solver, &near, 0);
  if (code || !(distance(found.y, y) <= LONGEST_STEP)) return BIKE_ERROR_NO_CONVERGENCE;
  if (beyond(curve, found.y)) return BIKE_ERROR_NO_CONVERGENCE;
  *out = found;
  return BIKE_OK;
}

int turn_branch_trace(turn_branch *out, const turn_curve *curve, newton *solver,
                      const turn_point *start) {
  *out = (turn_branch){0};
  int code = append(out, start);
  bool closed = false;
  if (!code) code = walk(out, &closed, curve, solver);
  if (code || closed) return code;
  reverse(out);
  return walk(out, &closed, curve, solver);
}

void turn_branch_free(turn_branch *branch) {
  free(branch->at);
  *branch = (turn_branch){0};
}

static double chord_distance(const double a[Y_SIZE], const double b[Y_SIZE],
                             const double y[Y_SIZE]) {
  double along = 0, square = 0, foot[Y_SIZE];
  for (int j = 0; j < Y_SIZE; j++) {
    along += (b[j] - a[j]) * (y[j] - a[j]);
    square += (b[j] - a[j]) * (b[j] - a[j]);
  }
  double share = square > 0 ? fmin(1, fmax(0, along / square)) : 0;
  for (int j = 0; j < Y_SIZE; j++) foot[j] = a[j] + share * (b[j] - a[j]);
  return distance(foot, y);
}

bool turn_branch_covers(const turn_branch *branch, const double y[Y_SIZE]) {
  for (size_t i = 1; i < branch->count; i++)
    if (chord_distance(branch->at[i - 1].y, branch->at[i].y, y) <= CHORD_MISS) return true;
  return false;
}
