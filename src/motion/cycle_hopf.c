// SPDX-License-Identifier: Apache-2.0
// Where cycles are born: the weave mode, and on which side of the weave speed.
#include <bicycle/cycle.h>
#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <complex.h>
#include <math.h>
#include <stddef.h>

int bike_weave_mode_at(bike_weave_mode *out, const bike_model *model, double speed) {
  if (!out || !model) return BIKE_ERROR_ARGUMENT;
  bike_linear linear;
  bike_eigenvalues e;
  bike_state straight = {.speed = speed};
  int code = bike_linearize(&linear, model, &straight, NULL);
  if (!code) code = bike_eigenvalues_of(&e, linear.A);
  if (code) return code;
  int k = 0;
  while (k < 4 && !(e.im[k] > 0)) k++; // sorted by falling real part
  if (k == 4) return BIKE_ERROR_NO_CONVERGENCE;
  // row of lean'': s^2 lean = A30 steer + A31 lean + A32 s steer + A33 s lean
  const double *A = linear.A;
  double complex s = e.re[k] + I * e.im[k];
  double complex steer = (s * s - A[13] - s * A[15]) / (A[12] + s * A[14]);
  double lag = -carg(steer);
  *out = (bike_weave_mode){e.re[k], e.im[k], cabs(steer), lag < 0 ? lag + 2 * M_PI : lag};
  return BIKE_OK;
}

int bike_speed_of_equal_energy(double *out, const bike_model *model, const bike_state *state,
                               double speed) {
  if (!out || !model || !state) return BIKE_ERROR_ARGUMENT;
  bike_snapshot upright, here;
  bike_state straight = {.speed = speed}, still = {.lean = state->lean, .steer = state->steer};
  double M[9];
  int code = bike_evaluate(&upright, model, &straight, NULL);
  if (!code) code = bike_evaluate(&here, model, &still, NULL);
  if (!code) code = bike_mass_matrix(M, model, &still, 0);
  if (code) return code;
  // M22 v^2/2 + (M02 lean_rate + M12 steer_rate) v + rest = E - U
  double k = state->lean_rate, p = state->steer_rate;
  double linear = M[2] * k + M[5] * p;
  double rest = 0.5 * (M[0] * k * k + 2 * M[1] * k * p + M[4] * p * p);
  double energy = upright.kinetic + upright.potential - here.potential - rest;
  double root = linear * linear + 2 * M[8] * energy;
  if (!(root >= 0)) return BIKE_ERROR_NOT_STATIONARY;
  *out = (sqrt(root) - linear) / M[8];
  return BIKE_OK;
}

// Which side of the weave speed the pair of eigenvalues is unstable on.
static int find_side(double *out, const bike_model *model, double weave_speed) {
  const double apart = 1e-4; // relative: far beyond rounding, near enough for the sign
  bike_weave_mode below, above;
  int code = bike_weave_mode_at(&below, model, weave_speed * (1 - apart));
  if (!code) code = bike_weave_mode_at(&above, model, weave_speed * (1 + apart));
  if (!code) *out = above.growth > below.growth ? 1 : -1;
  return code;
}

int bike_hopf_at(bike_hopf *out, const bike_model *model, double weave_speed) {
  if (!out || !model || !(weave_speed > 0)) return BIKE_ERROR_ARGUMENT;
  bike_hopf hopf = {.speed = weave_speed};
  int code = bike_weave_mode_at(&hopf.mode, model, weave_speed);
  if (!code) code = find_side(&hopf.unstable_side, model, weave_speed);
  // speed = weave + c lean^2 + d lean^4: two small cycles give c
  const double small = 0.01; // rad: the difference of speeds keeps eight digits
  bike_cycle one, two;
  if (!code) code = bike_cycle_find(&one, model, small, weave_speed, NULL);
  if (!code) code = bike_cycle_find(&two, model, 2 * small, weave_speed, &one);
  if (code) return code;
  double c1 = (one.speed - weave_speed) / (small * small);
  double c2 = (two.speed - weave_speed) / (4 * small * small);
  hopf.curvature = (4 * c1 - c2) / 3;
  hopf.supercritical = hopf.curvature * hopf.unstable_side > 0;
  *out = hopf;
  return BIKE_OK;
}
