// SPDX-License-Identifier: Apache-2.0
// Colour, only where a person reads: on a terminal, and not against their wish.
#ifndef BICYCLE_TERMINAL_COLOR_H
#define BICYCLE_TERMINAL_COLOR_H

#include <stdbool.h>
#include <stdio.h>

typedef enum term_style {
  TERM_PLAIN,
  TERM_BOLD,
  TERM_DIM,
  TERM_GOOD, // green
  TERM_BAD,  // red, bold
  TERM_STYLE_COUNT
} term_style;

// True on a terminal that understands control sequences.
bool term_is_interactive(FILE *stream);

// True on an interactive terminal unless NO_COLOR is set and not empty (no-color.org).
bool term_has_color(FILE *stream);

// Sequences to put before and after a text; empty without colour.
const char *term_style_begin(FILE *stream, term_style style);
const char *term_style_end(FILE *stream, term_style style);

#endif
