// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_straight.h"

#include <bicycle/error.h>
#include <float.h>
#include <math.h>

#include "motion/turn_terms.h"

int turn_straight_offset(bool *rides, double *offset, const turn_bicycle *bicycle, double lean) {
  const double rounding = 64 * DBL_EPSILON; // of the terms, as of solutions
  turn_forces at[2];
  *rides = false;
  for (int k = 0; k < 2; k++) {
    int code = turn_forces_at(&at[k], bicycle, lean, 0, k);
    if (code) return code;
  }
  // fall is linear in the offset, which moves nothing where there is no rider
  const double *a = at[0].fall, *b = at[1].fall;
  double per_offset = b[TURN_LEAN_ROW] - a[TURN_LEAN_ROW];
  *offset = per_offset != 0 ? -a[TURN_LEAN_ROW] / per_offset : 0;
  double terms = turn_row_terms(bicycle, turn_moments(bicycle, &at[0], 0, *offset));
  for (int i = 0; i < TURN_ROWS; i++)
    if (!(fabs(a[i] + *offset * (b[i] - a[i])) <= rounding * terms)) return BIKE_OK;
  *rides = true;
  return BIKE_OK;
}

// v^2/g of the speed at which turns of the same offset branch off: z/sin(steer) where both vanish.
static int capsize_square(double *out, const turn_curve *curve, double offset) {
  const double any[Y_SIZE] = {1, 1, 1}, upright[Y_SIZE] = {0};
  turn_curve own = *curve;
  double along[Y_SIZE];
  own.at_speed = false;
  own.offset = offset;
  int code = turn_curve_tangent(along, &own, upright, any);
  if (!code) *out = along[Y_LAST] / along[Y_STEER];
  return code;
}

static bool is_neutral(const turn_straight *straight, const turn_curve *curve) {
  // A capsize speed is known to some 1e-14 of it. Within 1e-11 of it the turns that branch off lean
  // by less than 1e-5 rad, from where on Newton's method tells them from none to four digits.
  const double rounding = 2e-11; // of the square
  const bike_turn_def *def = curve->def;
  double speed = def->value[BIKE_TURN_SPEED];
  double square = speed * speed / curve->bicycle->model->gravity;
  return def->given[BIKE_TURN_SPEED] &&
         fabs(square - straight->square) <= rounding * straight->square;
}

void turn_straight_find(turn_straight *out, const turn_curve *curve) {
  const double any[Y_SIZE] = {1, 1, 1}, same = 1e-15; // m
  double offset;
  bool rides;
  *out = (turn_straight){0};
  if (turn_straight_offset(&rides, &offset, curve->bicycle, 0) || !rides) return;
  if (!curve->at_speed && !(fabs(offset - curve->offset) <= same)) return;
  if (curve->at_speed) out->at.y[Y_LAST] = offset;
  out->on_curve = !turn_curve_tangent(out->at.along, curve, out->at.y, any) &&
                  !capsize_square(&out->square, curve, offset);
  out->neutral = out->on_curve && is_neutral(out, curve);
}

bool turn_straight_answers(const turn_straight *s, const turn_curve *curve,
                           bike_turn_variable variable, double value) {
  const double same = 1e-15; // rad, m
  return s->on_curve && (variable == BIKE_TURN_SPEED ||
                         fabs(turn_curve_beyond(curve, &s->at, variable, value)) <= same);
}

bool turn_straight_between(turn_straight *s, double reached[2], const turn_point *from,
                           const turn_point *to) {
  // The chord of two traced points misses the branch by less (turn_branch.c), and what is passed at
  // a point itself is passed on both sides of it.
  const double beside = 2e-3, at_end = 1e-6;
  double length = 0, along = 0, miss = 0, sense = 0;
  if (!s->on_curve) return false;
  for (int j = 0; j < Y_SIZE; j++) {
    length += from->along[j] * (to->y[j] - from->y[j]);
    along += from->along[j] * (s->at.y[j] - from->y[j]);
    sense += from->along[j] * s->at.along[j];
  }
  if (!(along >= -at_end && along <= length + at_end)) return false;
  for (int j = 0; j < Y_SIZE; j++) {
    double chord = from->y[j] + (to->y[j] - from->y[j]) * (along / length);
    miss = fmax(miss, fabs(s->at.y[j] - chord));
  }
  if (!(miss <= beside)) return false;
  for (int j = 0; j < Y_SIZE && sense < 0; j++) s->at.along[j] *= -1;
  reached[0] = along;
  reached[1] = length - along;
  return true;
}

bool turn_straight_apart(const turn_straight *s, const double y[Y_SIZE]) {
  // what branches off at a speed that is the capsize speed but for rounding, and any two solutions
  const double indistinct = s->neutral ? 1e-5 : 1e-6; // rad
  return !s->on_curve || fabs(y[Y_LEAN]) > indistinct || fabs(y[Y_STEER]) > indistinct;
}
