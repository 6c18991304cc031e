// SPDX-License-Identifier: Apache-2.0
// Linear stability of riding straight and upright: eigenvalues, critical speeds, stable ranges.
#ifndef BICYCLE_STABILITY_H
#define BICYCLE_STABILITY_H

#include <bicycle/linear.h>
#include <stdbool.h>

// Four eigenvalues, in falling order of real, then of imaginary part. Unit 1/s.
typedef struct bike_eigenvalues {
  double re[4];
  double im[4];
} bike_eigenvalues;

enum { BIKE_MAX_CRITICAL = 16 };

// Critical speeds in rising order, m/s. weave: a complex pair crosses the imaginary axis;
// capsize: a real eigenvalue crosses zero. A range is stable where all real parts are negative.
typedef struct bike_critical_speeds {
  int weave_count;
  double weave[BIKE_MAX_CRITICAL];
  int capsize_count;
  double capsize[BIKE_MAX_CRITICAL];
  int range_count;
  double ranges[BIKE_MAX_CRITICAL][2];
} bike_critical_speeds;

// Eigenvalues of A (row-major, 4 x 4). Errors: ARGUMENT, NOT_FINITE (a number of A, or an
// eigenvalue), NO_CONVERGENCE.
BIKE_API int bike_eigenvalues_of(bike_eigenvalues *out, const double A[16]);

// Real parts below this, in either direction, are rounding, 1/s: some 1e4 roundings of the largest
// eigenvalue, as A and its eigenvalues carry. An eigenvalue within it neither grows nor decays.
BIKE_API double bike_neutral_band(const bike_eigenvalues *eigenvalues);

// Whether every motion decays; a neutral one does not.
BIKE_API bool bike_all_decay(const bike_eigenvalues *eigenvalues);

// Eigenvalues of upright straight riding at a speed (any sign, zero included).
BIKE_API int bike_upright_eigenvalues(bike_eigenvalues *out, const bike_model *model, double speed);

// Where a range of speeds to look in ends unless one is given, m/s: well above the speeds at which
// a bicycle of this size is ridden. 40 where sqrt(g L), L the reach of the model, is what people
// ride on earth, 2^k times that where it is 2^k times as large (Froude's similarity).
BIKE_API double bike_search_end(const bike_model *model);

// All critical speeds with low <= speed <= high (0 <= low < high), to 1e-13 relative.
BIKE_API int bike_upright_critical_speeds(bike_critical_speeds *out, const bike_model *model,
                                          double low, double high);

#endif
