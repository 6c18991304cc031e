// SPDX-License-Identifier: Apache-2.0
#include "disc.h"

#include <math.h>

void disc_rates(double out[DISC_STATES], const double state[DISC_STATES], const disc_body *b) {
  double lean = state[DISC_LEAN], yaw = state[DISC_YAW], t = tan(lean);
  double w1 = state[DISC_W1], w2 = state[DISC_W2], w3 = state[DISC_W3];
  double mR2 = b->mass * b->radius * b->radius;
  out[DISC_YAW] = w3 / cos(lean);
  out[DISC_LEAN] = w1;
  out[DISC_SPIN] = w2 - w3 * t;
  // the hub's velocity is R (w2 e1 - w1 e2)
  double ahead = b->radius * w2, left = -b->radius * w1 * cos(lean);
  out[DISC_X] = ahead * cos(yaw) - left * sin(yaw);
  out[DISC_Y] = ahead * sin(yaw) + left * cos(yaw);
  double moment = b->mass * b->gravity * b->radius * sin(lean);
  out[DISC_W1] =
      ((b->axial + mR2) * w2 * w3 - b->diametral * w3 * w3 * t + moment) / (b->diametral + mR2);
  out[DISC_W2] = -mR2 * w1 * w3 / (b->axial + mR2);
  out[DISC_W3] = t * w1 * w3 - b->axial * w1 * w2 / b->diametral;
}

void disc_advance(double state[DISC_STATES], const disc_body *b, double step) {
  static const double share[4] = {0, 0.5, 0.5, 1}, weight[4] = {1, 2, 2, 1};
  double rate[DISC_STATES] = {0}, sum[DISC_STATES] = {0}, at[DISC_STATES];
  for (int stage = 0; stage < 4; stage++) {
    for (int i = 0; i < DISC_STATES; i++) at[i] = state[i] + share[stage] * step * rate[i];
    disc_rates(rate, at, b);
    for (int i = 0; i < DISC_STATES; i++) sum[i] += weight[stage] * rate[i] / 6;
  }
  for (int i = 0; i < DISC_STATES; i++) state[i] += step * sum[i];
}

// m (a + g e_z), a being the hub's: that of (R w2, -R w1 cos(lean)) in the heading's turning axes,
// and upwards (R cos(lean))''.
void disc_force(double out[3], const double state[DISC_STATES], const disc_body *b) {
  double rate[DISC_STATES], c = cos(state[DISC_LEAN]), s = sin(state[DISC_LEAN]);
  disc_rates(rate, state, b);
  double w1 = state[DISC_W1], turning = rate[DISC_YAW], mR = b->mass * b->radius;
  out[0] = mR * (rate[DISC_W2] + turning * w1 * c);
  out[1] = mR * (w1 * w1 * s - rate[DISC_W1] * c + turning * state[DISC_W2]);
  out[2] = b->mass * b->gravity - mR * (rate[DISC_W1] * s + w1 * w1 * c);
}

double disc_kinetic(const double state[DISC_STATES], const disc_body *b) {
  double w1 = state[DISC_W1], w2 = state[DISC_W2], w3 = state[DISC_W3];
  double mR2 = b->mass * b->radius * b->radius;
  return (mR2 * (w1 * w1 + w2 * w2) + b->diametral * (w1 * w1 + w3 * w3) + b->axial * w2 * w2) / 2;
}

double disc_potential(const double state[DISC_STATES], const disc_body *b) {
  return b->mass * b->gravity * b->radius * cos(state[DISC_LEAN]);
}
