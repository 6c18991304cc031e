// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_curve.h"

#include <bicycle/error.h>
#include <float.h>
#include <math.h>

#include "motion/turn_terms.h"

turn_curve turn_curve_of(const turn_bicycle *bicycle, const bike_turn_def *def, bool at_speed) {
  turn_curve c = {.bicycle = bicycle, .def = def, .at_speed = at_speed};
  double speed = def->value[BIKE_TURN_SPEED];
  if (at_speed)
    c.square = speed * speed;
  else if (def->given[BIKE_TURN_OFFSET])
    c.offset = def->value[BIKE_TURN_OFFSET];
  return c;
}

double turn_curve_offset(const turn_curve *c, const double y[Y_SIZE]) {
  return c->at_speed ? y[Y_LAST] : c->offset;
}

// v^2 sin(steer)
static double swept(const turn_curve *c, const double y[Y_SIZE]) {
  return c->at_speed ? c->square * sin(y[Y_STEER]) : c->bicycle->model->gravity * y[Y_LAST];
}

double turn_curve_square(const turn_curve *c, const double y[Y_SIZE]) {
  return c->at_speed ? c->square : swept(c, y) / sin(y[Y_STEER]);
}

// f = fall + v^2 sin(steer) sweep
int turn_curve_equations(double f[TURN_ROWS], double J[TURN_ROWS][Y_SIZE], const turn_curve *c,
                         const double y[Y_SIZE]) {
  double offset = turn_curve_offset(c, y), s = swept(c, y);
  turn_forces at;
  int code = turn_forces_at(&at, c->bicycle, y[Y_LEAN], y[Y_STEER], offset);
  if (code) return code;
  for (int i = 0; i < TURN_ROWS; i++) f[i] = at.fall[i] + s * at.sweep[i];
  if (!J) return BIKE_OK;

  turn_slopes d = {.wanted = {true, true, c->at_speed}};
  code = c->at_speed
             ? turn_slopes_at_speed(&d, c->bicycle, y[Y_LEAN], y[Y_STEER], offset, c->square)
             : turn_slopes_at_swept(&d, c->bicycle, y[Y_LEAN], y[Y_STEER], offset, s);
  if (code) return code;
  for (int i = 0; i < TURN_ROWS; i++) {
    J[i][Y_LEAN] = d.of[i][BY_LEAN];
    J[i][Y_STEER] = d.of[i][BY_STEER];
    J[i][Y_LAST] = c->at_speed ? d.of[i][BY_OFFSET] : c->bicycle->model->gravity * at.sweep[i];
  }
  return BIKE_OK;
}

static double product(const double a[Y_SIZE], const double b[Y_SIZE]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int turn_curve_tangent(double along[Y_SIZE], const turn_curve *c, const double y[Y_SIZE],
                       const double direction[Y_SIZE]) {
  double f[TURN_ROWS], J[TURN_ROWS][Y_SIZE];
  int code = turn_curve_equations(f, J, c, y);
  if (code) return code;
  const double *a = J[0], *b = J[1];
  double t[Y_SIZE] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]};
  double length = sqrt(product(t, t));
  if (!(length > 0) || !isfinite(length)) return BIKE_ERROR_NO_CONVERGENCE;
  if (product(t, direction) < 0) length = -length;
  for (int j = 0; j < Y_SIZE; j++) along[j] = t[j] / length;
  return BIKE_OK;
}

bool turn_curve_degenerate(const turn_curve *c, const double y[Y_SIZE]) {
  const turn_forces none = {0};
  double f[TURN_ROWS], J[TURN_ROWS][Y_SIZE];
  if (turn_curve_equations(f, J, c, y)) return false;
  // of the weight's terms, as of solutions
  double moments = turn_moments(c->bicycle, &none, 0, turn_curve_offset(c, y));
  double rounding = 64 * DBL_EPSILON * turn_row_terms(c->bicycle, moments);
  return product(J[0], J[0]) <= rounding * rounding || product(J[1], J[1]) <= rounding * rounding;
}

typedef struct plane_question {
  const turn_curve *curve;
  const turn_point *from;
  double distance;
} plane_question;

// The two equations, and the plane.
static int in_plane(double *f, double J[NEWTON_MAX][NEWTON_MAX], const double *y,
                    const void *user) {
  const plane_question *q = user;
  int code = turn_curve_equations(f, J, q->curve, y);
  if (code) return code;
  f[2] = -q->distance;
  for (int j = 0; j < Y_SIZE; j++) {
    f[2] += q->from->along[j] * (y[j] - q->from->y[j]);
    if (J) J[2][j] = q->from->along[j];
  }
  return BIKE_OK;
}

// Whether what Newton's method has left is no more than a share of the terms.
static int solved(bool *out, const turn_curve *c, const double y[Y_SIZE], double residual,
                  double share) {
  double offset = turn_curve_offset(c, y);
  turn_forces at;
  int code = turn_forces_at(&at, c->bicycle, y[Y_LEAN], y[Y_STEER], offset);
  if (code) return code;
  double moments = turn_moments(c->bicycle, &at, swept(c, y), offset);
  *out = residual <= share * turn_row_terms(c->bicycle, moments);
  return BIKE_OK;
}

static int correct(turn_point *out, double *residual, const turn_curve *curve, newton *solver,
                   const turn_point *from, double distance, double share) {
  plane_question question = {curve, from, distance};
  turn_point found = *out;
  bool good;
  if (newton_solve(solver, found.y, residual, in_plane, &question)) return BIKE_ERROR_GEOMETRY;
  int code = solved(&good, curve, found.y, *residual, share);
  if (code) return code;
  if (!good) return BIKE_ERROR_NO_CONVERGENCE;
  code = turn_curve_tangent(found.along, curve, found.y, from->along);
  if (!code) *out = found;
  return code;
}

int turn_curve_correct(turn_point *out, double *residual, const turn_curve *curve, newton *solver,
                       const turn_point *from, double distance) {
  // some roundings, and more where slopes carry on those of the coordinates; or far above this
  return correct(out, residual, curve, solver, from, distance, 1e-12);
}

int turn_curve_correct_between(turn_point *out, double *residual, const turn_curve *curve,
                               newton *solver, const turn_point *from, double distance) {
  // where branches cross, Newton's method gains but one bit in an iteration: 1e-11 was met
  return correct(out, residual, curve, solver, from, distance, 1e-10);
}

double turn_curve_beyond(const turn_curve *c, const turn_point *at, bike_turn_variable variable,
                         double value) {
  switch (variable) {
  case BIKE_TURN_LEAN:
    return at->y[Y_LEAN] - value;
  case BIKE_TURN_STEER:
    return at->y[Y_STEER] - value;
  case BIKE_TURN_OFFSET:
    return turn_curve_offset(c, at->y) - value;
  default:
    // times sin(steer), so that it is smooth where the branch meets straight riding
    return swept(c, at->y) - value * value * sin(at->y[Y_STEER]);
  }
}

double turn_curve_slope(const turn_curve *c, const turn_point *at, bike_turn_variable variable) {
  const double *y = at->y, *t = at->along;
  switch (variable) {
  case BIKE_TURN_LEAN:
    return t[Y_LEAN];
  case BIKE_TURN_STEER:
    return t[Y_STEER];
  case BIKE_TURN_OFFSET:
    return c->at_speed ? t[Y_LAST] : 0;
  default:
    // of v^2 = g z/sin(steer), times its square
    return c->at_speed ? 0 : t[Y_LAST] * sin(y[Y_STEER]) - y[Y_LAST] * cos(y[Y_STEER]) * t[Y_STEER];
  }
}

double turn_curve_growth(const turn_curve *c, const turn_point *at, bike_turn_variable variable,
                         double value) {
  if (variable != BIKE_TURN_SPEED) return turn_curve_slope(c, at, variable);
  // of v^2 sin(steer) = g z at a fixed offset, less value^2 sin(steer)
  const double *y = at->y, *t = at->along;
  return c->bicycle->model->gravity * t[Y_LAST] - value * value * cos(y[Y_STEER]) * t[Y_STEER];
}

bool turn_curve_within(const turn_curve *c, const double y[Y_SIZE]) {
  return fabs(y[Y_LEAN]) <= c->def->lean_limit && fabs(y[Y_STEER]) <= c->def->steer_limit;
}
