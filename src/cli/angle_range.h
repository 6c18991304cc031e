// SPDX-License-Identifier: Apache-2.0
// Ranges of angles on the command line.
#ifndef BICYCLE_CLI_ANGLE_RANGE_H
#define BICYCLE_CLI_ANGLE_RANGE_H

#include "terminal/number.h"

// "A:B:N" as term_parse_range, A and B in radians or, with the suffix deg, in degrees.
bool cli_parse_angle_range(term_range *out, const char *text);

#endif
