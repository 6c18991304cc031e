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

// Square roots, and sine and cosine of glibc's libmvec (4 units in the last place; its names tell
// instruction set, number of lanes, and arguments).
#ifdef __x86_64__
#if LANES == 8
#define LANES_SQRT(x) ((real)_mm512_sqrt_pd((__m512d)(x)))
#define LANES_SIN _ZGVeN8v_sin
#define LANES_COS _ZGVeN8v_cos
#elif LANES == 4
#define LANES_SQRT(x) ((real)_mm256_sqrt_pd((__m256d)(x)))
#define LANES_SIN _ZGVdN4v_sin
#define LANES_COS _ZGVdN4v_cos
#else
#define LANES_SQRT(x) ((real)_mm_sqrt_pd((__m128d)(x)))
#define LANES_SIN _ZGVbN2v_sin
#define LANES_COS _ZGVbN2v_cos
#endif
real LANES_SIN(real x);
real LANES_COS(real x);

static inline real real_sqrt(real x) {
  return LANES_SQRT(x);
}

static inline void real_sincos(real x, real *s, real *c) {
  *s = LANES_SIN(x);
  *c = LANES_COS(x);
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
