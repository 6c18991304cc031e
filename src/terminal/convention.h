// SPDX-License-Identifier: Apache-2.0
// Signs of what is shown. Inputs and the library are always ISO 8855.
#ifndef BICYCLE_TERMINAL_CONVENTION_H
#define BICYCLE_TERMINAL_CONVENTION_H

#include <bicycle/table.h>
#include <stdbool.h>

// "iso" or "sae".
bool term_parse_convention(bike_convention *out, const char *text);
const char *term_convention_name(bike_convention convention);

// Factor on every quantity that is left positive in ISO: steer, yaw, y, their derivatives, the
// torque on the steer and forces to the left. 1 or -1.
double term_left_sign(bike_convention convention);

// The positive lateral direction of forces: "left" or "right".
const char *term_lateral_name(bike_convention convention);

#endif
