// SPDX-License-Identifier: Apache-2.0
// Ranges of angles on the command line.
#ifndef BICYCLE_CLI_ANGLE_RANGE_H
#define BICYCLE_CLI_ANGLE_RANGE_H

#include "terminal/number.h"

// What a command takes: `least` to `most` angles between two limits that are no part of it, or with
// the lower one where `from_low`.
typedef struct cli_angle_bounds {
  double low, high; // rad
  bool from_low;
  long least, most;
} cli_angle_bounds;

// "A:B:N" as term_parse_angle_range; `option` is its name, as in "--leans". A wrong range ends the
// program through term_usage.
term_range cli_angle_range_of(const char *option, const char *text, const cli_angle_bounds *bounds);

#endif
