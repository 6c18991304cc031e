// SPDX-License-Identifier: Apache-2.0
// What figures were written, for scripts.
#ifndef BICYCLE_CLI_FIGURES_FIGURE_LIST_H
#define BICYCLE_CLI_FIGURES_FIGURE_LIST_H

#include "figure_set.h"
#include "terminal/convention.h"
#include "terminal/json.h"

// Files, axes with their ranges and units (those of the picture; tables are in SI units), and what
// is held fixed. NULL when out of memory.
json_t *figure_list_json(const figure_set *set, const char *folder, bike_convention convention);

#endif
