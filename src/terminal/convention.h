// SPDX-License-Identifier: Apache-2.0
// Signs of what is shown. Inputs and the library are always ISO 8855.
#ifndef BICYCLE_TERMINAL_CONVENTION_H
#define BICYCLE_TERMINAL_CONVENTION_H

#include <stdbool.h>

typedef enum term_convention {
  TERM_ISO, // lean right; steer, yaw and y LEFT positive
  TERM_SAE  // lean right; steer, yaw and y RIGHT positive, as in the bicycle literature
} term_convention;

// "iso" or "sae".
bool term_parse_convention(term_convention *out, const char *text);
const char *term_convention_name(term_convention convention);

// Factor on every quantity that is left positive in ISO: steer, yaw, y, their derivatives, the
// torque on the steer and forces to the left. 1 or -1.
double term_left_sign(term_convention convention);

// The positive lateral direction of forces: "left" or "right".
const char *term_lateral_name(term_convention convention);

#endif
