// SPDX-License-Identifier: Apache-2.0
// Accelerations and energy at eight states of one bicycle at once, with exact derivatives.
#ifndef BICYCLE_EQUATIONS_JACOBIAN_H
#define BICYCLE_EQUATIONS_JACOBIAN_H

#include "equations/instruction_set.h"

#include <bicycle/model.h>

enum { JACOBIAN_POINTS = 8 };

// What a point is made of. The first JACOBIAN_DIRECTIONS are differentiated by, the first
// JACOBIAN_VARIABLES are its state.
enum {
  AT_STEER,              // rad
  AT_LEAN,               // rad
  AT_STEER_RATE,         // rad/s
  AT_LEAN_RATE,          // rad/s
  AT_SPEED,              // m/s
  AT_STEER_TORQUE,       // N m
  AT_ROLL_TORQUE,        // N m
  AT_RIDER_ACCELERATION, // m/s^2
  AT_RIDER_OFFSET,       // m
  AT_RIDER_VELOCITY,     // m/s
  JACOBIAN_ARGUMENTS,
  JACOBIAN_VARIABLES = AT_SPEED + 1,
  JACOBIAN_DIRECTIONS = AT_RIDER_ACCELERATION + 1
};

enum { OF_STEER, OF_LEAN, OF_SPEED, JACOBIAN_ACCELERATIONS };

typedef double jacobian_row[JACOBIAN_POINTS];

typedef struct jacobian_points {
  jacobian_row at[JACOBIAN_ARGUMENTS];
} jacobian_points;

// The kernel's `checks`, row by row.
typedef struct jacobian_checks {
  jacobian_row residual, Q, c_br, c_kap, c_psi, D;
  jacobian_row pivot_v, pivot_kap, pivot_phi, diagonal_kap, diagonal_phi;
} jacobian_checks;

enum { JACOBIAN_CHECKS = sizeof(jacobian_checks) / sizeof(jacobian_row) };

typedef struct jacobian {
  jacobian_row acceleration[JACOBIAN_ACCELERATIONS];               // rad/s^2, rad/s^2, m/s^2
  jacobian_row slope[JACOBIAN_ACCELERATIONS][JACOBIAN_DIRECTIONS]; // of these
  jacobian_row energy, energy_slope[JACOBIAN_VARIABLES];           // kinetic and potential, J
  jacobian_checks checks;
} jacobian;

// BIKE_OK, or why the results at a point may mean nothing: BIKE_ERROR_NOT_FINITE,
// BIKE_ERROR_SINGULAR, or BIKE_ERROR_GEOMETRY where Newton's steps from the guess near upright do
// not reach a root of (4), or it is near such a limit: ask bike_linearize there. A rider's motion
// without a rider is not looked for.
typedef int jacobian_codes[JACOBIAN_POINTS];

// All points are filled, so give every point a state.
void jacobian_at(jacobian *out, jacobian_codes codes, const bike_model *model,
                 const jacobian_points *points);

// The passes behind it; a machine must have the instructions of what it calls.
typedef void jacobian_pass(jacobian *out, const bike_model *model, const jacobian_points *points);
jacobian_pass jacobian_pass_baseline, jacobian_pass_v3, jacobian_pass_v4;

#endif
