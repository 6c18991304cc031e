// SPDX-License-Identifier: Apache-2.0
// Every speed at which the stability of upright straight riding changes.
//
// Of the characteristic polynomial a4 s^4 + a3 s^3 + a2 s^2 + a1 s + a0, a real eigenvalue crosses
// zero where a0 = 0 (capsize); a pair crosses the imaginary axis where Hurwitz' a1 a2 a3 - a1^2 a4
// - a0 a3^2 = 0 (weave). All roots of both are found; between neighbouring roots the number of
// unstable eigenvalues is constant and tells which roots count.
#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "motion/upright_polynomial.h"

enum { HURWITZ_DEGREE = 6 };

// a1 a2 a3 - a1^2 a4 - a0 a3^2
static polynomial hurwitz_of(const polynomial a[5]) {
  polynomial h = {.degree = HURWITZ_DEGREE};
  polynomial_accumulate(&h, polynomial_product(polynomial_product(a[1], a[2]), a[3]), 1);
  polynomial_accumulate(&h, polynomial_product(polynomial_product(a[1], a[1]), a[4]), -1);
  polynomial_accumulate(&h, polynomial_product(polynomial_product(a[3], a[3]), a[0]), -1);
  return polynomial_cleaned(h, DBL_EPSILON);
}

// Speeds where an eigenvalue may cross the imaginary axis, and where: in pairs off zero, or at
// zero.
typedef struct candidate {
  double v;
  bool weave;
} candidate;

typedef struct candidates {
  int count;
  candidate at[3 * HURWITZ_DEGREE];
} candidates;

// Appends the real roots in [low, high].
static int append_roots(candidates *out, const polynomial *p, bool weave, double low, double high) {
  double roots[POLYNOMIAL_DEGREE];
  int count;
  int code = polynomial_real_roots(roots, &count, p);
  for (int i = 0; i < count && !code; i++)
    if (roots[i] >= low && roots[i] <= high && roots[i] > 0)
      out->at[out->count++] = (candidate){roots[i], weave};
  return code;
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
  if (polynomial_vanishes(&a[0])) {
    at_zero = &a[1];
    hurwitz = (polynomial){.degree = HURWITZ_DEGREE};
    polynomial_accumulate(&hurwitz, polynomial_product(a[2], a[3]), 1);
    polynomial_accumulate(&hurwitz, polynomial_product(a[1], a[4]), -1);
    hurwitz = polynomial_cleaned(hurwitz, DBL_EPSILON);
  }
  int code = append_roots(out, at_zero, false, low, high);
  if (!code) code = append_roots(out, &hurwitz, true, low, high);
  qsort(out->at, (size_t)out->count, sizeof out->at[0], rising);
  return code;
}

int bike_upright_critical_speeds(bike_critical_speeds *out, const bike_model *model, double low,
                                 double high) {
  if (!out || !model || !(low >= 0) || !(high > low) || !isfinite(high)) return BIKE_ERROR_ARGUMENT;
  polynomial a[5];
  int code = upright_polynomial(a, model);
  if (code) return code;
  candidates c = {0};
  code = find_candidates(&c, a, low, high);
  bike_critical_speeds found = {0};
  if (!code) code = classify(&found, &c, model, low, high);
  if (!code) *out = found;
  return code;
}
