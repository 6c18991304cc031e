// SPDX-License-Identifier: Apache-2.0
#include "basin_picture.h"

#include "plot_file.h"
#include "terminal/data.h"

#include <bicycle/error.h>
#include <math.h>

static const double DEGREES = 180 / M_PI;

static const plot_fill fills[BIKE_FATES] = {
    [BIKE_FATE_STRAIGHT] = PLOT_MIDDLE, [BIKE_FATE_LIFTED] = PLOT_LIGHT,
    [BIKE_FATE_RIDING] = PLOT_HATCHED,  [BIKE_FATE_FALLEN] = PLOT_WHITE,
    [BIKE_FATE_NO_START] = PLOT_DARK,
};

static const char *const words[BIKE_FATES] = {
    [BIKE_FATE_STRAIGHT] = "comes back",           [BIKE_FATE_LIFTED] = "comes back, a wheel lifts",
    [BIKE_FATE_RIDING] = "rides on, not straight", [BIKE_FATE_FALLEN] = "falls",
    [BIKE_FATE_NO_START] = "no such start",
};

// Values stand in the middle of their cells.
static double edge(const double *values, int count, int k) {
  double step = (values[count - 1] - values[0]) / (count - 1);
  return values[0] + (k - 0.5) * step;
}

// One rectangle for a run of equal fates in a row.
static void fill_run(plot *p, const basin_map *map, int j, int from, int to, double left) {
  double y0 = left * DEGREES * edge(map->steers, map->ny, j);
  double y1 = left * DEGREES * edge(map->steers, map->ny, j + 1);
  double x0 = DEGREES * edge(map->leans, map->nx, from);
  double x1 = DEGREES * edge(map->leans, map->nx, to);
  const plot_point corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  plot_area(p, fills[map->fates[j * map->nx + from]], corners, 4);
}

static void fill_cells(plot *p, const basin_map *map, double left) {
  for (int j = 0; j < map->ny; j++) {
    const bike_fate *row = &map->fates[j * map->nx];
    for (int from = 0, i = 1; i <= map->nx; i++) {
      if (i < map->nx && row[i] == row[from]) continue;
      fill_run(p, map, j, from, i, left);
      from = i;
    }
  }
}

// The key names the fates that occur.
static void add_key(plot *p, const basin_map *map) {
  bool occurs[BIKE_FATES] = {false};
  plot_entry entries[BIKE_FATES];
  int count = 0;
  for (int k = 0; k < map->nx * map->ny; k++) occurs[map->fates[k]] = true;
  for (int f = 0; f < BIKE_FATES; f++)
    if (occurs[f]) entries[count++] = (plot_entry){true, PLOT_THIN, fills[f], words[f]};
  plot_key_below(p, entries, count); // no corner is free
}

static bool draw(plot *p, const basin_map *map, double left) {
  double low = left * DEGREES * edge(map->steers, map->ny, 0);
  double high = left * DEGREES * edge(map->steers, map->ny, map->ny);
  plot_axis x = {DEGREES * edge(map->leans, map->nx, 0),
                 DEGREES * edge(map->leans, map->nx, map->nx),
                 {"lean", "\u03ba", "", "deg"}};
  plot_axis y = {fmin(low, high), fmax(low, high), {"steer", "\u03c6", "", "deg"}};
  if (!plot_open(p, &x, &y)) return false;
  fill_cells(p, map, left);
  const plot_point level[] = {{x.low, 0}, {x.high, 0}}, upright[] = {{0, y.low}, {0, y.high}};
  plot_line(p, PLOT_DOTTED, level, 2);
  plot_line(p, PLOT_DOTTED, upright, 2);
  add_key(p, map);
  return true;
}

// What the table shows.
typedef struct basin_table {
  const basin_map *map;
  double left;
} basin_table;

static void write_table(FILE *csv, const void *user) {
  const basin_table *t = user;
  const basin_map *map = t->map;
  fputs("lean,steer,fate\n", csv);
  for (int k = 0; k < map->nx * map->ny; k++)
    fprintf(csv, "%.17g,%.17g,%s\n", map->leans[k % map->nx], t->left * map->steers[k / map->nx],
            bike_fate_string(map->fates[k]));
}

term_exit basin_write(const basin_map *map, const bike_bicycle *bicycle, double speed, double time,
                      bike_convention convention, const char *svg) {
  plot p;
  char title[160], caption[512];
  const basin_table table = {map, term_left_sign(convention)};
  snprintf(title, sizeof title, "%s: basin of attraction of riding straight at %g m/s",
           bicycle->name, speed);
  snprintf(caption, sizeof caption,
           "%s: basin of attraction of riding straight at %g m/s, hands off. Starts with zero "
           "rates and the energy of riding straight at that speed, followed for %g s; lean right, "
           "steer %s positive.",
           bicycle->name, speed, time, table.left > 0 ? "left" : "right");
  term_exit code = draw(&p, map, table.left)
                       ? plot_save(&p, "basin", title, caption, svg, write_table, &table)
                       : term_fail_bike(BIKE_ERROR_MEMORY, svg);
  plot_close(&p);
  return code;
}
