// SPDX-License-Identifier: Apache-2.0
#include "level_lines.h"

#include "track.h"

#include <stdlib.h>
#include <string.h>

// A connected piece of a contour that is drawn.
typedef struct line {
  double level; // as labelled
  int count;
  plot_point *points;
  bool labelled;
  plot_gaps gaps;
} line;

typedef struct sheet {
  plot *p;
  double level; // being traced
  int count, room;
  line *lines;
  bool left_out, lost;
} sheet;

static plot_style style_of(double level) {
  return level < 0 ? PLOT_DASHED : level > 0 ? PLOT_THIN : PLOT_HEAVY;
}

// Pixels between the middles of two lines, which are 1.1 wide: less white than that between them
// fills up in print.
static const double told_apart = 3;

static bool is_shown(sheet *s, const plot_point *points, int count) {
  // pixels: a shorter contour shows the grid, not the function, and a few dashes show no line
  const double speck = s->level < 0 ? 7 * (PLOT_DASH + PLOT_DASH_SPACE) : 40;
  track t;
  bool made = track_make(&t, s->p, points, count), shown = false;
  if (!made) s->lost = true;
  if (made && track_total(&t) >= speck) {
    shown = track_crowded_part(&t, &s->p->obstacles, told_apart) <= 0.5;
    if (!shown) s->left_out = true;
  }
  track_free(&t);
  return shown;
}

static bool has_room(sheet *s) {
  if (s->count < s->room) return true;
  int more = s->room ? 2 * s->room : 32;
  line *grown = realloc(s->lines, (size_t)more * sizeof *grown);
  if (!grown) return false;
  s->lines = grown;
  s->room = more;
  return true;
}

static void take_piece(const plot_point *points, int count, void *user) {
  sheet *s = user;
  if (count < 2 || !is_shown(s, points, count)) return;
  size_t size = (size_t)count * sizeof *points;
  plot_point *copy = malloc(size);
  if (!copy || !has_room(s)) {
    free(copy);
    s->lost = true;
    return;
  }
  memcpy(copy, points, size);
  s->lines[s->count++] = (line){.level = s->level, .count = count, .points = copy};
  plot_reserve_line(s->p, points, count);
}

static bool take_level(sheet *s, const level_set *set, const contour_grid *grid, double level) {
  s->level = level;
  return contour_trace(grid, set->inverse ? 1 / level : level, take_piece, s) && !s->lost;
}

// Zero first, then from the least level on: what comes later gives way.
static bool take_lines(sheet *s, const level_set *set, const contour_grid *grid) {
  int first = !set->upright && grid->y[0] == 0;
  contour_grid off = {grid->nx,
                      grid->ny - first,
                      grid->x,
                      grid->y + first,
                      grid->value + first * grid->nx,
                      grid->torn ? grid->torn + first * grid->nx : NULL};
  if (set->zero && !take_level(s, set, &off, 0)) return false;
  for (int k = 0; k < set->count; k++) {
    if (!take_level(s, set, grid, set->levels[k])) return false;
    if (set->both && !take_level(s, set, grid, -set->levels[k])) return false;
  }
  return true;
}

static void label_lines(sheet *s) {
  for (int i = 0; i < s->count; i++) {
    char text[32];
    line *l = &s->lines[i];
    snprintf(text, sizeof text, "%.10g", l->level);
    l->labelled = plot_label_line(&l->gaps, s->p, style_of(l->level), text, l->points, l->count);
  }
}

static bool is_named(const sheet *s, double level) {
  for (int i = 0; i < s->count; i++)
    if (s->lines[i].level == level && s->lines[i].labelled) return true;
  return level == 0; // the heavy one
}

bool level_lines_draw(plot *p, const level_set *set, const contour_grid *grid, bool *left_out) {
  sheet s = {.p = p};
  bool drawn = take_lines(&s, set, grid);
  if (drawn) label_lines(&s);
  for (int i = 0; i < s.count; i++) {
    const line *l = &s.lines[i];
    if (!is_named(&s, l->level))
      s.left_out = true;
    else if (drawn)
      plot_interrupted_line(p, style_of(l->level), l->points, l->count, &l->gaps);
  }
  for (int i = 0; i < s.count; i++) free(s.lines[i].points);
  free(s.lines);
  *left_out = s.left_out;
  return drawn;
}
