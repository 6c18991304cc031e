// SPDX-License-Identifier: Apache-2.0
// Figure 1 of Franke, Suhr and Riess (1990) for any bicycle: the upright bicycle from its right
// side, with the lengths of equations (4)-(7).
#ifndef BICYCLE_CLI_DRAW_DRAWING_H
#define BICYCLE_CLI_DRAW_DRAWING_H

#include <bicycle/bicycle.h>
#include <stdio.h>

// Writes the picture as SVG. An error code of the library; what was written is then of no use.
int draw_bicycle(const bike_bicycle *bicycle, FILE *stream);

#endif
