// SPDX-License-Identifier: Apache-2.0
#include "motion/turn_solution.h"

#include <bicycle/error.h>
#include <bicycle/ground.h>
#include <bicycle/state.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "motion/turn_terms.h"

typedef struct turn_unknowns {
  const turn_bicycle *bicycle;
  turn_place guess;
  bike_turn_variable free[2];
} turn_unknowns;

static double *member(turn_place *at, bike_turn_variable variable) {
  double *const members[BIKE_TURN_VARIABLES] = {[BIKE_TURN_SPEED] = &at->square,
                                                [BIKE_TURN_LEAN] = &at->lean,
                                                [BIKE_TURN_STEER] = &at->steer,
                                                [BIKE_TURN_OFFSET] = &at->offset};
  return members[variable];
}

static turn_place place_of(const turn_unknowns *u, const double *x) {
  turn_place at = u->guess;
  for (int k = 0; k < 2; k++) *member(&at, u->free[k]) = x[k];
  return at;
}

static bool is_free(const turn_unknowns *u, bike_turn_variable variable) {
  return u->free[0] == variable || u->free[1] == variable;
}

// Columns of the Jacobian for the two unknowns.
static int slopes_of(double J[NEWTON_MAX][NEWTON_MAX], const turn_unknowns *u, const turn_place *at,
                     const turn_forces *forces) {
  double gravity = u->bicycle->model->gravity;
  turn_slopes d = {.wanted = {is_free(u, BIKE_TURN_LEAN), is_free(u, BIKE_TURN_STEER),
                              is_free(u, BIKE_TURN_OFFSET)}};
  int code =
      turn_slopes_at_speed(&d, u->bicycle, at->lean, at->steer, at->offset, gravity * at->square);
  for (int i = 0; i < TURN_ROWS && !code; i++) {
    const double row[BIKE_TURN_VARIABLES] = {[BIKE_TURN_SPEED] =
                                                 gravity * sin(at->steer) * forces->sweep[i],
                                             [BIKE_TURN_LEAN] = d.of[i][BY_LEAN],
                                             [BIKE_TURN_STEER] = d.of[i][BY_STEER],
                                             [BIKE_TURN_OFFSET] = d.of[i][BY_OFFSET]};
    for (int k = 0; k < 2; k++) J[i][k] = row[u->free[k]];
  }
  return code;
}

// f = fall + v^2 sin(steer) sweep
static int stationarity(double *f, double J[NEWTON_MAX][NEWTON_MAX], const double *x,
                        const void *user) {
  const turn_unknowns *u = user;
  turn_place at = place_of(u, x);
  double gravity = u->bicycle->model->gravity;
  turn_forces forces;
  int code = turn_forces_at(&forces, u->bicycle, at.lean, at.steer, at.offset);
  if (code) return code;
  double s = gravity * at.square * sin(at.steer);
  for (int i = 0; i < TURN_ROWS; i++) f[i] = forces.fall[i] + s * forces.sweep[i];
  return J ? slopes_of(J, u, &at, &forces) : BIKE_OK;
}

void turn_place_polish(turn_place *at, double *residual, const turn_bicycle *bicycle,
                       newton *solver, const bool held[BIKE_TURN_VARIABLES], double reach) {
  turn_unknowns u = {.bicycle = bicycle, .guess = *at};
  int count = 0;
  for (int v = 0; v < BIKE_TURN_VARIABLES && count < 2; v++)
    if (!held[v]) u.free[count++] = (bike_turn_variable)v;
  double x[2], start[2];
  for (int k = 0; k < 2; k++) x[k] = start[k] = *member(at, u.free[k]);
  *residual = INFINITY;
  if (newton_solve(solver, x, residual, stationarity, &u)) return;
  if (fabs(x[0] - start[0]) <= reach && fabs(x[1] - start[1]) <= reach) *at = place_of(&u, x);
}

static double largest_acceleration(const bike_acceleration *a) {
  return fmax(fmax(fabs(a->lean), fabs(a->steer)), fabs(a->speed));
}

// Whether accelerations are nothing but rounding: of the terms that add up, and of lean and steer,
// which slopes carry on where the geometry nearly ends.
static int is_stationary(bool *out, const turn_bicycle *bicycle, const turn_place *at,
                         const bike_state *state, const bike_acceleration *left,
                         const bike_linear *linear) {
  // some tens of operations each: 2 at most on shipped bicycles, over 16 on a random crooked one
  const double rounding = 64 * DBL_EPSILON;
  turn_forces forces;
  bike_acceleration terms;
  int code = turn_forces_at(&forces, bicycle, at->lean, at->steer, at->offset);
  if (code) return code;
  double swept = state->speed * state->speed * sin(at->steer);
  double moments = turn_moments(bicycle, &forces, swept, at->offset);
  code = turn_acceleration_terms(&terms, bicycle, state, at->offset, moments);
  if (code) return code;
  // rows of the steer's and the lean's accelerations, columns of steer and lean
  const double *A = linear->A;
  double steer_slopes = fabs(A[8]) + fabs(A[9]), lean_slopes = fabs(A[12]) + fabs(A[13]);
  double lean = terms.lean + lean_slopes, steer = terms.steer + steer_slopes;
  double speed = terms.speed + bicycle->model->reach * (lean_slopes + steer_slopes);
  *out = fabs(left->lean) <= rounding * lean && fabs(left->steer) <= rounding * steer &&
         fabs(left->speed) <= rounding * speed;
  return BIKE_OK;
}

// The circle has its radius at any speed, at zero too: there that of a speed of 1 m/s.
static int circle(double *radius, const bike_model *model, bike_state state,
                  const bike_input *input, double yaw_rate) {
  bike_snapshot rolling;
  *radius = state.speed / fabs(yaw_rate);
  if (state.speed > 0) return BIKE_OK;
  state.speed = 1;
  int code = bike_evaluate(&rolling, model, &state, input);
  *radius = 1 / fabs(rolling.yaw_rate);
  return code;
}

int turn_describe(bike_turn *out, const turn_bicycle *bicycle, const turn_place *at) {
  const bike_model *model = bicycle->model;
  bike_state state = {
      .lean = at->lean, .steer = at->steer, .speed = sqrt(fmax(0, at->square * model->gravity))};
  bike_input input = {.steer_torque = bicycle->torque, .rider_offset = at->offset};
  bike_turn turn = {.lean = at->lean,
                    .steer = at->steer,
                    .speed = state.speed,
                    .rider_offset = at->offset,
                    .steer_torque = bicycle->torque};
  bike_snapshot now;
  int code = bike_evaluate(&now, model, &state, &input);
  if (code) return code;
  turn.yaw_rate = now.yaw_rate;
  turn.residual = out->residual = largest_acceleration(&now.acceleration);
  bike_linear linear;
  bool stationary;
  code = bike_linearize(&linear, model, &state, &input);
  if (!code) code = is_stationary(&stationary, bicycle, at, &state, &now.acceleration, &linear);
  if (code) return code;
  if (!stationary) return BIKE_ERROR_NO_CONVERGENCE;
  turn.rear_normal = now.rear_force[2];
  turn.front_normal = now.front_force[2];
  turn.rear_friction = bike_friction(now.rear_force);
  turn.front_friction = bike_friction(now.front_force);
  code = circle(&turn.radius, model, state, &input, now.yaw_rate);
  if (!code) code = bike_eigenvalues_of(&turn.eigenvalues, linear.A);
  if (code) return code;
  turn.eps_max = turn.eigenvalues.re[0];
  *out = turn;
  return BIKE_OK;
}
