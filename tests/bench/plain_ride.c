// SPDX-License-Identifier: Apache-2.0
#include "plain_ride.h"

#include "motion/ride_table.h"

#include <math.h>

// lean, steer, lean rate, steer rate, speed
enum { SIZE = 5 };

// The same control as that of the lanes (src/batch/lanes_ride.c).
static const double FIRST_STEP = 0.01, SAFETY = 0.9, SHRINK = 0.2, GROW = 5, SMALLEST_STEP = 1e-9;

static bool rates(double dy[SIZE], const double y[SIZE], plain_ride *ride) {
  bike_state state = {y[0], y[1], y[2], y[3], y[4]};
  bike_acceleration a;
  ride->evaluations++;
  if (bike_accelerate(&a, ride->model, &state, NULL)) return false;
  dy[0] = y[2];
  dy[1] = y[3];
  dy[2] = a.lean;
  dy[3] = a.steer;
  dy[4] = a.speed;
  return true;
}

// to = from + h sum_j w_j k_j
static void combine(double to[SIZE], const double from[SIZE], double h, const double *w,
                    double (*k)[SIZE], int stages) {
  double sum[SIZE] = {0};
  for (int j = 0; j < stages; j++) {
    if (w[j] == 0) continue;
    for (int i = 0; i < SIZE; i++) sum[i] += w[j] * k[j][i];
  }
  for (int i = 0; i < SIZE; i++) to[i] = from[i] + h * sum[i];
}

// The step's error in units of what is allowed; NaN or infinite where a stage has no answer.
static double try_step(double out[SIZE], const double y[SIZE], double h, plain_ride *ride) {
  const ride_table *table = &RIDE_TABLE_8;
  double k[RIDE_MAX_STAGES][SIZE], other[SIZE], most = 0;
  for (int s = 0; s < table->stages; s++) {
    double stage[SIZE];
    combine(stage, y, h, table->A[s], k, s);
    if (!rates(k[s], stage, ride)) return INFINITY;
  }
  combine(out, y, h, table->b, k, table->stages);
  combine(other, y, h, table->d, k, table->stages);
  for (int i = 0; i < SIZE; i++) {
    double allowed = ride->rtol * fmax(fabs(y[i]), fabs(out[i])) + ride->atol;
    most = fmax(most, fabs(out[i] - other[i]) / allowed);
  }
  return most;
}

static double next_step(double h, double error) {
  double factor = error > 0 ? SAFETY * pow(error, -1.0 / 8) : GROW;
  return h * fmin(GROW, fmax(SHRINK, factor));
}

bool plain_ride_go(bike_state *state, plain_ride *ride) {
  double y[SIZE] = {state->lean, state->steer, state->lean_rate, state->steer_rate, state->speed};
  double t = 0, h = FIRST_STEP;
  while (t < ride->duration) {
    double rest = ride->duration - t, there[SIZE];
    bool last = rest <= h * (1 + 1e-9);
    if (last) h = rest;
    double error = try_step(there, y, h, ride);
    if (error <= 1) {
      t = last ? ride->duration : t + h;
      for (int i = 0; i < SIZE; i++) y[i] = there[i];
    }
    h = next_step(h, error);
    if (!(h > SMALLEST_STEP)) return false;
  }
  *state = (bike_state){y[0], y[1], y[2], y[3], y[4]};
  return true;
}
