// SPDX-License-Identifier: Apache-2.0
#include "map.h"

#include <bicycle/error.h>
#include <bicycle/turn.h>
#include <math.h>
#include <stdlib.h>

static double *room_for(size_t count) {
  double *values = calloc(count, sizeof *values);
  for (size_t i = 0; values && i < count; i++) values[i] = NAN;
  return values;
}

static bool allocate(turn_map *map, const term_range *speeds, const term_range *leans) {
  size_t nx = (size_t)speeds->count, ny = (size_t)leans->count;
  *map = (turn_map){.nx = (int)nx,
                    .ny = (int)ny,
                    .speed = room_for(nx),
                    .lean = room_for(ny),
                    .steer = room_for(nx * ny),
                    .rider_offset = room_for(nx * ny),
                    .eps = room_for(nx * ny),
                    .torn = calloc(nx * ny, sizeof *map->torn)};
  if (!map->speed || !map->lean || !map->steer || !map->rider_offset || !map->eps || !map->torn)
    return false;
  for (size_t i = 0; i < nx; i++) map->speed[i] = term_range_point(speeds, (long)i);
  for (size_t j = 0; j < ny; j++) map->lean[j] = term_range_point(leans, (long)j);
  return true;
}

// The motion at a node, started from a neighbour's if that is known.
static int solve(bike_turn *out, const bike_model *model, double speed, double lean,
                 const bike_turn *neighbour) {
  bike_turn_def def = bike_default_turn_def();
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_LEAN] = true;
  def.value[BIKE_TURN_SPEED] = speed;
  def.value[BIKE_TURN_LEAN] = lean;
  return bike_turn_near(out, model, &def, neighbour);
}

// A neighbour counts once it is solved: its speed is then not NaN.
static int solve_node(turn_map *map, bike_turn *row, const bike_model *model, int i, int j) {
  bike_turn found, upright = {0};
  const bike_turn *below = j > 0 ? &row[j - 1] : &upright, *beside = &row[j];
  int code = BIKE_ERROR_NO_CONVERGENCE;
  if (!isnan(below->speed)) code = solve(&found, model, map->speed[i], map->lean[j], below);
  if (code && code != BIKE_ERROR_NO_RIDER && !isnan(beside->speed))
    code = solve(&found, model, map->speed[i], map->lean[j], beside);
  if (code) {
    row[j].speed = NAN;
    return code == BIKE_ERROR_NO_RIDER || code == BIKE_ERROR_MEMORY ? code : BIKE_OK;
  }
  row[j] = found;
  map->steer[j * map->nx + i] = found.steer;
  map->rider_offset[j * map->nx + i] = found.rider_offset;
  map->eps[j * map->nx + i] = found.eps_max;
  return BIKE_OK;
}

// At low speed the steer passes through the end of the geometry and comes back with the other sign:
// between such motions nothing lies that a contour could show. Elsewhere the steer changes by a few
// degrees from node to node at most.
static void find_tears(turn_map *map) {
  const double jump = 0.3; // rad
  for (int j = 0; j + 1 < map->ny; j++) {
    for (int i = 0; i + 1 < map->nx; i++) {
      const double *a = &map->steer[j * map->nx + i], *b = a + map->nx;
      double low = fmin(fmin(a[0], a[1]), fmin(b[0], b[1]));
      double high = fmax(fmax(a[0], a[1]), fmax(b[0], b[1]));
      map->torn[j * map->nx + i] = high - low > jump;
    }
  }
}

int turn_map_make(turn_map *out, const bike_model *model, const term_range *speeds,
                  const term_range *leans, term_progress *progress) {
  bike_turn *row = calloc((size_t)leans->count, sizeof *row);
  int code = allocate(out, speeds, leans) && row ? BIKE_OK : BIKE_ERROR_MEMORY;
  for (long j = 0; row && j < leans->count; j++) row[j].speed = NAN;
  // from fast to slow: fast riding steers little and is solved from upright riding
  for (int i = out->nx - 1; i >= 0 && !code; i--) {
    for (int j = 0; j < out->ny && !code; j++) code = solve_node(out, row, model, i, j);
    term_progress_show(progress, "figure 2", 1 - (double)i / out->nx);
  }
  if (!code) find_tears(out);
  free(row);
  return code;
}

void turn_map_free(turn_map *map) {
  free(map->speed);
  free(map->lean);
  free(map->steer);
  free(map->rider_offset);
  free(map->eps);
  free(map->torn);
}
