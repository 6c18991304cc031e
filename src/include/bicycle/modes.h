// SPDX-License-Identifier: Apache-2.0
// Modes of a linearised motion: eigenvalues with their eigenvectors and names.
//
// Names as in Meijaard, Papadopoulos, Ruina, Schwab (2007), section 6: weave, the oscillation in
// which steer follows lean; capsize, the slow fall, or return, in which lean is large; castering,
// the fast decay in which steer is large.
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

// Modes of A (row-major, as of bike_linear), named by their eigenvectors where that is clear: two
// real modes, of which the lower decays faster than the other grows or decays and has the larger
// share of steer, are castering and capsize, and the oscillation beside them weave; so is one
// without them if steer lags behind lean. Otherwise unnamed. Errors: ARGUMENT, NOT_FINITE,
// NO_CONVERGENCE.
BIKE_API int bike_modes_of(bike_modes *out, const double A[16]);

// Modes of upright straight riding at speeds of any sign and in any order, m/s. The name of a mode
// depends on the bicycle and the speed alone.
//
// Eigenvalues collide at isolated speeds; between them real ones keep their order and pairs stay
// pairs. Names start between two collisions with one oscillation, the fastest in which steer lags
// behind lean below bike_search_end: weave. Of the two real modes there capsize is the one that
// passes zero, or, where neither or both do, the slower. They are carried from one collision to the
// next, to any speed, backwards through zero. The two real modes that weave is made of are both
// weave. Capsize and castering that join are JOINED, and told apart as above where they part.
// Where weave meets one of these, both names end: what goes on from there is unnamed. So are all
// modes of a bicycle that nowhere has one oscillation.
// Errors: those of bike_linearize_upright and bike_modes_of.
BIKE_API int bike_upright_modes(bike_modes *out, const bike_model *model, const double *speeds,
                                int count);

enum { BIKE_MAX_NAME_ENDS = 40 };

// A speed at which modes of different names meet, and both names end.
typedef struct bike_name_end {
  double speed; // m/s; on the far side of it, seen from where names start, they are unnamed
  bike_mode modes[2];
} bike_name_end;

// All of them, in no particular order. Same errors.
BIKE_API int bike_upright_name_ends(bike_name_end out[BIKE_MAX_NAME_ENDS], int *count,
                                    const bike_model *model);

#endif
