// SPDX-License-Identifier: Apache-2.0
// Figures 3 and 4: the stable range of upright riding against a parameter.
#ifndef BICYCLE_CLI_FIGURES_FIGURE_RANGE_H
#define BICYCLE_CLI_FIGURES_FIGURE_RANGE_H

#include "figure_set.h"
#include "terminal/number.h"
#include "terminal/progress.h"

#include <bicycle/variant.h>

// One way of changing the bicycle.
typedef struct range_family {
  bike_variation variation;
  bike_front_hold hold;
  const char *label; // in the key, after "limits, "
} range_family;

typedef struct range_figure {
  figure_words words;
  const char *family_column, *value_column; // of the table; families are numbered 0, 1
  plot_title axis;
  double factor; // from SI to the unit of the axis
  range_family families[2];
  term_range values; // SI
  double fastest;    // m/s  end of the axis of speed
  bool fit;          // end the axis above the fastest limit instead, if that is slower
} range_figure;

// Adds the figure. Errors: those of bike_variation_value, MEMORY.
int figure_add_range(figure_set *set, const range_figure *what, term_progress *progress);

#endif
