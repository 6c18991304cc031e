// SPDX-License-Identifier: Apache-2.0
// The two equations of stationary motion: with lean and steer at rest the forces of Kane's equations
// are
//   f = fall(kappa, phi, w) + v^2 sin(phi) sweep(kappa, phi, w) + (M_S, 0),   rows (steer, lean):
// weight, and what the circle asks. v' = 0 follows from them, as the energy is constant. Both are
// polynomials in w: fall of degree one, sweep of degree two. The yaw rate is v times sin(phi) times
// something that does not vanish, so sweep is finite and not zero at straight riding.
#ifndef BICYCLE_MOTION_TURN_FORCES_H
#define BICYCLE_MOTION_TURN_FORCES_H

#include <bicycle/model.h>

enum { TURN_STEER_ROW, TURN_LEAN_ROW, TURN_ROWS };

typedef struct turn_forces {
  double fall[TURN_ROWS];  // N m
  double sweep[TURN_ROWS]; // N m / (m^2/s^2)
} turn_forces;

// What both number types need to know of a bicycle.
typedef struct turn_bicycle {
  const bike_model *model;
  bike_model still;      // its weight without motion
  bike_model weightless; // its motion without weight
} turn_bicycle;

turn_bicycle turn_bicycle_of(const bike_model *model);

// sin, cos of beta_r at a lean and a steer. BIKE_ERROR_GEOMETRY where there is none.
int turn_rear_angle(double out[2], const bike_model *model, double lean, double steer);

// BIKE_ERROR_GEOMETRY, or 0.
int turn_forces_at(turn_forces *out, const turn_bicycle *bicycle, double lean, double steer,
                   double offset);

// Their derivatives for lean, steer and offset, exact (complex step); same errors.
typedef struct turn_slopes {
  turn_forces lean, steer, offset;
} turn_slopes;

int turn_slopes_at(turn_slopes *out, const turn_bicycle *bicycle, double lean, double steer,
                   double offset);

#endif
