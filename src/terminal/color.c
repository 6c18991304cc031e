// SPDX-License-Identifier: Apache-2.0
#include "terminal/color.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool term_is_interactive(FILE *stream) {
  const char *terminal = getenv("TERM");
  return isatty(fileno(stream)) && terminal && strcmp(terminal, "dumb") != 0;
}

bool term_has_color(FILE *stream) {
  const char *refused = getenv("NO_COLOR");
  return !(refused && *refused) && term_is_interactive(stream);
}

const char *term_style_begin(FILE *stream, term_style style) {
  static const char *const sequence[TERM_STYLE_COUNT] = {
      [TERM_PLAIN] = "",        [TERM_BOLD] = "\033[1m",   [TERM_DIM] = "\033[2m",
      [TERM_GOOD] = "\033[32m", [TERM_BAD] = "\033[1;31m",
  };
  return term_has_color(stream) ? sequence[style] : "";
}

const char *term_style_end(FILE *stream, term_style style) {
  return style != TERM_PLAIN && term_has_color(stream) ? "\033[0m" : "";
}
