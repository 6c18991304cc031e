// SPDX-License-Identifier: Apache-2.0
// The branch of limit cycles that is born at the weave speed, as picture and table.
#ifndef BICYCLE_CLI_FIGURES_CYCLE_PICTURE_H
#define BICYCLE_CLI_FIGURES_CYCLE_PICTURE_H

#include "terminal/convention.h"
#include "terminal/exit_code.h"

#include <bicycle/bicycle.h>
#include <bicycle/cycle.h>

typedef struct cycle_branch {
  const bike_hopf *hopf;
  const bike_cycle *cycles; // rising amplitude
  int count;                // at least one
} cycle_branch;

// Writes the picture, amplitude against distance below the weave speed, to `svg`, "X.svg", and the
// table to "X.csv"; each appears whole or not at all. On failure one line is printed.
term_exit cycle_write(const cycle_branch *branch, const bike_bicycle *bicycle,
                      bike_convention convention, const char *svg);

#endif
