// SPDX-License-Identifier: Apache-2.0
#include "terminal/convention.h"

#include <string.h>

static const char *const names[] = {[TERM_ISO] = "iso", [TERM_SAE] = "sae"};

bool term_parse_convention(term_convention *out, const char *text) {
  for (int i = TERM_ISO; i <= TERM_SAE; i++) {
    if (strcmp(text, names[i]) == 0) {
      *out = (term_convention)i;
      return true;
    }
  }
  return false;
}

const char *term_convention_name(term_convention convention) {
  return names[convention];
}

double term_left_sign(term_convention convention) {
  return convention == TERM_SAE ? -1 : 1;
}

const char *term_lateral_name(term_convention convention) {
  return convention == TERM_SAE ? "right" : "left";
}
