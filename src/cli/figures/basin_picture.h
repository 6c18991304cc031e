// SPDX-License-Identifier: Apache-2.0
// A basin of attraction as picture and table.
#ifndef BICYCLE_CLI_FIGURES_BASIN_PICTURE_H
#define BICYCLE_CLI_FIGURES_BASIN_PICTURE_H

#include "terminal/convention.h"
#include "terminal/exit_code.h"

#include <bicycle/basin.h>
#include <bicycle/bicycle.h>

// fates[j * nx + i] of leans[i], steers[j], both rising, in rad and ISO signs.
typedef struct basin_map {
  int nx, ny;
  double *leans, *steers;
  bike_fate *fates;
} basin_map;

// Writes the picture to `svg`, "X.svg", and the table to "X.csv"; each appears whole or not at all.
// On failure one line is printed.
term_exit basin_write(const basin_map *map, const bike_bicycle *bicycle, double speed, double time,
                      bike_convention convention, const char *svg);

#endif
