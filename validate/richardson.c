// SPDX-License-Identifier: Apache-2.0
#include "richardson.h"

#include <math.h>

// Rows: sum w_i = 1;  sum w_i (h_i/h_0)^(p + k - 1) = 0. Scaling leaves the solution and spares
// the elimination numbers of 1e-20.
static void fill(double A[RICHARDSON_MAX][RICHARDSON_MAX + 1], const double step[], int count,
                 double p) {
  for (int k = 0; k < count; k++) {
    for (int i = 0; i < count; i++) A[k][i] = k == 0 ? 1 : pow(step[i] / step[0], p + k - 1);
    A[k][count] = k == 0;
  }
}

static void swap_rows(double A[RICHARDSON_MAX][RICHARDSON_MAX + 1], int a, int b, int count) {
  for (int j = 0; j <= count; j++) {
    double t = A[a][j];
    A[a][j] = A[b][j], A[b][j] = t;
  }
}

bool richardson_weights(double weight[], const double step[], int count, double p) {
  double A[RICHARDSON_MAX][RICHARDSON_MAX + 1];
  if (count < 1 || count > RICHARDSON_MAX || !(p > 0)) return false;
  fill(A, step, count, p);
  for (int k = 0; k < count; k++) {
    int pivot = k;
    for (int i = k + 1; i < count; i++)
      if (fabs(A[i][k]) > fabs(A[pivot][k])) pivot = i;
    // Powers of steps with ratios 1.5 and more stay far above this; equal steps do not.
    if (!(fabs(A[pivot][k]) > 1e-30)) return false;
    swap_rows(A, k, pivot, count);
    for (int i = 0; i < count; i++) {
      if (i == k) continue;
      double factor = A[i][k] / A[k][k];
      for (int j = k; j <= count; j++) A[i][j] -= factor * A[k][j];
    }
  }
  for (int k = 0; k < count; k++) weight[k] = A[k][count] / A[k][k];
  return true;
}

void richardson_order(double *order, double *scatter, const double step[], const double error[],
                      int count) {
  double x0 = 0, y0 = 0, xx = 0, xy = 0, rest = 0;
  for (int i = 0; i < count; i++) {
    x0 += log(step[i]) / count;
    y0 += log(error[i]) / count;
  }
  for (int i = 0; i < count; i++) {
    double x = log(step[i]) - x0;
    xx += x * x;
    xy += x * (log(error[i]) - y0);
  }
  *order = isfinite(y0) ? xy / xx : NAN;
  for (int i = 0; i < count; i++) {
    double left = log(error[i]) - y0 - *order * (log(step[i]) - x0);
    rest += left * left / count;
  }
  *scatter = sqrt(rest);
}
