// SPDX-License-Identifier: Apache-2.0
#include "batch/eigenvalues.h"

#include <math.h>

typedef struct zero {
  double re, im;
} zero;

// Imaginary parts below this share of the largest zero may be those of two real zeros that are
// about to meet: sum and product of the two, which are better known than either, must tell.
static const double NEARLY_REAL = 1e-5;

static void swap(zero *a, zero *b) {
  zero kept = *a;
  *a = *b;
  *b = kept;
}

// A pair and its conjugate in place of two zeros.
static void conjugate(zero *a, zero *b) {
  double re = 0.5 * (a->re + b->re), im = 0.5 * fabs(a->im - b->im);
  *a = (zero){re, im};
  *b = (zero){re, -im};
}

// Two zeros near the real axis that may have met: those of s^2 - 2 m s + q.
static void decide(zero *a, zero *b) {
  double m = 0.5 * (a->re + b->re), gap = 0.5 * (a->re - b->re), off = 0.5 * (a->im - b->im);
  double square = gap * gap - off * off; // m^2 - q
  double root = sqrt(fabs(square));
  *a = square < 0 ? (zero){m, root} : (zero){m + root, 0};
  *b = square < 0 ? (zero){m, -root} : (zero){m - root, 0};
}

// The zero among z[1..n-1] nearest to the conjugate of z[0] comes to z[1].
static void bring_partner(zero *z, int n) {
  int best = 1;
  for (int i = 2; i < n; i++)
    if (hypot(z[i].re - z[0].re, z[i].im + z[0].im) <
        hypot(z[best].re - z[0].re, z[best].im + z[0].im))
      best = i;
  swap(&z[1], &z[best]);
}

// Far from the axis first.
static void sort_by_distance(zero z[4]) {
  for (int i = 0; i < 3; i++)
    for (int j = 3; j > i; j--)
      if (fabs(z[j].im) > fabs(z[j - 1].im)) swap(&z[j], &z[j - 1]);
}

static int pair_complex(zero z[4], double near) {
  int paired = 0;
  while (paired < 4 && fabs(z[paired].im) > near) {
    bring_partner(&z[paired], 4 - paired);
    conjugate(&z[paired], &z[paired + 1]);
    paired += 2;
  }
  return paired;
}

static void sort_by_real_part(zero *z, int n) {
  for (int i = 0; i < n - 1; i++)
    for (int j = n - 1; j > i; j--)
      if (z[j].re > z[j - 1].re || (z[j].re == z[j - 1].re && z[j].im > z[j - 1].im))
        swap(&z[j], &z[j - 1]);
}

// Real zeros, sorted: neighbours as close as their imaginary parts are large are decided together.
static void settle_real(zero *z, int n) {
  for (int i = 0; i < n; i++) {
    bool met = i + 1 < n && z[i].re - z[i + 1].re <= 4 * (fabs(z[i].im) + fabs(z[i + 1].im));
    if (met) {
      decide(&z[i], &z[i + 1]);
      i++;
    } else {
      z[i].im = 0;
    }
  }
}

void eigenvalues_paired(bike_eigenvalues *out, const double re[4], const double im[4]) {
  zero z[4];
  double largest = 0;
  for (int i = 0; i < 4; i++) {
    z[i] = (zero){re[i], im[i]};
    largest = fmax(largest, fabs(re[i]) + fabs(im[i]));
  }
  sort_by_distance(z);
  int paired = pair_complex(z, NEARLY_REAL * largest);
  sort_by_real_part(z + paired, 4 - paired);
  settle_real(z + paired, 4 - paired);
  sort_by_real_part(z, 4);
  for (int i = 0; i < 4; i++) {
    out->re[i] = z[i].re + 0.0; // no -0
    out->im[i] = z[i].im + 0.0;
  }
}
