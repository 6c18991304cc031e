// SPDX-License-Identifier: Apache-2.0
// GCC vectors of LANES doubles (4 or 8, set before; 8 else), with square root, sine and cosine.
#ifndef BICYCLE_LANE_MATH_H
#define BICYCLE_LANE_MATH_H

#include <math.h>
#ifdef __x86_64__
#include <immintrin.h>
#endif

#ifndef LANES
#define LANES 8
#endif

typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));

// Inlined always: a call would pass vectors through memory, and keep what is constant from being
// seen. Sanitizers want their stack in small pieces.
#ifdef __SANITIZE_ADDRESS__
#define LANE_INLINE static inline
#else
#define LANE_INLINE static inline __attribute__((always_inline))
#endif

LANE_INLINE lanes lanes_of(double x) {
  return x - (lanes){0};
}

LANE_INLINE lanes lanes_sqrt(lanes x) {
#if defined __AVX512F__ && LANES == 8
  return (lanes)_mm512_sqrt_pd((__m512d)x);
#elif defined __AVX__ && LANES == 4
  return (lanes)_mm256_sqrt_pd((__m256d)x);
#else
  for (int i = 0; i < LANES; i++) x[i] = sqrt(x[i]);
  return x;
#endif
}

// glibc's libmvec under its names of the vector ABI: errors up to 4 ulp.
#if defined __GLIBC__ && defined __AVX512F__ && LANES == 8
#define LANES_SIN _ZGVeN8v_sin
#define LANES_COS _ZGVeN8v_cos
#elif defined __GLIBC__ && defined __AVX2__ && LANES == 4
#define LANES_SIN _ZGVdN4v_sin
#define LANES_COS _ZGVdN4v_cos
#endif

#ifdef LANES_SIN
lanes LANES_SIN(lanes x);
lanes LANES_COS(lanes x);

LANE_INLINE void lanes_sincos(lanes x, lanes *s, lanes *c) {
  *s = LANES_SIN(x);
  *c = LANES_COS(x);
}
#else
LANE_INLINE void lanes_sincos(lanes x, lanes *s, lanes *c) {
  for (int i = 0; i < LANES; i++) {
    double sine, cosine;
    sincos(x[i], &sine, &cosine);
    (*s)[i] = sine;
    (*c)[i] = cosine;
  }
}
#endif

#endif
