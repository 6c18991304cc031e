// SPDX-License-Identifier: Apache-2.0
#include "figure_map.h"

#include "level_lines.h"

#include <bicycle/table.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DEGREES = 180 / M_PI;

// One panel: a quantity over speed and lean, in the unit of its contours.
typedef struct panel {
  figure_words words;
  const char *column; // of the table
  level_set contours;
  bool stable;   // the region eps_max < 0 is shaded
  double factor; // from SI to the unit of the contours
  bool turns_with_convention;
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

// Where the motion jumps to another one, at a speed: halfway between the nodes. NaN: nowhere.
static double tear_at(const turn_map *map, const double *leans, int i) {
  int first = -1, last = -1;
  for (int j = 0; j + 1 < map->ny; j++) {
    if (!map->torn[j * map->nx + i]) continue;
    if (first < 0) first = j;
    last = j;
  }
  return first < 0 ? NAN : 0.5 * (leans[first] + leans[last + 1]);
}

// Contours end there: a dotted line says that it is not by mistake. *torn: whether it is anywhere.
static bool draw_tear(plot *p, const turn_map *map, const double *leans, bool *torn) {
  plot_point *points = calloc((size_t)map->nx, sizeof *points);
  if (!points) return false;
  int count = 0;
  for (int i = 0; i < map->nx; i++) {
    double lean = i + 1 < map->nx ? tear_at(map, leans, i) : NAN;
    if (!isnan(lean)) {
      points[count++] = (plot_point){0.5 * (map->speed[i] + map->speed[i + 1]), lean};
      continue;
    }
    plot_line(p, PLOT_DOTTED, points, count);
    *torn |= count > 1;
    count = 0;
  }
  free(points);
  return true;
}

// What the captions of some panels add.
typedef struct remarks {
  bool torn, left_out;
} remarks;

// Shading and contours.
static bool draw_panel(plot *p, const turn_map *map, const panel *what, const double *leans,
                       const double *shown, remarks *found) {
  contour_grid stable = {map->nx, map->ny, map->speed, leans, map->eps, map->torn};
  contour_grid grid = {map->nx, map->ny, map->speed, leans, shown, map->torn};
  if (what->stable) contour_below(&stable, 0, fill_piece, p);
  return draw_tear(p, map, leans, &found->torn) &&
         level_lines_draw(p, &what->contours, &grid, &found->left_out);
}

static void make_caption(char out[FIGURE_CAPTION], const figure_set *set, const panel *what,
                         const remarks *found) {
  char signs[80] = "";
  if (what->turns_with_convention)
    snprintf(signs, sizeof signs, " Lean is positive to the right, steer to the %s.",
             figure_positive_steer(set));
  snprintf(out, FIGURE_CAPTION, "%s%s%s%s", what->words.caption, signs,
           found->torn ? " Dotted: across it the steering angle jumps." : "",
           found->left_out ? " Where contours would run into each other, only some are drawn."
                           : "");
}

static bool add_panel(figure_set *set, const turn_map *map, const panel *what,
                      const double *values) {
  plot p;
  remarks found = {false, false};
  const double left = what->turns_with_convention ? term_left_sign(set->convention) : 1;
  bool drawn = open_plot(&p, map);
  double *leans = calloc((size_t)map->ny, sizeof *leans);
  double *shown = scaled(map, values, left * what->factor);
  if (drawn && leans && shown) {
    for (int j = 0; j < map->ny; j++) leans[j] = map->lean[j] * DEGREES;
    drawn = draw_panel(&p, map, what, leans, shown, &found);
    char caption[FIGURE_CAPTION];
    figure_words words = what->words;
    make_caption(caption, set, what, &found);
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

bool figure_add_maps(figure_set *set, const turn_map *map) {
  static const panel panels[] = {
      {{"fig2a", "2(a)", "steering angle of stationary motion",
        "Steering angle {\u03c6} (deg) of stationary circular motion, hands off, as a "
        "function of speed and lean; dashed: negative. Shaded: self-stable.",
        held},
       "steer",
       {steers, COUNT(steers), true, false, false, false},
       true,
       57.29577951308232,
       true},
      {{"fig2b", "2(b)", "rider\u2019s lateral displacement of stationary motion",
        "Lateral displacement {w} (cm) of the rider, positive to the side of the "
        "lean, that stationary motion needs, hands off; heavy: zero, dashed: negative. Shaded: "
        "self-stable.",
        held},
       "rider_offset",
       {offsets, COUNT(offsets), true, true, false, false},
       true,
       100,
       false},
      {{"fig2c", "2(c)", "largest eigenvalue of stationary motion",
        "Largest real part of the eigenvalues {\u03b5}\u2098\u2090\u2093 (1/s) of "
        "stationary motion at constant energy; heavy: zero, dashed: negative. Shaded: self-stable. "
        "1/{\u03b5}\u2098\u2090\u2093 is the rider\u2019s reaction time, figure 2(d).",
        held},
       "eps_max",
       {growths, COUNT(growths), true, true, true, false},
       true,
       1,
       false},
      {{"fig2d", "2(d)", "reaction time of the rider",
        "Time 1/{\u03b5}\u2098\u2090\u2093 (s) within which the rider has to react "
        "to a disturbance of stationary motion. Shaded: self-stable, no reaction needed.",
        held},
       "reaction_time",
       {times, COUNT(times), false, false, true, true},
       true,
       1,
       false},
  };
  const double *const values[] = {map->steer, map->rider_offset, map->eps, map->eps};
  for (int i = 0; i < COUNT(panels); i++)
    if (!add_panel(set, map, &panels[i], values[i])) return false;
  return true;
}
