// SPDX-License-Identifier: Apache-2.0
#ifndef BICYCLE_BATCH_EIGENVALUES_H
#define BICYCLE_BATCH_EIGENVALUES_H

#include <bicycle/stability.h>

// Four zeros of a real polynomial, conjugate to rounding only, as eigenvalues: exact pairs, or real
// numbers, sorted.
void eigenvalues_paired(bike_eigenvalues *out, const double re[4], const double im[4]);

#endif
