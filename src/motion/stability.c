// SPDX-License-Identifier: Apache-2.0
// Eigenvalues of upright straight riding.
#include "motion/lapack.h"

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdlib.h>

static int falling(const void *a, const void *b) {
  const double *x = a, *y = b;
  for (int i = 0; i < 2; i++)
    if (x[i] != y[i]) return x[i] < y[i] ? 1 : -1;
  return 0;
}

int bike_eigenvalues_of(bike_eigenvalues *out, const double A[16]) {
  if (!out || !A) return BIKE_ERROR_ARGUMENT;
  double copy[16], re[4], im[4], pairs[4][2];
  for (int i = 0; i < 16; i++)
    if (!isfinite(copy[i] = A[i])) return BIKE_ERROR_NOT_FINITE;
  if (!lapack_eigenvalues(re, im, NULL, copy, 4)) return BIKE_ERROR_NO_CONVERGENCE;
  for (int i = 0; i < 4; i++) {
    pairs[i][0] = re[i];
    pairs[i][1] = im[i];
  }
  for (int i = 0; i < 4; i++)
    if (!isfinite(re[i]) || !isfinite(im[i])) return BIKE_ERROR_NOT_FINITE;
  qsort(pairs, 4, sizeof pairs[0], falling);
  for (int i = 0; i < 4; i++) {
    out->re[i] = pairs[i][0];
    out->im[i] = pairs[i][1];
  }
  return BIKE_OK;
}

int bike_upright_eigenvalues(bike_eigenvalues *out, const bike_model *model, double speed) {
  bike_linear linear;
  bike_state straight = {.speed = speed};
  int code = bike_linearize(&linear, model, &straight, NULL);
  return code ? code : bike_eigenvalues_of(out, linear.A);
}

double bike_neutral_band(const bike_eigenvalues *e) {
  double largest = 0;
  for (int i = 0; i < 4; i++) largest = fmax(largest, hypot(e->re[i], e->im[i]));
  return 1e-11 * largest;
}

bool bike_all_decay(const bike_eigenvalues *e) {
  double band = bike_neutral_band(e);
  for (int i = 0; i < 4; i++)
    if (!(e->re[i] < -band)) return false;
  return true;
}

double bike_search_end(const bike_model *model) {
  const double usual = 40, froude = 9.81 * 2; // m/s; m^2/s^2: g and a reach of 2 m
  double power = round(0.5 * log2(model->gravity * model->reach / froude));
  return isfinite(power) ? ldexp(usual, (int)power) : usual; // without gravity any speed is fast
}
