// SPDX-License-Identifier: Apache-2.0
// Shooting: unknowns are steer and its rate at the largest lean, half the period, and the speed
// that gives the energy.
#include "motion/lapack.h"

#include <bicycle/cycle.h>

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "motion/cycle_half.h"

enum { STEER, STEER_RATE, HALF_PERIOD, SPEED, UNKNOWNS };

typedef struct shot {
  const bike_model *model;
  double lean, frequency; // scales of the unknowns and of what is left
} shot;

// Unknowns are of the order of one: steer/lean, steer_rate/(lean frequency), period and speed
// relative to those of small oscillations.
static void state_of(double x[HALF_SIZE], const shot *s, const double y[UNKNOWNS]) {
  x[HALF_LEAN] = s->lean;
  x[HALF_STEER] = s->lean * y[STEER];
  x[HALF_LEAN_RATE] = 0;
  x[HALF_STEER_RATE] = s->lean * s->frequency * y[STEER_RATE];
}

// f = mirrored x(T/2) - x(0), relative to the amplitude.
static int miss(double f[HALF_SIZE], const shot *s, const double y[UNKNOWNS]) {
  double x[HALF_SIZE], after[HALF_SIZE];
  state_of(x, s, y);
  int code = half_map(after, s->model, x, y[SPEED], M_PI / s->frequency * y[HALF_PERIOD]);
  if (code) return code;
  for (int i = 0; i < HALF_SIZE; i++) {
    f[i] = (after[i] - x[i]) / s->lean;
    if (i >= HALF_LEAN_RATE) f[i] /= s->frequency;
  }
  return BIKE_OK;
}

// Differences of rides good to 1e-14 of their size: this step makes both errors some 1e-9.
static const double DIFFERENCE = 1e-4;

static int slopes(double J[HALF_SIZE * UNKNOWNS], const shot *s, const double y[UNKNOWNS]) {
  for (int j = 0; j < UNKNOWNS; j++) {
    double up[UNKNOWNS], down[UNKNOWNS], above[HALF_SIZE], below[HALF_SIZE];
    memcpy(up, y, sizeof up);
    memcpy(down, y, sizeof down);
    up[j] += DIFFERENCE;
    down[j] -= DIFFERENCE;
    int code = miss(above, s, up);
    if (!code) code = miss(below, s, down);
    if (code) return code;
    for (int i = 0; i < HALF_SIZE; i++)
      J[i * UNKNOWNS + j] = (above[i] - below[i]) / (2 * DIFFERENCE);
  }
  return BIKE_OK;
}

static double largest(const double f[HALF_SIZE]) {
  double most = 0;
  for (int i = 0; i < HALF_SIZE; i++) most = fmax(most, fabs(f[i]));
  return most;
}

// Rides are good to 1e-14 rad; this is what is left of a small amplitude after them.
static const double CLOSED = 1e-9;

// Newton's method that has left the neighbourhood asks for rides without end: 1e8 s at 1e7 m/s have
// been seen. Period and speed change by per cents from one cycle of a branch to the next, and by a
// factor of three over a whole branch of the shipped bicycles.
static bool is_far(const double y[UNKNOWNS], const double guess[UNKNOWNS]) {
  const double most = 8;
  double longer = y[HALF_PERIOD] / guess[HALF_PERIOD], faster = y[SPEED] / guess[SPEED];
  return !(longer > 0 && longer < most && faster > 0 && faster < most);
}

static int improve(double y[UNKNOWNS], double *residual, const shot *s) {
  enum { ITERATIONS = 12 };
  double f[HALF_SIZE], guess[UNKNOWNS];
  memcpy(guess, y, sizeof guess);
  int code = miss(f, s, y);
  for (int i = 0; i < ITERATIONS && !code; i++) {
    *residual = largest(f);
    if (*residual <= CLOSED) return BIKE_OK;
    double J[HALF_SIZE * UNKNOWNS];
    code = slopes(J, s, y);
    if (code) return code;
    if (!lapack_solve(f, J, UNKNOWNS)) return BIKE_ERROR_NO_CONVERGENCE;
    for (int j = 0; j < UNKNOWNS; j++) y[j] -= f[j];
    code = is_far(y, guess) ? BIKE_ERROR_NO_CONVERGENCE : miss(f, s, y);
  }
  return code ? code : BIKE_ERROR_NO_CONVERGENCE;
}

// Largest modulus of the multipliers: squares of the eigenvalues of the half map's slope, without
// the one nearest to 1, which belongs to the motion along the cycle.
static int find_multiplier(double *out, const shot *s, const double y[UNKNOWNS]) {
  double x[HALF_SIZE], J[HALF_SIZE * HALF_SIZE], re[HALF_SIZE], im[HALF_SIZE];
  state_of(x, s, y);
  for (int j = 0; j < HALF_SIZE; j++) {
    double h = DIFFERENCE * s->lean * (j >= HALF_LEAN_RATE ? s->frequency : 1);
    double up[HALF_SIZE], down[HALF_SIZE], above[HALF_SIZE], below[HALF_SIZE];
    memcpy(up, x, sizeof up);
    memcpy(down, x, sizeof down);
    up[j] += h;
    down[j] -= h;
    double time = M_PI / s->frequency * y[HALF_PERIOD];
    int code = half_map(above, s->model, up, y[SPEED], time);
    if (!code) code = half_map(below, s->model, down, y[SPEED], time);
    if (code) return code;
    for (int i = 0; i < HALF_SIZE; i++) J[i * HALF_SIZE + j] = (above[i] - below[i]) / (2 * h);
  }
  if (!lapack_eigenvalues(re, im, NULL, J, HALF_SIZE)) return BIKE_ERROR_NO_CONVERGENCE;
  int trivial = 0;
  for (int i = 1; i < HALF_SIZE; i++)
    if (hypot(re[i] - 1, im[i]) < hypot(re[trivial] - 1, im[trivial])) trivial = i;
  *out = 0;
  for (int i = 0; i < HALF_SIZE; i++)
    if (i != trivial) *out = fmax(*out, re[i] * re[i] + im[i] * im[i]);
  return BIKE_OK;
}

// Small oscillations: lean cos(wt), steer ratio cos(wt - lag), at t = 0.
static void guess_small(double y[UNKNOWNS], const bike_weave_mode *mode, double weave_speed) {
  y[STEER] = mode->ratio * cos(mode->lag);
  y[STEER_RATE] = mode->ratio * sin(mode->lag);
  y[HALF_PERIOD] = 1;
  y[SPEED] = weave_speed;
}

static void guess_near(double y[UNKNOWNS], const shot *s, const bike_cycle *near) {
  y[STEER] = near->start.steer / near->lean;
  y[STEER_RATE] = near->start.steer_rate / (near->lean * s->frequency);
  y[HALF_PERIOD] = 0.5 * near->period * s->frequency / M_PI;
  y[SPEED] = near->speed;
}

int bike_cycle_find(bike_cycle *out, const bike_model *model, double lean, double weave_speed,
                    const bike_cycle *near) {
  if (!out || !model || !(lean > 0) || !(lean < M_PI / 2)) return BIKE_ERROR_ARGUMENT;
  bike_weave_mode mode;
  int code = bike_weave_mode_at(&mode, model, weave_speed);
  if (code) return code;
  shot s = {model, lean, mode.frequency};
  double y[UNKNOWNS], x[HALF_SIZE];
  if (near)
    guess_near(y, &s, near);
  else
    guess_small(y, &mode, weave_speed);
  bike_cycle cycle = {.lean = lean};
  code = improve(y, &cycle.residual, &s);
  if (code) return code;
  cycle.speed = y[SPEED];
  cycle.period = 2 * M_PI / s.frequency * y[HALF_PERIOD];
  state_of(x, &s, y);
  code = half_measure(&cycle, model, x);
  if (!code) code = find_multiplier(&cycle.multiplier, &s, y);
  if (!code) *out = cycle;
  return code;
}
