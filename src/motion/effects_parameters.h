// SPDX-License-Identifier: Apache-2.0
// The list of a bicycle's parameters, in our words or in the literature's symbols.
#ifndef BICYCLE_MOTION_EFFECTS_PARAMETERS_H
#define BICYCLE_MOTION_EFFECTS_PARAMETERS_H

#include "motion/variant_complex.h"

#include <bicycle/effects.h>

// Fills names, units, values and uncertainties; returns how many. With `literature` the bicycle is
// that of bike_from_meijaard.
int parameters_list(bike_parameter *out, const bike_bicycle *bicycle,
                    const bike_meijaard *literature);

// Adds `change` to parameter `index` of that list.
void parameters_add(vary_bicycle *inout, int index, bool literature, number change);

#endif
