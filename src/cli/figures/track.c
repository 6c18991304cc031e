// SPDX-License-Identifier: Apache-2.0
#include "track.h"

#include <stdlib.h>

bool track_make(track *out, const plot *p, const plot_point *points, int count) {
  *out = (track){count, calloc((size_t)count, sizeof *out->at),
                 calloc((size_t)count, sizeof *out->length)};
  if (!out->at || !out->length) return false;
  for (int i = 0; i < count; i++) {
    out->at[i] = plot_pixel(p, points[i]);
    if (i > 0) out->length[i] = out->length[i - 1] + draw_distance(out->at[i - 1], out->at[i]);
  }
  return true;
}

void track_free(track *t) {
  free(t->at);
  free(t->length);
}

double track_total(const track *t) {
  return t->length[t->count - 1];
}

draw_point track_point(const track *t, double length) {
  int low = 0, high = t->count - 1;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (t->length[middle] <= length)
      low = middle;
    else
      high = middle;
  }
  double span = t->length[high] - t->length[low];
  double part = span > 0 ? (length - t->length[low]) / span : 0;
  return (draw_point){t->at[low].x + part * (t->at[high].x - t->at[low].x),
                      t->at[low].y + part * (t->at[high].y - t->at[low].y)};
}

double track_crowded_part(const track *t, const draw_obstacles *obstacles, double distance) {
  const double step = 2; // pixels: finer than what is told apart
  double total = track_total(t);
  int places = 1 + (int)(total / step), crowded = 0;
  for (int i = 0; i < places; i++)
    crowded += draw_is_near_line(obstacles, track_point(t, total * (i + 0.5) / places), distance);
  return (double)crowded / places;
}
