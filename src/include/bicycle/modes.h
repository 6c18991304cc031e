// SPDX-License-Identifier: Apache-2.0
// Modes of a linearised motion: eigenvalues with their eigenvectors, followed along a path and
// named.
//
// Names as in Meijaard, Papadopoulos, Ruina, Schwab (2007), section 6: weave, the oscillation of
// steer and lean; capsize, the slow fall in which lean is large; castering, the fast decay in which
// steer is large.
#ifndef BICYCLE_MODES_H
#define BICYCLE_MODES_H

#include <bicycle/stability.h>

typedef enum bike_mode {
  BIKE_MODE_UNNAMED,
  BIKE_MODE_WEAVE, // two of the four
  BIKE_MODE_CAPSIZE,
  BIKE_MODE_CASTERING,
  BIKE_MODE_JOINED // capsize and castering, joined into a second oscillation
} bike_mode;

// In falling order of the eigenvalues' real, then imaginary part.
typedef struct bike_modes {
  bike_eigenvalues values; // 1/s
  double vectors_re[4][4]; // [mode][steer, lean, steer rate, lean rate]; together of unit length,
  double vectors_im[4][4]; //   turned so that the larger of steer and lean is real and positive
  bike_mode mode[4];       //
} bike_modes;

// "weave", "capsize", "castering", "capsize and castering", "unnamed".
BIKE_API const char *bike_mode_string(bike_mode mode);

// Modes of A (row-major, as of bike_linear). Named by their eigenvectors where that is clear: one
// oscillation (weave) and two real modes, of which the one with the larger share of steer is
// castering; otherwise unnamed. Errors: ARGUMENT, NOT_FINITE, NO_CONVERGENCE.
BIKE_API int bike_modes_of(bike_modes *out, const double A[16]);

// A matrix as a function of a parameter: 0 or an error code.
typedef int bike_matrix_function(double A[16], double parameter, void *user);

// Modes at `count` parameters in rising or falling order. Named by their eigenvectors at the place
// of the list with one oscillation, the fastest, and from there by continuity: intervals are halved
// until each mode is recognised in the next. Modes stay unnamed on a path without such a place.
// Errors: those of the function and of bike_modes_of.
BIKE_API int bike_modes_follow(bike_modes *out, const double *parameters, int count,
                               bike_matrix_function *function, void *user);

// The same for upright straight riding; parameters are speeds, m/s.
BIKE_API int bike_upright_modes(bike_modes *out, const bike_model *model, const double *speeds,
                                int count);

#endif
