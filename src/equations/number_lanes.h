// SPDX-License-Identifier: Apache-2.0
// The kernel over GCC vectors: LANES bicycles, or states, at a time.
#ifndef BICYCLE_NUMBER_LANES_H
#define BICYCLE_NUMBER_LANES_H

#include "equations/lane_math.h"

#include <stdbool.h>

typedef lanes real;

static inline real real_of(double x) {
  return lanes_of(x);
}

static inline real real_sqrt(real x) {
  return lanes_sqrt(x);
}

static inline void real_sincos(real x, real *s, real *c) {
  lanes_sincos(x, s, c);
}

static inline real real_anew(real x) {
  ANEW(x);
  return x;
}

// Bit i: lane i of the mask is set.
static inline unsigned lanes_bits(lanes_mask mask) {
#if defined __AVX512DQ__ && LANES == 8
  return _cvtmask8_u32(_mm512_movepi64_mask((__m512i)mask));
#elif defined __AVX2__ && LANES == 4
  return (unsigned)_mm256_movemask_pd((__m256d)mask);
#else
  unsigned bits = 0;
  for (int i = 0; i < LANES; i++) bits |= (unsigned)(mask[i] & 1) << i;
  return bits;
#endif
}

static inline real lanes_abs(real x) {
  return (real)((lanes_mask)x & INT64_MAX);
}

// a where the mask is set, b elsewhere.
static inline real lanes_either(lanes_mask mask, real a, real b) {
  return (real)(((lanes_mask)a & mask) | ((lanes_mask)b & ~mask));
}

static inline real lanes_max(real a, real b) {
  return lanes_either(a > b, a, b);
}

#include "kernel/generic_model.h"

#include "kernel/kernel.h"

#include "kernel/forces.h"

#endif
