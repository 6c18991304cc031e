// SPDX-License-Identifier: Apache-2.0
// Error codes of the library: every function that can fail returns 0 (BIKE_OK) or one of these.
// Where it returns 0 all numbers of its result are finite, but for those whose comment says when
// they are not.
#ifndef BICYCLE_ERROR_H
#define BICYCLE_ERROR_H

#include <bicycle/export.h>

// Code and text together, so that neither can be added without the other.
#define BIKE_ERRORS(X)                                                                             \
  X(BIKE_OK, "no error")                                                                           \
  X(BIKE_ERROR_ARGUMENT, "an argument is missing or outside its range")                            \
  X(BIKE_ERROR_NOT_FINITE, "a number is not finite, or too large to compute with")                 \
  X(BIKE_ERROR_MEMORY, "out of memory")                                                            \
  X(BIKE_ERROR_PARAMETER, "a parameter of the bicycle is outside its range")                       \
  X(BIKE_ERROR_IMPOSSIBLE, "the two wheels of this bicycle cannot stand on the ground")            \
  X(BIKE_ERROR_NO_RIDER, "no part of the bicycle is the rider: `rider: true` in a list of parts, " \
                         "`rider_share` in a file of Meijaard's symbols mark him")                 \
  X(BIKE_ERROR_GEOMETRY,                                                                           \
    "no geometry: both wheels cannot touch the ground at this lean and steer")                     \
  X(BIKE_ERROR_SINGULAR, "singular: the accelerations are not determined at this state")           \
  X(BIKE_ERROR_SOLVER, "the integrator failed")                                                    \
  X(BIKE_ERROR_NO_CONVERGENCE, "no convergence")                                                   \
  X(BIKE_ERROR_NOT_STATIONARY, "the state asked for is not a stationary motion (riding "           \
                               "straight is one only of a bicycle that is its own mirror image)")  \
  X(BIKE_ERROR_INTERRUPTED, "interrupted by the caller")                                           \
  X(BIKE_ERROR_FILE, "a file cannot be read or written")                                           \
  X(BIKE_ERROR_SYNTAX, "a file does not say what it should")                                       \
  X(BIKE_ERROR_FULL, "full: more solutions or longer branches than a search has room for")

typedef enum bike_error {
#define BIKE_ERROR_CODE(code, text) code,
  BIKE_ERRORS(BIKE_ERROR_CODE)
#undef BIKE_ERROR_CODE
} bike_error;

// The text of a code, in lower case and without a full stop; never NULL.
BIKE_API const char *bike_error_string(int code);

#endif
