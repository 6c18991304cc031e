// SPDX-License-Identifier: Apache-2.0
// The two equations of stationary motion: with lean and steer at rest the forces of Kane's
// equations are
//   f = fall(kappa, phi, w) + v^2 sin(phi) sweep(kappa, phi, w),   rows (steer, lean):
// weight and steer torque, and what the circle asks. v' = 0 follows from them, as the energy is
// constant. Both are polynomials in w: fall of degree one, sweep of degree two. The yaw rate is v
// times sin(phi) times something that does not vanish, so sweep is finite and not zero at straight
// riding.
#ifndef BICYCLE_MOTION_TURN_FORCES_H
#define BICYCLE_MOTION_TURN_FORCES_H

#include <bicycle/model.h>
#include <stdbool.h>

enum { TURN_STEER_ROW, TURN_LEAN_ROW, TURN_ROWS };

typedef struct turn_forces {
  double fall[TURN_ROWS];  // rad/s^2
  double sweep[TURN_ROWS]; // rad/m^2
} turn_forces;

// A bicycle whose stationary motions are asked for.
typedef struct turn_bicycle {
  const bike_model *model;       // the caller's
  bike_model weightless;         // its motion without weight
  double torque;                 // M_S, N m
  double per_inertia[TURN_ROWS]; // turns forces into accelerations of upright riding, 1/(kg m^2)
} turn_bicycle;

// SINGULAR, or 0.
int turn_bicycle_init(turn_bicycle *out, const bike_model *model, double torque);

// sin, cos of beta_r at a lean and a steer. BIKE_ERROR_GEOMETRY where there is none.
int turn_rear_angle(double out[2], const bike_model *model, double lean, double steer);

// The forces in rad/s^2 of upright riding, so that both rows are of the same order. GEOMETRY, or 0.
int turn_forces_at(turn_forces *out, const turn_bicycle *bicycle, double lean, double steer,
                   double offset);

// Derivatives of the forces, exact (complex step), in columns of which those not wanted are left
// untouched; same errors.
enum { BY_LEAN, BY_STEER, BY_OFFSET, TURN_COLUMNS };

typedef struct turn_slopes {
  bool wanted[TURN_COLUMNS];
  double of[TURN_ROWS][TURN_COLUMNS];
} turn_slopes;

// At constant v^2. A negative one, of no meaning but on the way to a solution, is as good.
int turn_slopes_at_speed(turn_slopes *slopes, const turn_bicycle *bicycle, double lean,
                         double steer, double offset, double square);

// At constant v^2 sin(steer): smooth at straight riding, where v^2 is not determined.
int turn_slopes_at_swept(turn_slopes *slopes, const turn_bicycle *bicycle, double lean,
                         double steer, double offset, double swept);

#endif
