// SPDX-License-Identifier: Apache-2.0
// Texts of files and users within XML and HTML.
#ifndef BICYCLE_CLI_DRAW_ESCAPE_H
#define BICYCLE_CLI_DRAW_ESCAPE_H

#include <stdio.h>

// Reserved characters escaped, control characters as spaces.
void draw_put_escaped(FILE *stream, const char *text);

// Characters of UTF-8.
double draw_count_characters(const char *text);

#endif
