// SPDX-License-Identifier: Apache-2.0
// The kernel over GCC vectors: four bicycles or four states at a time.
#ifndef BICYCLE_NUMBER_LANES_H
#define BICYCLE_NUMBER_LANES_H

#include <math.h>

enum { LANES = 4 };
typedef double real __attribute__((vector_size(LANES * sizeof(double))));

static inline real real_of(double x) {
  return (real){x, x, x, x};
}

static inline real real_sqrt(real x) {
  for (int i = 0; i < LANES; i++) x[i] = sqrt(x[i]);
  return x;
}

static inline void real_sincos(real x, real *s, real *c) {
  for (int i = 0; i < LANES; i++) {
    double sine, cosine;
    sincos(x[i], &sine, &cosine);
    (*s)[i] = sine;
    (*c)[i] = cosine;
  }
}

#include "kernel/generic_model.h"

#include "kernel/kernel.h"

#include "kernel/forces.h"

#endif
