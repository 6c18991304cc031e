// SPDX-License-Identifier: Apache-2.0
// The kernel over plain doubles, with the bits of every lane of number_lanes.h where the compiler
// fuses the same products: straight code, inlined whole (state_instance.c).
#ifndef BICYCLE_NUMBER_DOUBLE_H
#define BICYCLE_NUMBER_DOUBLE_H

#include "equations/lane_math.h"

#include <bicycle/model.h>

typedef double real;
typedef bike_model kernel_model;
typedef bike_geometry kernel_geometry;

static inline double real_sqrt(double x) {
  return sqrt(x);
}

static inline void real_sincos(double x, double *s, double *c) {
  one_sincos(x, s, c);
}

static inline double real_anew(double x) {
  ANEW(x);
  return x;
}

#include "kernel/kernel.h"

#include "kernel/forces.h"

#endif
