// SPDX-License-Identifier: Apache-2.0
// A rolling disc in its own five speeds and coordinates, independent of MuJoCo and of multipliers.
//
// Axes (heading, axle, up in the disc's plane); angular velocity w = (w1, w2, w3), w1 = lean rate,
// w3 = yaw rate cos(lean), w2 = spin + yaw rate sin(lean). With m mass, R radius, I diametral and C
// axial inertia, moments about the hub and the hub's acceleration R d/dt(w2 e1 - w1 e2) give
//   (I + m R^2) w1' = (C + m R^2) w2 w3 - I w3^2 tan(lean) + m g R sin(lean)
//   (C + m R^2) w2' = -m R^2 w1 w3
//   I w3'           = I tan(lean) w1 w3 - C w1 w2.
#ifndef ROLL_TESTS_ROLLING_REDUCED_DISC_H
#define ROLL_TESTS_ROLLING_REDUCED_DISC_H

#include <math.h>

typedef struct disc_body {
  double mass, radius, diametral, axial, gravity; // kg, m, kg m^2, kg m^2, m/s^2
} disc_body;

// yaw, lean, spin angle (rad); hub x, y (m); w1, w2, w3 (rad/s)
enum { YAW, LEAN, SPIN, HUB_X, HUB_Y, W1, W2, W3, DISC_STATES };

static inline void disc_rates(double f[DISC_STATES], const double s[DISC_STATES], disc_body b) {
  double t = tan(s[LEAN]), mR2 = b.mass * b.radius * b.radius;
  double w1 = s[W1], w2 = s[W2], w3 = s[W3];
  f[YAW] = w3 / cos(s[LEAN]);
  f[LEAN] = w1;
  f[SPIN] = w2 - w3 * t;
  // the hub's velocity is R (w2 e1 - w1 e2), e2 = the axle
  double ahead = b.radius * w2, aside = -b.radius * w1 * cos(s[LEAN]);
  f[HUB_X] = ahead * cos(s[YAW]) - aside * sin(s[YAW]);
  f[HUB_Y] = ahead * sin(s[YAW]) + aside * cos(s[YAW]);
  double weight = b.mass * b.gravity * b.radius * sin(s[LEAN]);
  f[W1] = ((b.axial + mR2) * w2 * w3 - b.diametral * w3 * w3 * t + weight) / (b.diametral + mR2);
  f[W2] = -mR2 * w1 * w3 / (b.axial + mR2);
  f[W3] = t * w1 * w3 - b.axial * w1 * w2 / b.diametral;
}

// Classical Runge-Kutta.
static inline void disc_advance(double s[DISC_STATES], disc_body b, double h) {
  static const double share[4] = {0, 0.5, 0.5, 1}, weight[4] = {1, 2, 2, 1};
  double f[DISC_STATES] = {0}, sum[DISC_STATES] = {0}, at[DISC_STATES];
  for (int stage = 0; stage < 4; stage++) {
    for (int i = 0; i < DISC_STATES; i++) at[i] = s[i] + share[stage] * h * f[i];
    disc_rates(f, at, b);
    for (int i = 0; i < DISC_STATES; i++) sum[i] += weight[stage] * f[i] / 6;
  }
  for (int i = 0; i < DISC_STATES; i++) s[i] += h * sum[i];
}

#endif
