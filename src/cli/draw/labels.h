// SPDX-License-Identifier: Apache-2.0
// Labels wait until every line is drawn, and then take the best of the places they were offered.
#ifndef BICYCLE_CLI_DRAW_LABELS_H
#define BICYCLE_CLI_DRAW_LABELS_H

#include "canvas.h"

enum { DRAW_MAX_PLACES = 40, DRAW_MAX_LABELS = 64, DRAW_REST_SIZE = 128 };

typedef struct draw_waiting {
  const char *symbol, *subscript; // static texts
  char rest[DRAW_REST_SIZE];
  draw_point places[DRAW_MAX_PLACES]; // middles, the preferred first
  int place_count;
  bool has_anchor;   // what it names is a point, joined by a thin line where it is far
  draw_point anchor; //
} draw_waiting;

typedef struct draw_labels {
  draw_waiting items[DRAW_MAX_LABELS];
  int count;
} draw_labels;

// A new label without places. The last one is reused when there are too many.
draw_waiting *draw_new_label(draw_labels *labels, const char *symbol, const char *subscript,
                             const char *format, ...) __attribute__((format(printf, 4, 5)));

// Offers a place such that the label lies beside `point`, on the side of `direction` (a unit
// vector), with `gap` pixels in between.
void draw_offer(draw_waiting *label, draw_point point, draw_point direction, double gap);

// Offers places all around a point, the nearest first.
void draw_offer_around(draw_waiting *label, draw_point point, double gap);

// Writes them all, in the order in which they came.
void draw_place_labels(draw_canvas *canvas, const draw_labels *labels);

#endif
