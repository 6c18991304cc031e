// SPDX-License-Identifier: Apache-2.0
#include "motion/lapack.h"

#include <lapacke.h>
#include <math.h>

enum { WORK = 64 * LAPACK_LARGEST }; // doubles: more than any block size asks for

// False if a number is not finite: LAPACK need not end then.
static bool transpose(double *out, const double *in, int n) {
  bool finite = true;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) finite &= isfinite(out[j * n + i] = in[i * n + j]) != 0;
  return finite;
}

bool lapack_eigenvalues(double *re, double *im, double *vectors, const double *matrix, int n) {
  double A[LAPACK_LARGEST * LAPACK_LARGEST], V[LAPACK_LARGEST * LAPACK_LARGEST], work[WORK];
  const char right = vectors ? 'V' : 'N';
  lapack_int room = WORK;
  if (!transpose(A, matrix, n)) return false;
  // as much room as it likes best, which the order of its sums may depend on
  if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', right, n, A, n, re, im, NULL, n, V, n, work, -1))
    return false;
  if (work[0] < WORK) room = (lapack_int)work[0];
  if (LAPACKE_dgeev_work(LAPACK_COL_MAJOR, 'N', right, n, A, n, re, im, NULL, n, V, n, work, room))
    return false;
  return !vectors || transpose(vectors, V, n);
}

bool lapack_solve(double *x, const double *matrix, int n) {
  double A[LAPACK_LARGEST * LAPACK_LARGEST];
  lapack_int pivots[LAPACK_LARGEST];
  return transpose(A, matrix, n) &&
         LAPACKE_dgesv_work(LAPACK_COL_MAJOR, n, 1, A, n, pivots, x, n) == 0;
}
