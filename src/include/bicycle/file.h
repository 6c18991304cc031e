// SPDX-License-Identifier: Apache-2.0
// Bicycle files: YAML in three parameterizations and BicycleParameters' text form.
#ifndef BICYCLE_FILE_H
#define BICYCLE_FILE_H

#include <bicycle/bicycle.h>

enum { BIKE_MESSAGE_SIZE = 1024, BIKE_MEIJAARD_COUNT = 26 };

// What is wrong with a file, in one line: "path:line: key: what". Always terminated.
typedef struct bike_file_error {
  char text[BIKE_MESSAGE_SIZE];
} bike_file_error;

// The 26 symbols of Meijaard et al. (2007), in the order of bike_meijaard_symbols.
typedef struct bike_meijaard {
  double value[BIKE_MEIJAARD_COUNT];
  double sigma[BIKE_MEIJAARD_COUNT]; // standard uncertainty, 0 where none is given
} bike_meijaard;

// What a file holds: the bicycle, and its literature parameters where it is written in them.
typedef struct bike_file {
  bike_bicycle bicycle;
  bool has_meijaard;      // the file uses Meijaard's symbols
  bool has_uncertainty;   // at least one of them carries an uncertainty
  bike_meijaard meijaard; //
} bike_file;

// "w", "c", "lam", "g", "rR", "mR", "IRxx", "IRyy", "xB", "zB", "mB", "IBxx", "IByy", "IBzz",
// "IBxz", "xH", "zH", "mH", "IHxx", "IHyy", "IHzz", "IHxz", "rF", "mF", "IFxx", "IFyy";
// NULL-terminated.
BIKE_API const char *const *bike_meijaard_symbols(void);

// Reads a file of any form. BIKE_ERROR_FILE, BIKE_ERROR_SYNTAX, BIKE_ERROR_PARAMETER,
// BIKE_ERROR_IMPOSSIBLE or BIKE_ERROR_MEMORY with one line in `error` (may be NULL, here and
// below); `out` is untouched then. A bicycle without a name of its own takes that of its file.
BIKE_API int bike_file_read(bike_file *out, const char *path, bike_file_error *error);

// Writes the bicycle as `parameterization: Meijaard2007`, whole or not at all, so that
// BicycleParameters loads it back. Rigid parts are lumped, so reading it back gives the same model,
// not the same list of parts: `rider: true` and a block `rider_share` (the rider's mass and place,
// which are also in B) keep the rider, `steer_damping` the damper; the uncertainty of a file is not
// written. `path` NULL or "-" is the standard output. BIKE_ERROR_PARAMETER for a bicycle that the
// form cannot hold: products of inertia Ixy or Iyz, a frame or wheel without mass.
BIKE_API int bike_file_write(const bike_bicycle *bicycle, const char *path, bike_file_error *error);

// The bicycle of literature parameters: rear frame "B" with the rider in it, handlebar assembly
// "H", wheels "R" and "F", no damping. BIKE_ERROR_NOT_FINITE, or BIKE_ERROR_PARAMETER where lam is
// not within +-pi/2; the other rules are bike_check's.
BIKE_API int bike_from_meijaard(bike_bicycle *out, const double value[BIKE_MEIJAARD_COUNT]);

// And back, with the rider in B; lateral positions, the damper and which share of B is the rider
// are not in these numbers. Errors: those of bike_check, and BIKE_ERROR_PARAMETER as above.
BIKE_API int bike_to_meijaard(double value[BIKE_MEIJAARD_COUNT], const bike_bicycle *bicycle);

#endif
