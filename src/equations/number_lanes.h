// SPDX-License-Identifier: Apache-2.0
// The kernel over GCC vectors: LANES bicycles, or states, at a time; as many as a register of the
// instruction set holds.
#ifndef BICYCLE_NUMBER_LANES_H
#define BICYCLE_NUMBER_LANES_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef __x86_64__
#include <immintrin.h>
#include <sleef.h>
#endif

#if defined __AVX512F__
#define LANES 8
#elif defined __AVX2__
#define LANES 4
#else
#define LANES 2
#endif

typedef double real __attribute__((vector_size(LANES * sizeof(double))));
// What a comparison of lanes gives: all bits set where it holds.
typedef int64_t lanes_mask __attribute__((vector_size(LANES * sizeof(int64_t))));

static inline real real_of(double x) {
  return x - (real){0};
}

// Square roots are the processor's. Sine and cosine are SLEEF's, to one unit in the last place: of
// the libraries at hand the one that gives both at once. libmvec's, to four, took as long and
// tripled what light steering makes of that.
#ifdef __x86_64__
#if LANES == 8
#define LANES_SQRT(x) ((real)_mm512_sqrt_pd((__m512d)(x)))
#define LANES_SINCOS(x) Sleef_sincosd8_u10avx512f((__m512d)(x))
typedef Sleef___m512d_2 lanes_sincos;
#elif LANES == 4
#define LANES_SQRT(x) ((real)_mm256_sqrt_pd((__m256d)(x)))
#define LANES_SINCOS(x) Sleef_sincosd4_u10avx2((__m256d)(x))
typedef Sleef___m256d_2 lanes_sincos;
#else
#define LANES_SQRT(x) ((real)_mm_sqrt_pd((__m128d)(x)))
#define LANES_SINCOS(x) Sleef_sincosd2_u10sse2((__m128d)(x))
typedef Sleef___m128d_2 lanes_sincos;
#endif

static inline real real_sqrt(real x) {
  return LANES_SQRT(x);
}

static inline void real_sincos(real x, real *s, real *c) {
  lanes_sincos both = LANES_SINCOS(x);
  *s = (real)both.x;
  *c = (real)both.y;
}
#else
static inline real real_sqrt(real x) {
  for (int i = 0; i < LANES; i++) x[i] = sqrt(x[i]);
  return x;
}

static inline void real_sincos(real x, real *s, real *c) {
  for (int i = 0; i < LANES; i++) {
    (*s)[i] = sin(x[i]);
    (*c)[i] = cos(x[i]);
  }
}
#endif

// Bit i: lane i of the mask is set.
static inline unsigned lanes_bits(lanes_mask mask) {
#if defined __x86_64__ && LANES == 8
  return _cvtmask8_u32(_mm512_movepi64_mask((__m512i)mask));
#elif defined __x86_64__ && LANES == 4
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
