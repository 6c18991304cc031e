// SPDX-License-Identifier: Apache-2.0
// GCC vectors of LANES doubles, as many as a register of the instruction set holds unless LANES is
// set before, with square root, sine and cosine; and the same sine and cosine for one double.
#ifndef BICYCLE_LANE_MATH_H
#define BICYCLE_LANE_MATH_H

#include <math.h>
#include <stdint.h>
#ifdef __x86_64__
#include <immintrin.h>
#include <sleef.h>
#endif

#ifndef __has_feature // clang's way to ask what GCC says by __SANITIZE_ADDRESS__
#define __has_feature(feature) 0
#endif

#ifndef LANES
#if defined __AVX512F__
#define LANES 8
#elif defined __AVX2__
#define LANES 4
#else
#define LANES 2
#endif
#endif

typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));
// What a comparison of lanes gives: all bits set where it holds.
typedef int64_t lanes_mask __attribute__((vector_size(LANES * sizeof(int64_t))));

// Inlined always: a call would pass vectors through memory, and keep what is constant from being
// seen. Sanitizers want their stack in small pieces.
#if defined __SANITIZE_ADDRESS__ || __has_feature(address_sanitizer)
#define LANE_INLINE static inline
#else
#define LANE_INLINE static inline __attribute__((always_inline))
#endif

// Has the compiler take a variable for one that it knows nothing of; costs nothing. Only so does it
// fuse the same products in code compiled in one piece and in two: x86 alone has this promise.
#ifdef __x86_64__
#define ANEW(x) __asm__("" : "+v"(x))
#else
#define ANEW(x) (void)(x)
#endif

LANE_INLINE lanes lanes_of(double x) {
  return x - (lanes){0};
}

// Square roots are the processor's. Sine and cosine are SLEEF's, to one unit in the last place: of
// the libraries at hand the one that gives both at once. libmvec's, to four, took as long, and
// light steering makes a hundred times that of it. SLEEF promises the same bits from its finz_
// functions (with fused multiply-adds), and from its cinz_ ones, whatever the width.
#if defined __AVX512F__ && LANES == 8
#define LANES_SQRT(x) ((lanes)_mm512_sqrt_pd((__m512d)(x)))
#define LANES_SINCOS(x) Sleef_finz_sincosd8_u10avx512f((__m512d)(x))
typedef Sleef___m512d_2 lanes_pair;
#elif defined __AVX2__ && LANES == 4
#define LANES_SQRT(x) ((lanes)_mm256_sqrt_pd((__m256d)(x)))
#define LANES_SINCOS(x) Sleef_finz_sincosd4_u10avx2((__m256d)(x))
typedef Sleef___m256d_2 lanes_pair;
#elif defined __SSE2__ && LANES == 2
#define LANES_SQRT(x) ((lanes)_mm_sqrt_pd((__m128d)(x)))
#define LANES_SINCOS(x) Sleef_cinz_sincosd2_u10sse2((__m128d)(x))
typedef Sleef___m128d_2 lanes_pair;
#endif

#ifdef LANES_SINCOS
LANE_INLINE lanes lanes_sqrt(lanes x) {
  return LANES_SQRT(x);
}

// SLEEF answers for all lanes in another manner, half as fast and with other roundings, where one
// of them is large or not finite. So that no lane feels another, such a lane is kept from it and
// gets NaN: no steering turns twice round, and what a lane cannot solve is left to the scalar path.
LANE_INLINE void lanes_sincos(lanes x, lanes *s, lanes *c) {
  lanes_mask usual = x * x < 15.0 * 15.0; // SLEEF's limit
  lanes_pair both = LANES_SINCOS((lanes)((lanes_mask)x & usual));
  *s = (lanes)((lanes_mask)both.x | ~usual);
  *c = (lanes)((lanes_mask)both.y | ~usual);
}
static inline void one_sincos(double x, double *s, double *c) {
#ifdef __FMA__
  Sleef_double_2 both = Sleef_finz_sincosd1_u10purecfma(x);
#else
  Sleef_double_2 both = Sleef_cinz_sincosd1_u10purec(x);
#endif
  *s = both.x;
  *c = both.y;
}
#else
LANE_INLINE lanes lanes_sqrt(lanes x) {
  for (int i = 0; i < LANES; i++) x[i] = sqrt(x[i]);
  return x;
}

LANE_INLINE void lanes_sincos(lanes x, lanes *s, lanes *c) {
  for (int i = 0; i < LANES; i++) {
    double sine, cosine;
    sincos(x[i], &sine, &cosine);
    (*s)[i] = sine;
    (*c)[i] = cosine;
  }
}

static inline void one_sincos(double x, double *s, double *c) {
  sincos(x, s, c);
}
#endif

#endif
