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

// "w", "c", "lam", "g", "rR", "mR", "IRxx", "IRyy", "xB", ... "IFyy".
BIKE_API const char *const *bike_meijaard_symbols(void);

// Reads a file. BIKE_ERROR_FILE, BIKE_ERROR_SYNTAX, BIKE_ERROR_PARAMETER, BIKE_ERROR_IMPOSSIBLE or
// BIKE_ERROR_MEMORY with one line in `error`; `out` is untouched then.
BIKE_API int bike_file_read(bike_file *out, const char *path, bike_file_error *error);

// Writes the bicycle as `parameterization: Meijaard2007` with a `rider:` block where there is a
// rider, so that BicycleParameters loads it back: whole or not at all. Rigid parts are lumped, so
// reading it back gives the same model, not the same list of parts.
BIKE_API int bike_file_write(const bike_bicycle *bicycle, const char *path, bike_file_error *error);

// Literature parameters of a bicycle, and back (a rear frame "B" with the rider in it, a handlebar
// assembly "H", wheels "R", "F"; lateral positions and products of inertia are lost).
BIKE_API int bike_from_meijaard(bike_bicycle *out, const double value[BIKE_MEIJAARD_COUNT]);

#endif
