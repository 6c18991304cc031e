// SPDX-License-Identifier: Apache-2.0
// The characteristic polynomial of upright straight riding, and polynomials in the speed made of
// its coefficients, whose real roots are the speeds at which eigenvalues do something special.
//
// With q ~ exp(s t) the upright equations M q'' + (v C1 + D) q' + (g K0 + v^2 K2) q = 0 have the
// characteristic polynomial a4 s^4 + a3 s^3 + a2 s^2 + a1 s + a0 with coefficients that are
// polynomials in v.
#ifndef BICYCLE_MOTION_UPRIGHT_POLYNOMIAL_H
#define BICYCLE_MOTION_UPRIGHT_POLYNOMIAL_H

#include <bicycle/linear.h>
#include <stdbool.h>

// Polynomial in v, lowest power first. Sums of products of some ten terms: long double keeps the
// roots good to the last digits of double. `size` is the sum of what was added without its sign.
enum { POLYNOMIAL_DEGREE = 12 };
typedef struct polynomial {
  int degree;
  long double c[POLYNOMIAL_DEGREE + 1], size[POLYNOMIAL_DEGREE + 1];
} polynomial;

polynomial polynomial_product(polynomial a, polynomial b);

// Adds `factor` times b to a of the same or higher degree.
void polynomial_accumulate(polynomial *a, polynomial b, long double factor);

// Coefficients that are nothing but rounding, some `epsilon` of their size, become zero: for a
// bicycle without trail, say, whole polynomials vanish. The matrices are good to some units in the
// last place of double.
polynomial polynomial_cleaned(polynomial p, long double epsilon);
bool polynomial_vanishes(const polynomial *p);

// The real roots other than zero, in rising order. A double root may come out as a close complex
// pair: it is kept, as one or two roots. BIKE_ERROR_NO_CONVERGENCE, or 0.
int polynomial_real_roots(double out[POLYNOMIAL_DEGREE], int *count, const polynomial *p);

// a[k], the coefficient of s^k; its degree in v is 4 - k. Errors of bike_linearize_upright.
int upright_polynomial(polynomial a[5], const bike_model *model);

#endif
