// SPDX-License-Identifier: Apache-2.0
#include "motion/lapack.h"

#include <bicycle/error.h>
#include <bicycle/modes.h>
#include <complex.h>
#include <math.h>
#include <stdlib.h>

#include "motion/mode_map.h"

enum { STEER, LEAN, SIZE = 4 };

const char *bike_mode_string(bike_mode mode) {
  static const char *const names[] = {"unnamed", "weave", "capsize", "castering",
                                      "capsize and castering"};
  return (unsigned)mode < sizeof names / sizeof names[0] ? names[mode] : "unnamed";
}

// One mode while it is put in order.
typedef struct single {
  double re, im;
  double complex vector[SIZE];
} single;

static int falling(const void *a, const void *b) {
  const single *x = a, *y = b;
  if (x->re != y->re) return x->re < y->re ? 1 : -1;
  return (x->im < y->im) - (x->im > y->im);
}

// Column `mode` of dgeev's vectors: conjugate pairs share two columns, real and imaginary parts.
static void unpack(single *out, const double *V, const double *im, int mode) {
  int first = im[mode] < 0 ? mode - 1 : mode;
  for (int i = 0; i < SIZE; i++) {
    double complex v = V[SIZE * i + first];
    if (im[mode] != 0) v += copysign(1, im[mode]) * I * V[SIZE * i + first + 1];
    out->vector[i] = v;
  }
}

// Unit length, and the larger of steer and lean real and positive.
static void normalise(single *s) {
  double square = 0;
  for (int i = 0; i < SIZE; i++) square += creal(s->vector[i] * conj(s->vector[i]));
  double complex lead =
      cabs(s->vector[STEER]) > cabs(s->vector[LEAN]) ? s->vector[STEER] : s->vector[LEAN];
  double complex factor = cabs(lead) > 0 ? conj(lead) / cabs(lead) : 1;
  for (int i = 0; i < SIZE; i++) s->vector[i] *= factor / sqrt(square);
}

static double share_of_steer(const bike_modes *m, int mode) {
  const double *re = m->vectors_re[mode], *im = m->vectors_im[mode];
  double steer = hypot(re[STEER], im[STEER]), lean = hypot(re[LEAN], im[LEAN]);
  return steer / (steer + lean);
}

// One oscillation and two real modes name themselves if they look as in the literature.
static void name_by_vectors(bike_modes *m) {
  int real[SIZE], count = 0;
  for (int i = 0; i < SIZE; i++)
    if (m->values.im[i] == 0) real[count++] = i;
  if (count != 2) return;
  double slow = m->values.re[real[0]], fast = m->values.re[real[1]];
  if (!(fast < 0 && fabs(fast) > fabs(slow))) return;
  if (!(share_of_steer(m, real[1]) > fmax(0.5, share_of_steer(m, real[0])))) return;
  for (int i = 0; i < SIZE; i++) m->mode[i] = BIKE_MODE_WEAVE;
  m->mode[real[0]] = BIKE_MODE_CAPSIZE;
  m->mode[real[1]] = BIKE_MODE_CASTERING;
}

int bike_modes_of(bike_modes *out, const double A[16]) {
  if (!out || !A) return BIKE_ERROR_ARGUMENT;
  double copy[SIZE * SIZE], re[SIZE], im[SIZE], V[SIZE * SIZE];
  for (int i = 0; i < SIZE * SIZE; i++)
    if (!isfinite(copy[i] = A[i])) return BIKE_ERROR_NOT_FINITE;
  if (!lapack_eigenvalues(re, im, V, copy, SIZE)) return BIKE_ERROR_NO_CONVERGENCE;
  single modes[SIZE];
  for (int k = 0; k < SIZE; k++) {
    modes[k].re = re[k];
    modes[k].im = im[k];
    unpack(&modes[k], V, im, k);
    normalise(&modes[k]);
  }
  qsort(modes, SIZE, sizeof modes[0], falling);
  bike_modes m = {0};
  for (int k = 0; k < SIZE; k++) {
    m.values.re[k] = modes[k].re;
    m.values.im[k] = modes[k].im;
    for (int i = 0; i < SIZE; i++) {
      m.vectors_re[k][i] = creal(modes[k].vector[i]);
      m.vectors_im[k][i] = cimag(modes[k].vector[i]);
    }
  }
  name_by_vectors(&m);
  *out = m;
  return BIKE_OK;
}

int bike_upright_modes(bike_modes *out, const bike_model *model, const double *speeds, int count) {
  if (!out || !model || !speeds || count < 1) return BIKE_ERROR_ARGUMENT;
  mode_map map;
  int code = mode_map_init(&map, model);
  for (int i = 0; i < count && !code; i++) {
    bike_linear linear;
    bike_state straight = {.speed = speeds[i]};
    code = bike_linearize(&linear, model, &straight, NULL);
    if (!code) code = bike_modes_of(&out[i], linear.A);
    if (!code) code = mode_map_name(&out[i], &map, model, speeds[i]);
  }
  return code;
}

int bike_upright_name_ends(bike_name_end out[BIKE_MAX_NAME_ENDS], int *count,
                           const bike_model *model) {
  if (!out || !count || !model) return BIKE_ERROR_ARGUMENT;
  mode_map map;
  int code = mode_map_init(&map, model);
  if (code) return code;
  for (int i = 0; i < map.end_count; i++) out[i] = map.ends[i];
  *count = map.end_count;
  return BIKE_OK;
}
