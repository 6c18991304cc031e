// SPDX-License-Identifier: Apache-2.0
// Small symmetric semidefinite systems: constraints may repeat each other.
#include "rolling_internal.h"

#include <math.h>

// A row counts as dependent on those before it when less than this part of its diagonal is left: an
// angle of 1e-5 between constraints, far from any real mechanism's, and far above the rounding of
// M^-1 (1e-13 for a mass matrix of condition 1e3).
static const mjtNum dependent = 1e-10;

// A row counts as empty when its diagonal is less than this part of the largest: no motion can
// change what it says (the height of a body that only slides). What rounding leaves of such a row
// is 1e-16 of others, squared; different inverse masses of real mechanisms are far above.
static const mjtNum empty = 1e-24;

static mjtNum dot(const mjtNum *a, const mjtNum *b, int n) {
  mjtNum sum = 0;
  for (int i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

// A NaN is the largest, and makes no row empty: it must be seen in the result.
static mjtNum largest_diagonal(const mjtNum *A, int n) {
  mjtNum most = 0;
  for (int i = 0; i < n; i++)
    if (!(A[i * n + i] <= most)) most = A[i * n + i];
  return most;
}

// Makes of a symmetric matrix its lower triangular factor, in place, with a column only for rows
// that are independent of those before them. Row i of A is not needed once row i of L is there, and
// pivot[k] >= k: no entry is overwritten before it is used. inverse[k] = 1/L[pivot[k]][k].
// Returns the rank; counts dependent rows that are not empty in *repeated.
static int factorise(mjtNum *A, mjtNum *inverse, int *pivot, int *repeated, int n) {
  int rank = 0;
  mjtNum nothing = empty * largest_diagonal(A, n);
  *repeated = 0;
  for (int i = 0; i < n; i++) {
    mjtNum *row = A + i * n, diagonal = row[i], left = diagonal;
    int is_empty = diagonal <= nothing;
    for (int k = 0; k < rank; k++) {
      row[k] = is_empty ? 0 : (row[pivot[k]] - dot(row, A + pivot[k] * n, k)) * inverse[k];
      left -= row[k] * row[k];
    }
    for (int k = rank; k < n; k++) row[k] = 0;
    if (is_empty) continue;
    // An independent row opens a column; a NaN counts as independent.
    if (left <= dependent * diagonal) {
      ++*repeated;
    } else {
      row[rank] = sqrt(left);
      inverse[rank] = 1 / row[rank];
      pivot[rank++] = i;
    }
  }
  return rank;
}

// x = (L L^T)^-1 x for a full n x n lower triangle with the inverses of its diagonal.
static void substitute(mjtNum *x, const mjtNum *L, const mjtNum *inverse, int n) {
  for (int i = 0; i < n; i++) x[i] = (x[i] - dot(L + i * n, x, i)) * inverse[i];
  for (int i = n - 1; i >= 0; i--) {
    x[i] *= inverse[i];
    for (int k = 0; k < i; k++) x[k] -= L[i * n + k] * x[i];
  }
}

// y = L^T x, with rank columns.
static void multiply_transposed(mjtNum *y, const roll_factor *f, const mjtNum *x) {
  mju_zero(y, f->rank);
  for (int i = 0; i < f->n; i++) mju_addToScl(y, f->L + i * f->n, x[i], f->rank);
}

// G = L^T L, the full matrix, rank x rank.
static void gram(mjtNum *G, const roll_factor *f) {
  int r = f->rank;
  mju_zero(G, r * r);
  for (int i = 0; i < f->n; i++)
    for (int k = 0; k < r; k++) mju_addToScl(G + k * r, f->L + i * f->n, f->L[i * f->n + k], r);
}

void roll_factorise(roll_factor *f) {
  f->rank = factorise(f->L, f->inverse, f->pivot, &f->repeated, f->n);
  if (f->rank == f->n) return;
  int none; // columns are independent: full rank again
  gram(f->G, f);
  factorise(f->G, f->inverse, f->pivot, &none, f->rank);
}

void roll_solve(mjtNum *x, const roll_factor *f, const mjtNum *b) {
  if (f->rank == f->n) {
    if (x != b) mju_copy(x, b, f->n);
    substitute(x, f->L, f->inverse, f->n);
    return;
  }
  // A^+ b = L G^-1 G^-1 L^T b with G = L^T L
  mjtNum *y = f->work;
  multiply_transposed(y, f, b);
  substitute(y, f->G, f->inverse, f->rank);
  substitute(y, f->G, f->inverse, f->rank);
  for (int i = 0; i < f->n; i++) x[i] = dot(f->L + i * f->n, y, f->rank);
}
