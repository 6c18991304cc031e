// SPDX-License-Identifier: Apache-2.0
// LAPACK for small row-major matrices with its workspaces on the stack: LAPACKE_dgeev and _dgesv
// allocate theirs, so that they can fail for want of memory.
#ifndef BICYCLE_MOTION_LAPACK_H
#define BICYCLE_MOTION_LAPACK_H

#include <stdbool.h>

enum { LAPACK_LARGEST = 16 };

// Eigenvalues of an n x n matrix, n <= LAPACK_LARGEST, conjugate pairs together, the one with the
// positive imaginary part first. `vectors` may be NULL; column k holds the right eigenvector of the
// real eigenvalue k, columns k and k + 1 hold its real and imaginary part for a pair, norm 1. False
// if a number is not finite or the QR iteration does not converge.
bool lapack_eigenvalues(double *re, double *im, double *vectors, const double *matrix, int n);

// Solves an n x n system; `x` is the right-hand side before. False
// if the matrix is singular or not finite.
bool lapack_solve(double *x, const double *matrix, int n);

#endif
