// SPDX-License-Identifier: Apache-2.0
#include "terminal/convention.h"

#include <string.h>

static const char *const names[] = {[BIKE_CONVENTION_ISO] = "iso", [BIKE_CONVENTION_SAE] = "sae"};

bool term_parse_convention(bike_convention *out, const char *text) {
  for (int i = BIKE_CONVENTION_ISO; i <= BIKE_CONVENTION_SAE; i++) {
    if (strcmp(text, names[i]) == 0) {
      *out = (bike_convention)i;
      return true;
    }
  }
  return false;
}

const char *term_convention_name(bike_convention convention) {
  return names[convention];
}

double term_left_sign(bike_convention convention) {
  return convention == BIKE_CONVENTION_SAE ? -1 : 1;
}

const char *term_lateral_name(bike_convention convention) {
  return convention == BIKE_CONVENTION_SAE ? "right" : "left";
}
