// SPDX-License-Identifier: Apache-2.0
#include "map.h"

#include <bicycle/error.h>
#include <bicycle/map.h>
#include <math.h>
#include <stdlib.h>

static double *room_for(size_t count) {
  double *values = calloc(count, sizeof *values);
  for (size_t i = 0; values && i < count; i++) values[i] = NAN;
  return values;
}

static long finer(long count, int stride) {
  return (count - 1) * stride + 1;
}

// A point of the finer grid; those asked for come out to the last digit.
static double point_of(const term_range *range, long i, int stride) {
  double at = term_range_point(range, i / stride);
  if (i % stride == 0) return at;
  return at + (double)(i % stride) / stride * (term_range_point(range, i / stride + 1) - at);
}

static bool allocate(turn_map *map, const term_range *speeds, const term_range *leans) {
  const int enough = 400; // nodes along an axis: more than a node for two pixels
  int stride = speeds->count > enough || leans->count > enough ? 1 : 2;
  size_t nx = (size_t)finer(speeds->count, stride), ny = (size_t)finer(leans->count, stride);
  *map = (turn_map){.nx = (int)nx,
                    .ny = (int)ny,
                    .stride = stride,
                    .speed = room_for(nx),
                    .lean = room_for(ny),
                    .steer = room_for(nx * ny),
                    .rider_offset = room_for(nx * ny),
                    .eps = room_for(nx * ny),
                    .torn = calloc(nx * ny, sizeof *map->torn)};
  if (!map->speed || !map->lean || !map->steer || !map->rider_offset || !map->eps || !map->torn)
    return false;
  for (size_t i = 0; i < nx; i++) map->speed[i] = point_of(speeds, (long)i, stride);
  for (size_t j = 0; j < ny; j++) map->lean[j] = point_of(leans, (long)j, stride);
  return true;
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

static void show(double done, void *user) {
  term_progress_show(user, "figure 2", done);
}

int turn_map_make(turn_map *out, const bike_model *model, const term_range *speeds,
                  const term_range *leans, int threads, term_progress *progress) {
  bool room = allocate(out, speeds, leans);
  size_t count = (size_t)out->nx * (size_t)out->ny;
  bike_map_node *nodes = calloc(count, sizeof *nodes);
  int code = room && nodes ? BIKE_OK : BIKE_ERROR_MEMORY;
  bike_map_def def = {.speeds = out->speed,
                      .leans = out->lean,
                      .speed_count = (size_t)out->nx,
                      .lean_count = (size_t)out->ny,
                      .threads = threads,
                      .progress = show,
                      .user = progress};
  if (!code) code = bike_map_turns(nodes, model, &def);
  for (size_t k = 0; k < count && !code; k++) {
    out->steer[k] = nodes[k].steer;
    out->rider_offset[k] = nodes[k].rider_offset;
    out->eps[k] = nodes[k].eps_max;
  }
  if (!code) find_tears(out);
  free(nodes);
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
