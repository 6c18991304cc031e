// SPDX-License-Identifier: Apache-2.0
// Arithmetic on second-order Taylor jets in time: a value with its first and second derivative.
//
// The oracle differentiates the paper's equations with these instead of with closed forms, so that
// a slip in the library's derivatives cannot be repeated here. It works in long double because an
// oracle must be better than what it judges.
#ifndef BICYCLE_TESTS_JET_H
#define BICYCLE_TESTS_JET_H

#include <math.h>

typedef long double real;

typedef struct jet {
  real v;  // value
  real d;  // first derivative
  real dd; // second derivative; NaN where it is not known
} jet;

static inline jet jet_constant(real value) {
  return (jet){value, 0, 0};
}

static inline jet jet_add(jet a, jet b) {
  return (jet){a.v + b.v, a.d + b.d, a.dd + b.dd};
}

static inline jet jet_scale(jet a, real factor) {
  return (jet){a.v * factor, a.d * factor, a.dd * factor};
}

static inline jet jet_neg(jet a) {
  return jet_scale(a, -1);
}

static inline jet jet_sub(jet a, jet b) {
  return jet_add(a, jet_neg(b));
}

static inline jet jet_mul(jet a, jet b) {
  return (jet){a.v * b.v, a.d * b.v + a.v * b.d, a.dd * b.v + 2 * a.d * b.d + a.v * b.dd};
}

// f(x) from the value f0 and the derivatives f1, f2 of f at x.
static inline jet jet_chain(jet x, real f0, real f1, real f2) {
  return (jet){f0, f1 * x.d, f2 * x.d * x.d + f1 * x.dd};
}

static inline jet jet_div(jet a, jet b) {
  real inverse = 1 / b.v;
  return jet_mul(a, jet_chain(b, inverse, -inverse * inverse, 2 * inverse * inverse * inverse));
}

static inline jet jet_sin(jet x) {
  return jet_chain(x, sinl(x.v), cosl(x.v), -sinl(x.v));
}

static inline jet jet_cos(jet x) {
  return jet_chain(x, cosl(x.v), -sinl(x.v), -cosl(x.v));
}

static inline jet jet_tan(jet x) {
  return jet_div(jet_sin(x), jet_cos(x));
}

// The derivative as a jet; its own second derivative is unknown.
static inline jet jet_rate(jet x) {
  return (jet){x.d, x.dd, NAN};
}

static inline jet jet_atan(jet x) {
  real slope = 1 / (1 + x.v * x.v);
  return jet_chain(x, atanl(x.v), slope, -2 * x.v * slope * slope);
}

static inline jet jet_asin(jet x) {
  real slope = 1 / sqrtl((1 - x.v) * (1 + x.v));
  return jet_chain(x, asinl(x.v), slope, x.v * slope * slope * slope);
}

// The angle of the point (x, y), continuous through the right angle where an arc sine turns back.
static inline jet jet_atan2(jet y, jet x) {
  // atan2' = (x y' - y x') / (x^2 + y^2)
  real square = x.v * x.v + y.v * y.v;
  real d = (x.v * y.d - y.v * x.d) / square;
  real square_rate = 2 * (x.v * x.d + y.v * y.d);
  real dd = (x.v * y.dd - y.v * x.dd - d * square_rate) / square;
  return (jet){atan2l(y.v, x.v), d, dd};
}

#endif
