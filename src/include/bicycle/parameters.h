// SPDX-License-Identifier: Apache-2.0
// The numbers of a bicycle file by name, and the bicycle that the file would give with some of them
// edited. Source of the names: the file itself, see model/README.md.
//
//   Meijaard's symbols (any form)        w, c, lam, ..., IFyy; yB, yH; steer_damping;
//                                        rider_share.mP, .xP, .yP, .zP where the file has it
//   parameterization: components         g; steer_damping; geometry.KEY, the five that the file
//                                        gives; of each part parts.NAME.mass;
//                                        parts.NAME.position.forward, .left, .up (not of wheels:
//                                        they follow their hubs); parts.NAME.inertia.spin or
//                                        .steering, or of a full tensor .Ixx, .Iyy, .Izz, .Ixy,
//                                        .Ixz, .Iyz (of a wheel .Ixx, which is Izz too, and .Iyy)
//
// Units are those of the file: SI and radians. What is not changed stays as the file writes it: an
// `inertia: {steering: T}` turns with the steering axis, a front part's `position` does not.
#ifndef BICYCLE_PARAMETERS_H
#define BICYCLE_PARAMETERS_H

#include <bicycle/file.h>

enum { BIKE_FILE_NUMBER_SIZE = BIKE_NAME_SIZE + 32 }; // of a name, with its terminator

// Constant after bike_parameters_read; may be shared between threads.
typedef struct bike_parameters bike_parameters;

// Reads a file of any form; `file` is as of bike_file_read, whose errors these are. `*out` is NULL
// on an error; end it with bike_parameters_free.
BIKE_API int bike_parameters_read(bike_parameters **out, bike_file *file, const char *path,
                                  bike_file_error *error);
BIKE_API void bike_parameters_free(bike_parameters *parameters);

// How many numbers the file has; each with its name, value, and standard uncertainty (0 where the
// file gives none). 0 <= index < count.
BIKE_API int bike_parameters_count(const bike_parameters *parameters);
BIKE_API const char *bike_parameters_name(const bike_parameters *parameters, int index);
BIKE_API double bike_parameters_value(const bike_parameters *parameters, int index);
BIKE_API double bike_parameters_sigma(const bike_parameters *parameters, int index);

// The index of a name, or -1.
BIKE_API int bike_parameters_find(const bike_parameters *parameters, const char *name);

// The bicycle with number index[i] at value[i], i < count, the others as in the file. Errors: NOT_
// FINITE, PARAMETER, IMPOSSIBLE, with one line in `error` (may be NULL): "mass must be positive"
// and the part or symbol; `out` is untouched then.
BIKE_API int bike_parameters_apply(bike_bicycle *out, const bike_parameters *parameters,
                                   const int *index, const double *value, int count,
                                   bike_file_error *error);

#endif
