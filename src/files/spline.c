// SPDX-License-Identifier: Apache-2.0
#include "spline.h"

// h_i = t_(i+1) - t_i, slope d_i = (y_(i+1) - y_i) / h_i. Continuity of the first derivative:
//   h_(i-1) s_(i-1) + 2 (h_(i-1) + h_i) s_i + h_i s_(i+1) = 6 (d_i - d_(i-1)),  0 < i < n - 1

static double slope(const double *t, const double *y, size_t i) {
  return (y[i + 1] - y[i]) / (t[i + 1] - t[i]);
}

static double bend(const double *t, const double *y, size_t i) {
  return 6 * (slope(t, y, i) - slope(t, y, i - 1));
}

// The parabola through the points around knot i.
static double parabola(const double *t, const double *y, size_t i) {
  return 2 * (slope(t, y, i) - slope(t, y, i - 1)) / (t[i + 1] - t[i - 1]);
}

// Not-a-knot: s_0 = ((h_0 + h_1) s_1 - h_0 s_2) / h_1, and likewise at the other end, put into the
// first and last row; the rest is Thomas's elimination, stable as the matrix is dominated by its
// diagonal.
void bike_spline_fit(double *second, const double *t, const double *y, size_t n, double *scratch) {
  if (n <= 3) {
    for (size_t i = 0; i < n; ++i) second[i] = n == 3 ? parabola(t, y, 1) : 0;
    return;
  }
  double *upper = scratch, *right = scratch + n;
  const size_t last = n - 2;
  const double h0 = t[1] - t[0], h1 = t[2] - t[1];
  const double g0 = t[n - 1] - t[n - 2], g1 = t[n - 2] - t[n - 3];
  for (size_t i = 1; i <= last; ++i) {
    const double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
    double lower = before, diagonal = 2 * (before + after), above = after;
    if (i == 1) {
      diagonal += h0 * (h0 + h1) / h1;
      above -= h0 * h0 / h1;
      lower = 0;
    }
    if (i == last) {
      diagonal += g0 * (g0 + g1) / g1;
      lower -= g0 * g0 / g1;
      above = 0;
    }
    const double pivot = diagonal - (i > 1 ? lower * upper[i - 1] : 0);
    upper[i] = above / pivot;
    right[i] = (bend(t, y, i) - (i > 1 ? lower * right[i - 1] : 0)) / pivot;
  }
  second[last] = right[last];
  for (size_t i = last; i-- > 1;) second[i] = right[i] - upper[i] * second[i + 1];
  second[0] = ((h0 + h1) * second[1] - h0 * second[2]) / h1;
  second[n - 1] = ((g0 + g1) * second[n - 2] - g0 * second[n - 3]) / g1;
}

void bike_spline_at(double out[3], double time, const double *t, const double *y,
                    const double *second, size_t i) {
  const double h = t[i + 1] - t[i], b = time - t[i];
  const double third = (second[i + 1] - second[i]) / h;
  const double first = slope(t, y, i) - h * (2 * second[i] + second[i + 1]) / 6;
  out[0] = y[i] + b * (first + b * (second[i] / 2 + b * third / 6));
  out[1] = first + b * (second[i] + b * third / 2);
  out[2] = second[i] + b * third;
}
