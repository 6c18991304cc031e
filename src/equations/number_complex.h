// SPDX-License-Identifier: Apache-2.0
// The kernel over complex numbers: the imaginary part carries an exact derivative (complex step).
#ifndef BICYCLE_NUMBER_COMPLEX_H
#define BICYCLE_NUMBER_COMPLEX_H

#include <complex.h>

typedef double complex real;

static inline real real_of(double x) {
  return x;
}

static inline real real_sqrt(real z) {
  return csqrt(z);
}

static inline void real_sincos(real z, real *s, real *c) {
  *s = csin(z);
  *c = ccos(z);
}

#include "kernel/generic_model.h"

#include "kernel/kernel.h"

#include "kernel/forces.h"

#endif
