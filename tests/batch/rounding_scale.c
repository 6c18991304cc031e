// SPDX-License-Identifier: Apache-2.0
#include "batch/rounding_scale.h"

#include "support/near.h"
#include <bicycle/error.h>

// Lean, steer, speed, as rows and columns of bike_mass_matrix.
enum { SPEEDS = 3 };

static void inverse(double out[9], const double m[9]) {
  double det = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      out[3 * i + j] = m[3 * a + c] * m[3 * b + d] - m[3 * a + d] * m[3 * b + c];
    }
  for (int j = 0; j < 3; j++) det += m[j] * out[3 * j];
  for (int i = 0; i < 9; i++) out[i] /= det;
}

// Generalised forces M a, of the speeds in `which` alone.
static void force(double f[SPEEDS], const bike_model *model, const bike_state *state,
                  const double M[9], unsigned which) {
  bike_state s = *state;
  if (!(which & 1)) s.lean_rate = 0;
  if (!(which & 2)) s.steer_rate = 0;
  if (!(which & 4)) s.speed = 0;
  bike_acceleration a;
  assert_int_equal(bike_accelerate(&a, model, &s, NULL), BIKE_OK);
  const double r[SPEEDS] = {a.lean, a.steer, a.speed};
  for (int j = 0; j < SPEEDS; j++)
    f[j] = M[3 * j] * r[0] + M[3 * j + 1] * r[1] + M[3 * j + 2] * r[2];
}

// sum_n |f_n|: gravity; each speed alone, less gravity; each pair, less its two and gravity.
static void sizes(double size[SPEEDS], const bike_model *model, const bike_state *state,
                  const double M[9]) {
  double f[8][SPEEDS];
  for (unsigned which = 0; which < 7; which++) force(f[which], model, state, M, which);
  for (int j = 0; j < SPEEDS; j++) {
    size[j] = fabs(f[0][j]);
    for (unsigned one = 1; one < 8; one *= 2) size[j] += fabs(f[one][j] - f[0][j]);
    for (unsigned out = 1; out < 8; out *= 2) {
      unsigned pair = 7 ^ out, low = pair & (0u - pair), high = pair ^ low;
      size[j] += fabs(f[pair][j] - f[low][j] - f[high][j] + f[0][j]);
    }
  }
}

bike_acceleration rounding_scale(const bike_model *model, const bike_state *state) {
  double M[9], R[9], size[SPEEDS], scale[SPEEDS] = {0};
  bike_acceleration a;
  assert_int_equal(bike_mass_matrix(M, model, state, 0), BIKE_OK);
  assert_int_equal(bike_accelerate(&a, model, state, NULL), BIKE_OK);
  inverse(R, M);
  sizes(size, model, state, M);
  for (int j = 0; j < SPEEDS; j++)
    size[j] +=
        fabs(M[3 * j] * a.lean) + fabs(M[3 * j + 1] * a.steer) + fabs(M[3 * j + 2] * a.speed);
  for (int i = 0; i < SPEEDS; i++)
    for (int j = 0; j < SPEEDS; j++) scale[i] += fabs(R[3 * i + j]) * size[j];
  return (bike_acceleration){.lean = scale[0], .steer = scale[1], .speed = scale[2]};
}
