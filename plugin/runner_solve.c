// SPDX-License-Identifier: Apache-2.0
#include "runner_internal.h"

#include <math.h>

static void swap(double *a, double *b) {
  double t = *a;
  *a = *b, *b = t;
}

bool runner_solve(int n, double *A, double *b) {
  for (int k = 0; k < n; k++) {
    int pivot = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(A[n * i + k]) > fabs(A[n * pivot + k])) pivot = i;
    if (!(fabs(A[n * pivot + k]) > mjMINVAL)) return false;
    for (int j = 0; j < n; j++) swap(&A[n * k + j], &A[n * pivot + j]);
    swap(&b[k], &b[pivot]);
    for (int i = k + 1; i < n; i++) {
      double factor = A[n * i + k] / A[n * k + k];
      for (int j = k; j < n; j++) A[n * i + j] -= factor * A[n * k + j];
      b[i] -= factor * b[k];
    }
  }
  for (int k = n - 1; k >= 0; k--) {
    for (int j = k + 1; j < n; j++) b[k] -= A[n * k + j] * b[j];
    b[k] /= A[n * k + k];
  }
  return true;
}
