// SPDX-License-Identifier: Apache-2.0
#include "figure_map.h"

#include "contour.h"

#include <bicycle/table.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEGREES = 180 / 3.14159265358979323846;

// One panel: a quantity over speed and lean, in the unit of its contours.
typedef struct panel {
  const char *name, *title, *caption;
  const char *column;   // of the table
  const double *levels; // rising; contours with the opposite sign are added if `both`
  int level_count;
  bool both;
  bool zero;     // a heavy contour zero
  bool stable;   // the region eps_max < 0 is shaded
  bool upright;  // contours reach lean zero
  bool inverse;  // levels are labelled with L and drawn where the quantity is 1/L
  double factor; // from SI to the unit of the contours
} panel;

static const double steers[] = {1, 2, 5, 10, 15, 20, 30, 40, 60, 80};
static const double offsets[] = {0.2, 0.5, 1, 2, 5, 10, 20, 50};
static const double growths[] = {0.2, 0.5, 1, 1.5, 2, 3, 4, 5, 7, 10};
static const double times[] = {0.1, 0.2, 0.3, 0.5, 1, 2, 5, 10};
#define COUNT(levels) ((int)(sizeof(levels) / sizeof(levels)[0]))

// A plot being filled with contours of one level.
typedef struct pen {
  plot *p;
  plot_style style;
  const char *label; // NULL: lines; else labels
} pen;

// Length of a piece, pixels.
static double length_of(const plot *p, const plot_point *points, int count) {
  double length = 0;
  for (int i = 1; i < count; i++)
    length += draw_distance(plot_pixel(p, points[i - 1]), plot_pixel(p, points[i]));
  return length;
}

static void draw_piece(const plot_point *points, int count, void *user) {
  const pen *use = user;
  const double speck = 40; // pixels: a shorter contour shows the grid, not the function
  if (length_of(use->p, points, count) < speck) return;
  if (use->label)
    plot_label_line(use->p, use->label, points, count);
  else
    plot_line(use->p, use->style, points, count);
}

static void fill_piece(const plot_point *points, int count, void *user) {
  plot_area(user, PLOT_LIGHT, points, count);
}

// Lines of all levels first, so that labels know what is in their way.
static bool draw_level(plot *p, const panel *what, const contour_grid *grid, double level,
                       bool labels) {
  char text[32];
  snprintf(text, sizeof text, "%.10g", level);
  pen use = {p, level < 0 ? PLOT_DASHED : level > 0 ? PLOT_THIN : PLOT_HEAVY, labels ? text : NULL};
  return contour_trace(grid, what->inverse ? 1 / level : level, draw_piece, &use);
}

static bool draw_levels(plot *p, const panel *what, const contour_grid *grid) {
  // lean zero is itself a contour zero of steer and offset, which would be drawn on the axis
  int first = !what->upright && grid->y[0] == 0;
  contour_grid off = {grid->nx,
                      grid->ny - first,
                      grid->x,
                      grid->y + first,
                      grid->value + first * grid->nx,
                      grid->torn + first * grid->nx};
  for (int labels = 0; labels < 2; labels++) {
    if (what->zero && !draw_level(p, what, &off, 0, labels)) return false;
    for (int k = 0; k < what->level_count; k++) {
      if (!draw_level(p, what, grid, what->levels[k], labels)) return false;
      if (what->both && !draw_level(p, what, grid, -what->levels[k], labels)) return false;
    }
  }
  return true;
}

static void put_number(FILE *csv, double value) {
  if (isnan(value))
    fputs(",nan", csv);
  else
    fprintf(csv, ",%.17g", value);
}

// There is no end to the time where the motion is stable.
static double reaction_time(double eps) {
  return isnan(eps) || eps > 0 ? 1 / eps : INFINITY;
}

static void write_table(FILE *csv, const turn_map *map, const panel *what, const double *values,
                        double left) {
  fprintf(csv, "speed,lean,%s\n", what->column);
  for (int i = 0; i < map->nx; i++) {
    for (int j = 0; j < map->ny; j++) {
      fprintf(csv, "%.17g", map->speed[i]);
      put_number(csv, map->lean[j]);
      double value = values[j * map->nx + i];
      put_number(csv, what->inverse ? reaction_time(value) : left * value);
      fputc('\n', csv);
    }
  }
}

// The values of a panel in the unit of its contours; the caller frees them.
static double *scaled(const turn_map *map, const double *values, double factor) {
  size_t count = (size_t)map->nx * (size_t)map->ny;
  double *out = calloc(count, sizeof *out);
  for (size_t i = 0; out && i < count; i++) out[i] = factor * values[i];
  return out;
}

static bool open_plot(plot *p, const turn_map *map) {
  plot_axis x = {map->speed[0], map->speed[map->nx - 1], {"speed", "v", "", "m/s"}};
  plot_axis y = {map->lean[0] * DEGREES,
                 map->lean[map->ny - 1] * DEGREES,
                 {"lean angle", "\u03ba", "", "deg"}};
  return plot_open(p, &x, &y);
}

static bool add_panel(figure_set *set, const turn_map *map, const panel *what, const double *values,
                      double left) {
  plot p;
  bool drawn = open_plot(&p, map);
  double *leans = calloc((size_t)map->ny, sizeof *leans);
  double *shown = scaled(map, values, left * what->factor);
  if (drawn && leans && shown) {
    for (int j = 0; j < map->ny; j++) leans[j] = map->lean[j] * DEGREES;
    contour_grid stable = {map->nx, map->ny, map->speed, leans, map->eps, map->torn};
    if (what->stable) contour_below(&stable, 0, fill_piece, &p);
    contour_grid grid = {map->nx, map->ny, map->speed, leans, shown, map->torn};
    drawn = draw_levels(&p, what, &grid);
    FILE *csv = drawn ? figure_add(set, what->name, what->title, &p, what->caption) : NULL;
    if (csv) write_table(csv, map, what, values, left);
    drawn = csv && fclose(csv) == 0;
  } else {
    drawn = false;
  }
  plot_close(&p);
  free(leans);
  free(shown);
  return drawn;
}

bool figure_add_maps(figure_set *set, const turn_map *map, double left) {
  static const panel panels[] = {
      {"fig2a", "steering angle of stationary motion",
       "Figure 2(a). Steering angle \u03c6 (deg) of stationary circular motion, hands off, as a "
       "function of speed and lean; dashed: negative. Shaded: self-stable.",
       "steer", steers, COUNT(steers), true, false, true, false, false, 57.29577951308232},
      {"fig2b", "rider's lateral displacement of stationary motion",
       "Figure 2(b). Lateral displacement w (cm) of the rider, positive to the side of the lean, "
       "that stationary motion needs, hands off; dashed: negative. Shaded: self-stable.",
       "rider_offset", offsets, COUNT(offsets), true, true, true, false, false, 100},
      {"fig2c", "largest eigenvalue of stationary motion",
       "Figure 2(c). Largest real part of the eigenvalues \u03b5\u2098\u2090\u2093 (1/s) of "
       "stationary motion at "
       "constant energy; heavy: zero, dashed: negative. Shaded: self-stable. "
       "1/\u03b5\u2098\u2090\u2093 is the "
       "rider's reaction time, figure 2(d).",
       "eps_max", growths, COUNT(growths), true, true, true, true, false, 1},
      {"fig2d", "reaction time of the rider",
       "Figure 2(d). Time 1/\u03b5\u2098\u2090\u2093 (s) within which the rider has to react to a "
       "disturbance of "
       "stationary motion. Shaded: self-stable, no reaction needed.",
       "reaction_time", times, COUNT(times), false, false, true, true, true, 1},
  };
  return add_panel(set, map, &panels[0], map->steer, left) &&
         add_panel(set, map, &panels[1], map->rider_offset, 1) &&
         add_panel(set, map, &panels[2], map->eps, 1) &&
         add_panel(set, map, &panels[3], map->eps, 1);
}
