// SPDX-License-Identifier: Apache-2.0
// Figure 2: parameters of stationary motion as functions of speed and lean.
#ifndef BICYCLE_CLI_FIGURES_FIGURE_MAP_H
#define BICYCLE_CLI_FIGURES_FIGURE_MAP_H

#include "figure_set.h"
#include "map.h"

// Adds fig2a (steer), fig2b (rider offset), fig2c (largest eigenvalue) and fig2d (reaction time).
// False when out of memory.
bool figure_add_maps(figure_set *set, const turn_map *map);

#endif
