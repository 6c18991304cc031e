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
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Polynomial in v, lowest power first. Sums of products of some ten terms: long double keeps the
// roots good to the last digits of double. `size` is the sum of what was added without its sign.
enum { MAX_DEGREE = 6 };
typedef struct polynomial {
  int degree;
  long double c[MAX_DEGREE + 1], size[MAX_DEGREE + 1];
} polynomial;

static polynomial product(polynomial a, polynomial b) {
  polynomial p = {.degree = a.degree + b.degree};
  for (int i = 0; i <= a.degree; i++) {
    for (int j = 0; j <= b.degree; j++) {
      p.c[i + j] += a.c[i] * b.c[j];
      p.size[i + j] += a.size[i] * b.size[j];
    }
  }
  return p;
}

// Adds `factor` times b to a of the same or higher degree.
static void accumulate(polynomial *a, polynomial b, long double factor) {
  for (int i = 0; i <= b.degree; i++) {
    a->c[i] += factor * b.c[i];
    a->size[i] += fabsl(factor) * b.size[i];
  }
}

// Coefficients that are nothing but the rounding of the matrices, which are good to some units in
// the last place of double, are zero: for a bicycle without trail, say, whole polynomials vanish.
static polynomial cleaned(polynomial p) {
  for (int i = 0; i <= p.degree; i++)
    if (fabsl(p.c[i]) <= 64 * (long double)DBL_EPSILON * p.size[i]) p.c[i] = 0;
  return p;
}

// An entry of a matrix, its size being that of the whole matrix' rounding.
static void put(polynomial *p, int power, const double matrix[4], int entry, double factor) {
  double largest = 0;
  for (int i = 0; i < 4; i++) largest = fmax(largest, fabs(matrix[i]));
  bool rounding = fabs(matrix[entry]) <= 64 * DBL_EPSILON * largest;
  p->c[power] = rounding ? 0 : (long double)factor * matrix[entry];
  p->size[power] = fabsl(p->c[power]);
}

// a[k], the coefficient of s^k in det(M s^2 + (v C1 + D) s + g K0 + v^2 K2); its degree in v is
// 4 - k.
static void characteristic(polynomial a[5], const bike_upright_matrices *m, double gravity,
                           double damping) {
  polynomial entry[4][3] = {0}; // [element][power of s]
  for (int e = 0; e < 4; e++) {
    for (int k = 0; k < 3; k++) entry[e][k].degree = 2 - k;
    put(&entry[e][2], 0, m->M, e, 1);
    put(&entry[e][1], 1, m->C1, e, 1);
    put(&entry[e][0], 0, m->K0, e, gravity);
    put(&entry[e][0], 2, m->K2, e, 1);
  }
  entry[3][1].c[0] = entry[3][1].size[0] = damping;
  for (int k = 0; k < 5; k++) a[k] = (polynomial){.degree = 4 - k};
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      accumulate(&a[i + j], product(entry[0][i], entry[3][j]), 1);
      accumulate(&a[i + j], product(entry[1][i], entry[2][j]), -1);
    }
  }
  for (int k = 0; k < 5; k++) a[k] = cleaned(a[k]);
}

// a1 a2 a3 - a1^2 a4 - a0 a3^2
static polynomial hurwitz_of(const polynomial a[5]) {
  polynomial h = {.degree = MAX_DEGREE};
  accumulate(&h, product(product(a[1], a[2]), a[3]), 1);
  accumulate(&h, product(product(a[1], a[1]), a[4]), -1);
  accumulate(&h, product(product(a[3], a[3]), a[0]), -1);
  return cleaned(h);
}

static bool vanishes(const polynomial *p) {
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

// Speeds where an eigenvalue may cross the imaginary axis, and where: in pairs off zero, or at
// zero.
typedef struct candidate {
  double v;
  bool weave;
} candidate;

typedef struct candidates {
  int count;
  candidate at[3 * MAX_DEGREE];
} candidates;

// Appends the real roots in [low, high]. A double root may come out as a close complex pair: it is
// kept, as a root that changes nothing is sorted out later.
static int append_roots(candidates *out, const polynomial *given, bool weave, double low,
                        double high) {
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
    if (v >= low && v <= high && v > 0) out->at[out->count++] = (candidate){v, weave};
  }
  return BIKE_OK;
}

static int rising(const void *a, const void *b) {
  double x = ((const candidate *)a)->v, y = ((const candidate *)b)->v;
  return (x > y) - (x < y);
}

// What the eigenvalues at a speed do.
typedef struct census {
  int growing;
  bool all_decay;
} census;

static int count_eigenvalues(census *out, const bike_model *model, double speed) {
  bike_eigenvalues e;
  int code = bike_upright_eigenvalues(&e, model, speed);
  if (code) return code;
  *out = (census){.all_decay = bike_all_decay(&e)};
  for (int i = 0; i < 4; i++) out->growing += e.re[i] > bike_neutral_band(&e);
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

static void add_speed(bike_critical_speeds *out, candidate c) {
  if (c.weave)
    out->weave[out->weave_count++] = c.v;
  else
    out->capsize[out->capsize_count++] = c.v;
}

// Walks along the segments between candidates; those across which the number of growing ones
// changes count.
static int classify(bike_critical_speeds *out, const candidates *c, const bike_model *model,
                    double low, double high) {
  census before = {0};
  bool first = true;
  for (int i = 0; i <= c->count; i++) {
    double from = i == 0 ? low : c->at[i - 1].v, to = i == c->count ? high : c->at[i].v;
    if (!(to > from)) continue;
    census now;
    int code = count_eigenvalues(&now, model, 0.5 * (from + to));
    if (code) return code;
    if (!first && now.growing != before.growing) add_speed(out, c->at[i - 1]);
    if (now.all_decay) add_range(out, from, to);
    before = now;
    first = false;
  }
  return BIKE_OK;
}

// Candidates of the characteristic polynomial. Where a0 vanishes at every speed an eigenvalue is
// always zero (a bicycle without trail and with its fork's mass on the steering axis): it is
// divided out, and a second one crosses zero where a1 = 0.
static int find_candidates(candidates *out, const polynomial a[5], double low, double high) {
  polynomial hurwitz = hurwitz_of(a);
  const polynomial *at_zero = &a[0];
  if (vanishes(&a[0])) {
    at_zero = &a[1];
    hurwitz = (polynomial){.degree = MAX_DEGREE};
    accumulate(&hurwitz, product(a[2], a[3]), 1);
    accumulate(&hurwitz, product(a[1], a[4]), -1);
    hurwitz = cleaned(hurwitz);
  }
  int code = append_roots(out, at_zero, false, low, high);
  if (!code) code = append_roots(out, &hurwitz, true, low, high);
  qsort(out->at, (size_t)out->count, sizeof out->at[0], rising);
  return code;
}

int bike_upright_critical_speeds(bike_critical_speeds *out, const bike_model *model, double low,
                                 double high) {
  if (!out || !model || !(low >= 0) || !(high > low) || !isfinite(high)) return BIKE_ERROR_ARGUMENT;
  bike_upright_matrices m;
  int code = bike_linearize_upright(&m, model);
  if (code) return code;

  polynomial a[5];
  characteristic(a, &m, model->gravity, model->steer_damping);
  candidates c = {0};
  code = find_candidates(&c, a, low, high);
  bike_critical_speeds found = {0};
  if (!code) code = classify(&found, &c, model, low, high);
  if (!code) *out = found;
  return code;
}
