// SPDX-License-Identifier: Apache-2.0
// Roots are eigenvalues of companion matrices, polished: no grid can miss one.
#include "motion/upright_polynomial.h"

#include "motion/lapack.h"

#include <bicycle/error.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

_Static_assert((int)POLYNOMIAL_DEGREE <= (int)LAPACK_LARGEST, "companion matrices fit");

polynomial polynomial_product(polynomial a, polynomial b) {
  polynomial p = {.degree = a.degree + b.degree};
  for (int i = 0; i <= a.degree; i++) {
    for (int j = 0; j <= b.degree; j++) {
      p.c[i + j] += a.c[i] * b.c[j];
      p.size[i + j] += a.size[i] * b.size[j];
    }
  }
  return p;
}

void polynomial_accumulate(polynomial *a, polynomial b, long double factor) {
  for (int i = 0; i <= b.degree; i++) {
    a->c[i] += factor * b.c[i];
    a->size[i] += fabsl(factor) * b.size[i];
  }
}

polynomial polynomial_cleaned(polynomial p, long double epsilon) {
  for (int i = 0; i <= p.degree; i++)
    if (fabsl(p.c[i]) <= 64 * epsilon * p.size[i]) p.c[i] = 0;
  return p;
}

bool polynomial_vanishes(const polynomial *p) {
  for (int i = 0; i <= p->degree; i++)
    if (p->c[i] != 0) return false;
  return true;
}

static long double value(const polynomial *p, long double v, long double *slope) {
  long double y = 0, d = 0;
  for (int i = p->degree; i >= 0; i--) {
    d = d * v + y;
    y = y * v + p->c[i];
  }
  *slope = d;
  return y;
}

// A few Newton steps from the eigenvalue; they stop where they no longer bring the value down.
static double polished(const polynomial *p, double root) {
  long double v = root, slope, y = value(p, v, &slope);
  for (int i = 0; i < 8 && slope != 0; i++) {
    long double next = v - y / slope, next_slope, next_y = value(p, next, &next_slope);
    if (!(fabsl(next_y) < fabsl(y))) break;
    v = next;
    y = next_y;
    slope = next_slope;
  }
  return (double)v;
}

// Without vanishing leading coefficients and factors v: they stand for no speed.
static polynomial trimmed(polynomial p) {
  while (p.degree > 0 && p.c[p.degree] == 0) p.degree--;
  while (p.degree > 0 && p.c[0] == 0) {
    memmove(p.c, p.c + 1, (size_t)p.degree * sizeof p.c[0]);
    p.degree--;
  }
  return p;
}

static int rising(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

int polynomial_real_roots(double out[POLYNOMIAL_DEGREE], int *count, const polynomial *given) {
  polynomial p = trimmed(*given);
  const int n = p.degree;
  *count = 0;
  if (n == 0) return BIKE_OK;
  double companion[POLYNOMIAL_DEGREE * POLYNOMIAL_DEGREE] = {0};
  double re[POLYNOMIAL_DEGREE], im[POLYNOMIAL_DEGREE];
  for (int i = 0; i < n; i++) {
    companion[i * n + n - 1] = (double)(-p.c[i] / p.c[n]);
    if (i > 0) companion[i * n + i - 1] = 1;
  }
  for (int i = 0; i < n * n; i++)
    if (!isfinite(companion[i])) return BIKE_ERROR_NOT_FINITE;
  if (!lapack_eigenvalues(re, im, NULL, companion, n)) return BIKE_ERROR_NO_CONVERGENCE;
  const double pair = 1e-6; // square root of rounding: how far a double root splits
  for (int i = 0; i < n; i++) {
    if (fabs(im[i]) > pair * hypot(re[i], im[i])) continue;
    const double v = polished(&p, re[i]);
    if (v != 0 && isfinite(v)) out[(*count)++] = v;
  }
  qsort(out, (size_t)*count, sizeof out[0], rising);
  return BIKE_OK;
}

// An entry of a matrix, its size being that of the whole matrix' rounding.
static void put(polynomial *p, int power, const double matrix[4], int entry, double factor) {
  double largest = 0;
  for (int i = 0; i < 4; i++) largest = fmax(largest, fabs(matrix[i]));
  bool rounding = fabs(matrix[entry]) <= 64 * DBL_EPSILON * largest;
  p->c[power] = rounding ? 0 : (long double)factor * matrix[entry];
  p->size[power] = fabsl(p->c[power]);
}

int upright_polynomial(polynomial a[5], const bike_model *model) {
  bike_upright_matrices m;
  int code = bike_linearize_upright(&m, model);
  if (code) return code;
  polynomial entry[4][3] = {0}; // [element][power of s]
  for (int e = 0; e < 4; e++) {
    for (int k = 0; k < 3; k++) entry[e][k].degree = 2 - k;
    put(&entry[e][2], 0, m.M, e, 1);
    put(&entry[e][1], 1, m.C1, e, 1);
    put(&entry[e][0], 0, m.K0, e, model->gravity);
    put(&entry[e][0], 2, m.K2, e, 1);
  }
  entry[3][1].c[0] = entry[3][1].size[0] = model->steer_damping;
  for (int k = 0; k < 5; k++) a[k] = (polynomial){.degree = 4 - k};
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      polynomial_accumulate(&a[i + j], polynomial_product(entry[0][i], entry[3][j]), 1);
      polynomial_accumulate(&a[i + j], polynomial_product(entry[1][i], entry[2][j]), -1);
    }
  }
  for (int k = 0; k < 5; k++) a[k] = polynomial_cleaned(a[k], DBL_EPSILON);
  return BIKE_OK;
}
