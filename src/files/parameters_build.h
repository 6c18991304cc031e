// SPDX-License-Identifier: Apache-2.0
// From the numbers of a file, changed after reading, to a bicycle: what reading does, without lines
// to blame.
#ifndef FILES_PARAMETERS_BUILD_H
#define FILES_PARAMETERS_BUILD_H

#include "source.h"

bool parameters_is_wheel(const bike_component *component);

// Both may change what they are given. The bicycle's name is left empty.
int parameters_from_symbols(bike_bicycle *out, bike_symbols *symbols, bike_file_error *error);
int parameters_from_description(bike_bicycle *out, bike_description *description,
                                bike_file_error *error);

#endif
