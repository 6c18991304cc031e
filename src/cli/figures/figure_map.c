// SPDX-License-Identifier: Apache-2.0
#include "figure_map.h"

#include "level_lines.h"

#include <bicycle/table.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEGREES = 180 / 3.14159265358979323846;

// One panel: a quantity over speed and lean, in the unit of its contours.
typedef struct panel {
  figure_words words;
  const char *column; // of the table
  level_set contours;
  bool stable;   // the region eps_max < 0 is shaded
  double factor; // from SI to the unit of the contours
} panel;

static const double steers[] = {1, 2, 5, 10, 15, 20, 30, 40, 60, 80};
static const double offsets[] = {0.2, 0.5, 1, 2, 5, 10, 20, 50};
static const double growths[] = {0.2, 0.5, 1, 1.5, 2, 3, 4, 5, 7, 10};
static const double times[] = {0.1, 0.2, 0.3, 0.5, 1, 2, 5, 10};
#define COUNT(levels) ((int)(sizeof(levels) / sizeof(levels)[0]))

static void fill_piece(const plot_point *points, int count, void *user) {
  plot_area(user, PLOT_LIGHT, points, count);
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
  for (int i = 0; i < map->nx; i += map->stride) {
    for (int j = 0; j < map->ny; j += map->stride) {
      fprintf(csv, "%.17g", map->speed[i]);
      put_number(csv, map->lean[j]);
      double value = values[j * map->nx + i];
      put_number(csv, what->contours.inverse ? reaction_time(value) : left * value);
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

// Shading and contours; *left_out: whether contours were thinned out.
static bool draw_panel(plot *p, const turn_map *map, const panel *what, const double *leans,
                       const double *shown, bool *left_out) {
  contour_grid stable = {map->nx, map->ny, map->speed, leans, map->eps, map->torn};
  contour_grid grid = {map->nx, map->ny, map->speed, leans, shown, map->torn};
  if (what->stable) contour_below(&stable, 0, fill_piece, p);
  return level_lines_draw(p, &what->contours, &grid, left_out);
}

static bool add_panel(figure_set *set, const turn_map *map, const panel *what, const double *values,
                      double left) {
  plot p;
  bool left_out = false, drawn = open_plot(&p, map);
  double *leans = calloc((size_t)map->ny, sizeof *leans);
  double *shown = scaled(map, values, left * what->factor);
  if (drawn && leans && shown) {
    for (int j = 0; j < map->ny; j++) leans[j] = map->lean[j] * DEGREES;
    drawn = draw_panel(&p, map, what, leans, shown, &left_out);
    char caption[512];
    figure_words words = what->words;
    snprintf(caption, sizeof caption, "%s%s", words.caption,
             left_out ? " Where contours would run into each other, only some are drawn." : "");
    words.caption = caption;
    FILE *csv = drawn ? figure_add(set, &words, &p) : NULL;
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

static const char held[] = "every parameter of the bicycle; the steer torque is zero and the "
                           "rider sits where the stationary motion needs him";

bool figure_add_maps(figure_set *set, const turn_map *map, double left) {
  static const panel panels[] = {
      {{"fig2a", "steering angle of stationary motion",
        "Figure 2(a). Steering angle {\u03c6} (deg) of stationary circular motion, hands off, as a "
        "function of speed and lean; dashed: negative. Shaded: self-stable.",
        held},
       "steer",
       {steers, COUNT(steers), true, false, false, false},
       true,
       57.29577951308232},
      {{"fig2b", "rider\u2019s lateral displacement of stationary motion",
        "Figure 2(b). Lateral displacement {w} (cm) of the rider, positive to the side of the "
        "lean, that stationary motion needs, hands off; heavy: zero, dashed: negative. Shaded: "
        "self-stable.",
        held},
       "rider_offset",
       {offsets, COUNT(offsets), true, true, false, false},
       true,
       100},
      {{"fig2c", "largest eigenvalue of stationary motion",
        "Figure 2(c). Largest real part of the eigenvalues {\u03b5}\u2098\u2090\u2093 (1/s) of "
        "stationary motion at constant energy; heavy: zero, dashed: negative. Shaded: self-stable. "
        "1/{\u03b5}\u2098\u2090\u2093 is the rider\u2019s reaction time, figure 2(d).",
        held},
       "eps_max",
       {growths, COUNT(growths), true, true, true, false},
       true,
       1},
      {{"fig2d", "reaction time of the rider",
        "Figure 2(d). Time 1/{\u03b5}\u2098\u2090\u2093 (s) within which the rider has to react "
        "to a disturbance of stationary motion. Shaded: self-stable, no reaction needed.",
        held},
       "reaction_time",
       {times, COUNT(times), false, false, true, true},
       true,
       1},
  };
  const double *const values[] = {map->steer, map->rider_offset, map->eps, map->eps};
  for (int i = 0; i < COUNT(panels); i++)
    if (!add_panel(set, map, &panels[i], values[i], i == 0 ? left : 1)) return false;
  return true;
}
