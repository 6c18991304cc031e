// SPDX-License-Identifier: Apache-2.0
// The figures of one bicycle: pictures and tables kept in memory until all are made, then written
// with a page that holds them.
#ifndef BICYCLE_CLI_FIGURES_FIGURE_SET_H
#define BICYCLE_CLI_FIGURES_FIGURE_SET_H

#include "plot.h"
#include "terminal/convention.h"
#include "terminal/exit_code.h"

#include <bicycle/bicycle.h>

// Static texts but for the caption, which need not outlive figure_add. `held` says what is held
// fixed along the axes.
typedef struct figure_words {
  const char *name;   // of its files, without their ends
  const char *number; // as in "2(a)"
  const char *title, *caption, *held;
} figure_words;

typedef struct figure {
  const char *name, *held;
  plot_axis x, y;
  char title[160];
  char *svg, *csv;
  size_t svg_size, csv_size;
} figure;

enum { MAX_FIGURES = 8, FIGURE_CAPTION = 768 }; // bytes of a caption

typedef struct figure_set {
  const bike_bicycle *bicycle;
  bike_convention convention; // of steering angles
  int count;
  figure figures[MAX_FIGURES];
  char note[400]; // what could not be drawn, and why; may be empty
} figure_set;

// Adds a picture; draws `p` with "Figure NUMBER, BICYCLE. CAPTION" below. Returns where its table
// goes: write it and close it. NULL when out of memory. The title is "BICYCLE: title".
FILE *figure_add(figure_set *set, const figure_words *words, plot *p);

// "left" or "right".
const char *figure_positive_steer(const figure_set *set);

// Makes the folder if need be, and writes NAME.svg, NAME.csv of every figure and index.html. Each
// file appears whole or not at all. On failure one line is printed.
term_exit figure_write_all(const figure_set *set, const char *folder);

void figure_set_free(figure_set *set);

#endif
