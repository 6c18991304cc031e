// SPDX-License-Identifier: Apache-2.0
// The kernel over complex numbers for derivatives by complex step: the imaginary part carries an
// exact first derivative. It is so small (see linear.c) that functions need its first order only.
#ifndef BICYCLE_NUMBER_COMPLEX_H
#define BICYCLE_NUMBER_COMPLEX_H

#include <complex.h>
#include <math.h>

#ifndef CMPLX // glibc defines it for GCC alone
#define CMPLX(re, im) __builtin_complex((double)(re), (double)(im))
#endif

typedef double complex real;

static inline real real_of(double x) {
  return x;
}

static inline real real_sqrt(real z) {
  double root = sqrt(creal(z));
  return CMPLX(root, 0.5 * cimag(z) / root);
}

static inline void real_sincos(real z, real *s, real *c) {
  double sine, cosine;
  sincos(creal(z), &sine, &cosine);
  *s = CMPLX(sine, cosine * cimag(z));
  *c = CMPLX(cosine, -sine * cimag(z));
}

static inline real real_anew(real z) {
  return z;
}

#include "kernel/generic_model.h"

#include "kernel/kernel.h"

#include "kernel/forces.h"

#endif
