// SPDX-License-Identifier: Apache-2.0
// Every speed at which the stability of upright straight riding changes.
//
// With q ~ exp(s t) the upright equations M q'' + (v C1 + D) q' + (g K0 + v^2 K2) q = 0 have the
// characteristic polynomial a4 s^4 + a3 s^3 + a2 s^2 + a1 s + a0 with coefficients that are
// polynomials in v. A real eigenvalue crosses zero where a0 = 0 (capsize); a pair crosses the
// imaginary axis where Hurwitz' a1 a2 a3 - a1^2 a4 - a0 a3^2 = 0 (weave). All roots of both are
// found as eigenvalues of companion matrices, so that no grid can miss one; between neighbouring
// roots the number of unstable eigenvalues is constant and tells which roots count.
#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Polynomial in v, lowest power first. Sums of products of some ten terms: long double keeps the
// roots good to the last digits of double.
enum { MAX_DEGREE = 6 };
typedef struct polynomial {
  int degree;
  long double c[MAX_DEGREE + 1];
} polynomial;

static polynomial product(polynomial a, polynomial b) {
  polynomial p = {.degree = a.degree + b.degree};
  for (int i = 0; i <= a.degree; i++)
    for (int j = 0; j <= b.degree; j++) p.c[i + j] += a.c[i] * b.c[j];
  return p;
}

static polynomial sum(polynomial a, polynomial b, long double factor) {
  polynomial p = {.degree = a.degree > b.degree ? a.degree : b.degree};
  for (int i = 0; i <= p.degree; i++)
    p.c[i] = (i <= a.degree ? a.c[i] : 0) + factor * (i <= b.degree ? b.c[i] : 0);
  return p;
}

// a[k], the coefficient of s^k in det(M s^2 + (v C1 + D) s + g K0 + v^2 K2); its degree in v is
// 4 - k.
static void characteristic(polynomial a[5], const bike_upright_matrices *m, double gravity,
                           double damping) {
  polynomial entry[4][3]; // [element][power of s]
  for (int e = 0; e < 4; e++) {
    entry[e][2] = (polynomial){0, {m->M[e]}};
    entry[e][1] = (polynomial){1, {e == 3 ? damping : 0, m->C1[e]}};
    entry[e][0] = (polynomial){2, {gravity * (long double)m->K0[e], 0, m->K2[e]}};
  }
  for (int k = 0; k < 5; k++) a[k] = (polynomial){.degree = 4 - k};
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      a[i + j] = sum(a[i + j], product(entry[0][i], entry[3][j]), 1);
      a[i + j] = sum(a[i + j], product(entry[1][i], entry[2][j]), -1);
    }
  }
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

// Leading coefficients that are nothing but rounding, and the factor v that undamped polynomials
// have, are taken off first: they stand for no speed.
static polynomial trimmed(polynomial p) {
  long double largest = 0;
  for (int i = 0; i <= p.degree; i++) largest = fmaxl(largest, fabsl(p.c[i]));
  const long double rounding = 1e-15L * largest; // of entries in double
  while (p.degree > 0 && fabsl(p.c[p.degree]) <= rounding) p.degree--;
  while (p.degree > 0 && fabsl(p.c[0]) <= rounding) {
    memmove(p.c, p.c + 1, (size_t)p.degree * sizeof p.c[0]);
    p.degree--;
  }
  return p;
}

typedef struct candidates {
  int count;
  double v[2 * MAX_DEGREE];
} candidates;

// Appends the real roots in [low, high]. A double root may come out as a close complex pair: it is
// kept, as a root that changes nothing is sorted out later.
static int append_roots(candidates *out, const polynomial *given, double low, double high) {
  polynomial p = trimmed(*given);
  int n = p.degree;
  if (n == 0) return BIKE_OK;
  double companion[MAX_DEGREE * MAX_DEGREE] = {0}, re[MAX_DEGREE], im[MAX_DEGREE];
  for (int i = 0; i < n; i++) {
    companion[i * n + n - 1] = (double)(-p.c[i] / p.c[n]);
    if (i > 0) companion[i * n + i - 1] = 1;
  }
  if (LAPACKE_dgeev(LAPACK_ROW_MAJOR, 'N', 'N', n, companion, n, re, im, NULL, 1, NULL, 1))
    return BIKE_ERROR_NO_CONVERGENCE;
  const double pair = 1e-6; // square root of rounding: how far a double root splits
  for (int i = 0; i < n; i++) {
    if (fabs(im[i]) > pair * hypot(re[i], im[i])) continue;
    double v = polished(&p, re[i]);
    if (v >= low && v <= high && v > 0) out->v[out->count++] = v;
  }
  return BIKE_OK;
}

static int rising(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

// Eigenvalues in the right half plane at a speed.
static int unstable_count(int *out, const bike_model *model, double speed) {
  bike_eigenvalues e;
  int code = bike_upright_eigenvalues(&e, model, speed);
  if (code) return code;
  *out = 0;
  for (int i = 0; i < 4; i++) *out += e.re[i] > 0;
  return BIKE_OK;
}

static void add_range(bike_critical_speeds *out, double low, double high) {
  if (out->range_count > 0 && out->ranges[out->range_count - 1][1] == low) {
    out->ranges[out->range_count - 1][1] = high;
    return;
  }
  out->ranges[out->range_count][0] = low;
  out->ranges[out->range_count++][1] = high;
}

// Walks along the segments between candidates. A change by one eigenvalue is a capsize, by two a
// weave.
static int classify(bike_critical_speeds *out, const candidates *c, const bike_model *model,
                    double low, double high) {
  int before = -1;
  for (int i = 0; i <= c->count; i++) {
    double from = i == 0 ? low : c->v[i - 1], to = i == c->count ? high : c->v[i];
    if (!(to > from)) continue;
    int now, code = unstable_count(&now, model, 0.5 * (from + to));
    if (code) return code;
    if (before >= 0 && abs(now - before) == 1) out->capsize[out->capsize_count++] = from;
    if (before >= 0 && abs(now - before) == 2) out->weave[out->weave_count++] = from;
    if (now == 0) add_range(out, from, to);
    before = now;
  }
  return BIKE_OK;
}

int bike_upright_critical_speeds(bike_critical_speeds *out, const bike_model *model, double low,
                                 double high) {
  if (!out || !model || !(low >= 0) || !(high > low) || !isfinite(high)) return BIKE_ERROR_ARGUMENT;
  bike_upright_matrices m;
  int code = bike_linearize_upright(&m, model);
  if (code) return code;

  polynomial a[5];
  characteristic(a, &m, model->gravity, model->steer_damping);
  polynomial hurwitz = product(product(a[1], a[2]), a[3]);
  hurwitz = sum(hurwitz, product(product(a[1], a[1]), a[4]), -1);
  hurwitz = sum(hurwitz, product(product(a[3], a[3]), a[0]), -1);
  candidates c = {0};
  code = append_roots(&c, &a[0], low, high);
  if (!code) code = append_roots(&c, &hurwitz, low, high);
  if (code) return code;
  qsort(c.v, (size_t)c.count, sizeof c.v[0], rising);
  bike_critical_speeds found = {0};
  code = classify(&found, &c, model, low, high);
  if (!code) *out = found;
  return code;
}
