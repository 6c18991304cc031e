// SPDX-License-Identifier: Apache-2.0
#include "escape.h"

void draw_put_escaped(FILE *stream, const char *text) {
  for (; *text; text++) {
    switch (*text) {
    case '&':
      fputs("&amp;", stream);
      break;
    case '<':
      fputs("&lt;", stream);
      break;
    case '>':
      fputs("&gt;", stream);
      break;
    case '"':
      fputs("&quot;", stream);
      break;
    default:
      fputc((unsigned char)*text < ' ' ? ' ' : *text, stream);
    }
  }
}

double draw_count_characters(const char *text) {
  double count = 0;
  for (; *text; text++) count += ((unsigned char)*text & 0xC0) != 0x80;
  return count;
}
