// SPDX-License-Identifier: Apache-2.0
#include "sympy_bicycle.h"

#include <math.h>

#include "sympy_equations.h"

// Sines and cosines of lean, steer, tilt.
typedef struct angles {
  double s_lean, c_lean, s_steer, c_steer, s_tilt, c_tilt;
} angles;

// Newton's method from our kernel's start. Its error squares with each step: after one below 1e-8
// the next would move the tilt by less than a rounding.
static bool find_tilt(angles *a, const sympy_bicycle *p, const bike_state *s) {
  enum { MOST = 20 };
  double tilt = p->tilt + p->tilt_gain * s->steer * (s->lean - 0.5 * sin(p->tilt) * s->steer);
  for (int i = 0; i < MOST; i++) {
    double height, slope;
    sincos(tilt, &a->s_tilt, &a->c_tilt);
    sympy_height(&height, &slope, p, a->s_lean, a->c_lean, a->s_steer, a->c_steer, a->s_tilt,
                 a->c_tilt);
    double step = height / slope;
    tilt -= step;
    if (!(fabs(step) < 1e-8)) continue;
    sincos(tilt, &a->s_tilt, &a->c_tilt);
    return true;
  }
  return false;
}

static inline void swap(double *a, double *b) {
  double kept = *a;
  *a = *b;
  *b = kept;
}

// M u' = f by elimination with partial pivoting; the answer replaces f.
static void solve_full(double M[6][6], double f[6]) {
  enum { N = 6 };
  for (int k = 0; k < N; k++) {
    int pivot = k;
    for (int i = k + 1; i < N; i++)
      if (fabs(M[i][k]) > fabs(M[pivot][k])) pivot = i;
    if (pivot != k) {
      for (int j = k; j < N; j++) swap(&M[k][j], &M[pivot][j]);
      swap(&f[k], &f[pivot]);
    }
    double over = 1.0 / M[k][k];
    for (int i = k + 1; i < N; i++) {
      double l = M[i][k] * over;
      for (int j = k + 1; j < N; j++) M[i][j] -= l * M[k][j];
      f[i] -= l * f[k];
    }
  }
  for (int k = N - 1; k >= 0; k--) {
    for (int j = k + 1; j < N; j++) f[k] -= M[k][j] * f[j];
    f[k] /= M[k][k];
  }
}

// The same by L D L^T, the heaviest entry (of the speed) first.
static void solve_reduced(bike_acceleration *out, const double M[6], const double f[3]) {
  double over_v = 1.0 / M[5], l_lean = M[3] * over_v, l_steer = M[4] * over_v;
  double lean = M[0] - l_lean * M[3], mixed = M[1] - l_lean * M[4], steer = M[2] - l_steer * M[4];
  double f_lean = f[0] - l_lean * f[2], f_steer = f[1] - l_steer * f[2];
  double over_lean = 1.0 / lean, l = mixed * over_lean;
  out->steer = (f_steer - l * f_lean) / (steer - l * mixed);
  out->lean = f_lean * over_lean - l * out->steer;
  out->speed = f[2] * over_v - l_lean * out->lean - l_steer * out->steer;
}

static bool find_angles(angles *a, const sympy_bicycle *p, const bike_state *state) {
  sincos(state->lean, &a->s_lean, &a->c_lean);
  sincos(state->steer, &a->s_steer, &a->c_steer);
  return find_tilt(a, p, state);
}

bool sympy_accelerate(bike_acceleration *out, const sympy_bicycle *p, const bike_state *s) {
  angles a;
  double M[6][6], f[6];
  if (!find_angles(&a, p, s)) return false;
  sympy_full(M, f, p, a.s_lean, a.c_lean, a.s_steer, a.c_steer, a.s_tilt, a.c_tilt, s->lean_rate,
             s->steer_rate, s->speed);
  solve_full(M, f);
  *out = (bike_acceleration){.lean = f[0], .steer = f[1], .speed = f[2]};
  return true;
}

bool sympy_accelerate_reduced(bike_acceleration *out, const sympy_bicycle *p, const bike_state *s) {
  angles a;
  double M[6], f[3];
  if (!find_angles(&a, p, s)) return false;
  sympy_reduced(M, f, p, a.s_lean, a.c_lean, a.s_steer, a.c_steer, a.s_tilt, a.c_tilt, s->lean_rate,
                s->steer_rate, s->speed);
  solve_reduced(out, M, f);
  return true;
}
