// SPDX-License-Identifier: Apache-2.0
// A thin disc that rolls alone: reduced to its five speeds and coordinates, independent of MuJoCo
// and of multipliers.
//
// Axes (e1 heading, e2 axle to the left, e3 up in the disc's plane); angular velocity w = (w1, w2,
// w3), w1 = lean rate, w3 = yaw rate cos(lean), w2 = spin rate + yaw rate sin(lean). With m mass, R
// radius, I diametral and C axial inertia, moments about the hub and the hub's acceleration
// R d/dt(w2 e1 - w1 e2) give
//   (I + m R^2) w1' = (C + m R^2) w2 w3 - I w3^2 tan(lean) + m g R sin(lean)
//   (C + m R^2) w2' = -m R^2 w1 w3
//   I w3'           = I tan(lean) w1 w3 - C w1 w2.
#ifndef VALIDATE_DISC_H
#define VALIDATE_DISC_H

typedef struct disc_body {
  double mass, radius, diametral, axial, gravity; // kg, m, kg m^2, kg m^2, m/s^2
} disc_body;

// yaw, lean (right), spin angle (rad); hub x, y (m); w1, w2, w3 (rad/s)
enum { DISC_YAW, DISC_LEAN, DISC_SPIN, DISC_X, DISC_Y, DISC_W1, DISC_W2, DISC_W3, DISC_STATES };

// The rates of all states; |lean| < pi/2.
void disc_rates(double out[DISC_STATES], const double state[DISC_STATES], const disc_body *b);

// One step (s) of the classical method of Runge and Kutta, order 4.
void disc_advance(double state[DISC_STATES], const disc_body *b, double step);

// Force of the ground on the disc along (heading, left, up), N.
void disc_force(double out[3], const double state[DISC_STATES], const disc_body *b);

double disc_kinetic(const double state[DISC_STATES], const disc_body *b);   // J
double disc_potential(const double state[DISC_STATES], const disc_body *b); // J  zero lying flat

#endif
