// SPDX-License-Identifier: Apache-2.0
// Frame, ticks, titles and caption of a plot; its size on the page.
#ifndef BICYCLE_CLI_FIGURES_PLOT_FRAME_H
#define BICYCLE_CLI_FIGURES_PLOT_FRAME_H

#include "plot.h"

// Pixels.
enum {
  FRAME_LEFT = 84,
  FRAME_TOP = 18,
  FRAME_WIDTH = 560,
  FRAME_HEIGHT = 400,
  PLOT_WIDTH = FRAME_LEFT + FRAME_WIDTH + 26,
  PLOT_FONT = 15,
  CAPTION_FONT = 12,
  CAPTION_LINE = 17,
  KEY_LINE = 20
};

void frame_draw(const plot *p, FILE *stream);

// The middle of a row of a key between the title of the x axis and the caption.
double frame_key_row(int row);

// Lines that a caption takes, its {symbols} in italics, below the rows of a key; writes them if
// `stream` is not NULL.
int frame_caption(const char *text, int key_rows, FILE *stream);

// Height of the picture for a number of lines of caption and rows of a key above it.
double frame_total_height(int caption_lines, int key_rows);

#endif
