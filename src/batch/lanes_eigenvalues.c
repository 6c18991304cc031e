// SPDX-License-Identifier: Apache-2.0
// Eigenvalues of the four-state system q'' = C q' + K q, q = (steer, lean), in lanes: the zeros of
//   p(s) = (s^2 - C11 s - K11)(s^2 - C22 s - K22) - (C12 s + K12)(C21 s + K21)
// by the method of Ehrlich and Aberth: Newton's step for each zero, kept away from the others,
//   ds = -p/(p' - p sum 1/(s - s_j)).
// p is evaluated as it stands: its coefficients would lose what the small eigenvalues live on.
#include "batch/lanes_block.h"
#include "batch/lanes_instance.h"

enum { ZEROS = 4 };
// Simple zeros take 8 steps from the start below, seldom more than 13. At zeros that meet steps
// only halve, down to the root of rounding: these are left to others.
enum { MOST_STEPS = 24 };
// The order is three: after a step as short as this, relative to the largest zero, what is left is
// rounding.
static const double LAST_STEP = 1e-10;

typedef struct number {
  real re, im;
} number;

static inline number plus(number a, number b) {
  return (number){a.re + b.re, a.im + b.im};
}

static inline number minus(number a, number b) {
  return (number){a.re - b.re, a.im - b.im};
}

static inline number product(number a, number b) {
  return (number){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

static inline number inverse(number a) {
  real over = 1.0 / (a.re * a.re + a.im * a.im);
  return (number){a.re * over, -a.im * over};
}

// c s + k
static inline number affine(real c, number s, real k) {
  return (number){c * s.re + k, c * s.im};
}

typedef struct polynomial {
  real K[4], C[4];
} polynomial;

static inline void evaluate(number *p, number *slope, const polynomial *of, number s) {
  const real *K = of->K, *C = of->C;
  number square = product(s, s);
  number a = minus(square, affine(C[0], s, K[0])), b = minus(square, affine(C[3], s, K[3]));
  number c = affine(C[1], s, K[1]), d = affine(C[2], s, K[2]);
  number a1 = {2.0 * s.re - C[0], 2.0 * s.im}, b1 = {2.0 * s.re - C[3], 2.0 * s.im};
  *p = minus(product(a, b), product(c, d));
  number cross = {C[1] * d.re + C[2] * c.re, C[1] * d.im + C[2] * c.im};
  *slope = minus(plus(product(a1, b), product(a, b1)), cross);
}

static inline number step_of(const polynomial *of, const number s[ZEROS], int i) {
  number p, slope;
  evaluate(&p, &slope, of, s[i]);
  number others = inverse(minus(s[i], s[(i + 1) % ZEROS]));
  for (int j = 2; j < ZEROS; j++) others = plus(others, inverse(minus(s[i], s[(i + j) % ZEROS])));
  return product(p, inverse(minus(product(p, others), slope)));
}

// Four places on a circle that holds the zeros, none conjugate to another.
static inline void spread(number s[ZEROS], const polynomial *of) {
  static const double cosine[ZEROS] = {0.92, 0.21, -0.88, -0.31};
  static const double sine[ZEROS] = {0.39, 0.98, 0.47, -0.95};
  real damping = lanes_abs(of->C[0]), stiffness = lanes_abs(of->K[0]);
  for (int i = 1; i < 4; i++) {
    damping += lanes_abs(of->C[i]);
    stiffness += lanes_abs(of->K[i]);
  }
  real radius = 0.5 * damping + real_sqrt(stiffness);
  for (int i = 0; i < ZEROS; i++) s[i] = (number){cosine[i] * radius, sine[i] * radius};
}

static inline real size_of(number s) {
  return lanes_abs(s.re) + lanes_abs(s.im);
}

unsigned INSTANCE(lanes_eigenvalues)(double *re, double *im, const double *K, const double *C) {
  polynomial of;
  memcpy(of.K, K, sizeof of.K);
  memcpy(of.C, C, sizeof of.C);
  number s[ZEROS];
  spread(s, &of);
  lanes_mask done = {0};
  for (int n = 0; n < MOST_STEPS && lanes_bits(~done); n++) {
    real longest = of.K[0] - of.K[0], largest = longest;
    number step[ZEROS];
    for (int i = 0; i < ZEROS; i++) step[i] = step_of(&of, s, i);
    for (int i = 0; i < ZEROS; i++) {
      // who is done stays, whatever his neighbours still need
      s[i].re = lanes_either(done, s[i].re, s[i].re + step[i].re);
      s[i].im = lanes_either(done, s[i].im, s[i].im + step[i].im);
      longest = lanes_max(longest, size_of(step[i]));
      largest = lanes_max(largest, size_of(s[i]));
    }
    done |= longest <= LAST_STEP * largest;
  }
  lanes_mask finite = {0};
  finite = ~finite;
  for (int i = 0; i < ZEROS; i++) {
    memcpy(re + i * LANES, &s[i].re, sizeof s[i].re);
    memcpy(im + i * LANES, &s[i].im, sizeof s[i].im);
    finite &= (s[i].re - s[i].re == s[i].im - s[i].im);
  }
  return lanes_bits(done & finite);
}
