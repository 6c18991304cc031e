// SPDX-License-Identifier: Apache-2.0
// The kernel over plain doubles.
#ifndef BICYCLE_NUMBER_DOUBLE_H
#define BICYCLE_NUMBER_DOUBLE_H

#include <bicycle/model.h>
#include <math.h>

typedef double real;
typedef bike_model kernel_model;
typedef bike_geometry kernel_geometry;

static inline double real_sqrt(double x) {
  return sqrt(x);
}

static inline void real_sincos(double x, double *s, double *c) {
  sincos(x, s, c);
}

#include "kernel/kernel.h"

#include "kernel/forces.h"

#endif
