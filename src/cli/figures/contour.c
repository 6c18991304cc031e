// SPDX-License-Identifier: Apache-2.0
#include "contour.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The contour crosses edges of the grid, each at most once. Edge number: 2 * node for the edge to
// the right of a node, 2 * node + 1 for the edge above it. Within a cell two crossed edges are
// linked; every edge has at most two links, and the pieces are the chains of links.
typedef struct crossings {
  int (*link)[2]; // of every edge; -1: none
  const contour_grid *grid;
  double level;
} crossings;

static double value_at(const contour_grid *g, int i, int j) {
  return g->value[j * g->nx + i];
}

// The values at the corners of a cell, anticlockwise from the lower left; false for a hole.
static bool cell_values(double v[4], const contour_grid *g, int i, int j) {
  v[0] = value_at(g, i, j);
  v[1] = value_at(g, i + 1, j);
  v[2] = value_at(g, i + 1, j + 1);
  v[3] = value_at(g, i, j + 1);
  bool torn = g->torn && g->torn[j * g->nx + i];
  return !torn && !isnan(v[0] + v[1] + v[2] + v[3]);
}

static plot_point node(const contour_grid *g, int i, int j) {
  return (plot_point){g->x[i], g->y[j]};
}

static plot_point between(plot_point a, plot_point b, double value_a, double value_b,
                          double level) {
  double t = (level - value_a) / (value_b - value_a);
  return (plot_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

static plot_point crossing_point(const crossings *c, int edge) {
  const contour_grid *g = c->grid;
  int i = edge / 2 % g->nx, j = edge / 2 / g->nx;
  int k = i + (edge % 2 == 0), l = j + (edge % 2 == 1);
  return between(node(g, i, j), node(g, k, l), value_at(g, i, j), value_at(g, k, l), c->level);
}

static void join(crossings *c, int a, int b) {
  c->link[a][c->link[a][0] >= 0] = b;
  c->link[b][c->link[b][0] >= 0] = a;
}

// Links the crossed edges of the cell whose lower left node is (i, j).
static void link_cell(crossings *c, int i, int j) {
  const contour_grid *g = c->grid;
  double v[4];
  if (!cell_values(v, g, i, j)) return;
  const int at = j * g->nx + i;
  // bottom, right, top, left
  const int edges[4] = {2 * at, 2 * (at + 1) + 1, 2 * (at + g->nx), 2 * at + 1};
  int crossed[4], count = 0;
  for (int k = 0; k < 4; k++)
    if ((v[k] < c->level) != (v[(k + 1) % 4] < c->level)) crossed[count++] = edges[k];
  if (count == 2) join(c, crossed[0], crossed[1]);
  if (count < 4) return;
  // a saddle: the middle tells which corners belong together
  bool middle_below = 0.25 * (v[0] + v[1] + v[2] + v[3]) < c->level;
  int turn = middle_below == (v[0] < c->level) ? 0 : 3;
  join(c, crossed[turn], crossed[(turn + 1) % 4]);
  join(c, crossed[(turn + 2) % 4], crossed[(turn + 3) % 4]);
}

// Follows a chain from an edge and takes it apart; returns the number of points.
static int follow(crossings *c, int edge, plot_point *points) {
  int count = 0;
  while (edge >= 0) {
    points[count++] = crossing_point(c, edge);
    int next = c->link[edge][0] >= 0 ? c->link[edge][0] : c->link[edge][1];
    c->link[edge][0] = c->link[edge][1] = -1;
    if (next >= 0)
      for (int k = 0; k < 2; k++)
        if (c->link[next][k] == edge) c->link[next][k] = -1;
    edge = next;
  }
  return count;
}

bool contour_trace(const contour_grid *grid, double level, contour_piece *piece, void *user) {
  const int edges = 2 * grid->nx * grid->ny;
  crossings c = {calloc((size_t)edges, sizeof *c.link), grid, level};
  plot_point *points = calloc((size_t)edges + 1, sizeof *points);
  bool room = c.link && points;
  if (room) {
    memset(c.link, -1, (size_t)edges * sizeof *c.link);
    for (int j = 0; j + 1 < grid->ny; j++)
      for (int i = 0; i + 1 < grid->nx; i++) link_cell(&c, i, j);
    // open pieces first, from their ends; what is left are closed ones
    for (int pass = 0; pass < 2; pass++) {
      for (int e = 0; e < edges; e++) {
        int links = (c.link[e][0] >= 0) + (c.link[e][1] >= 0);
        if (links == 0 || (pass == 0 && links == 2)) continue;
        int count = follow(&c, e, points);
        if (pass == 1) points[count++] = points[0];
        piece(points, count, user);
      }
    }
  }
  free(c.link);
  free(points);
  return room;
}

// The part of a cell below the level; returns the number of corners, which may be none.
static int clip_cell(plot_point polygon[8], const contour_grid *g, int i, int j, double level) {
  double v[4];
  if (!cell_values(v, g, i, j)) return 0;
  const plot_point corner[4] = {node(g, i, j), node(g, i + 1, j), node(g, i + 1, j + 1),
                                node(g, i, j + 1)};
  int count = 0;
  for (int k = 0; k < 4; k++) {
    int next = (k + 1) % 4;
    if (v[k] < level) polygon[count++] = corner[k];
    if ((v[k] < level) != (v[next] < level))
      polygon[count++] = between(corner[k], corner[next], v[k], v[next], level);
  }
  return count;
}

static bool is_full(const contour_grid *g, int i, int j, double level) {
  double v[4];
  return cell_values(v, g, i, j) && v[0] < level && v[1] < level && v[2] < level && v[3] < level;
}

// Cells that lie wholly below are joined along their row: most of the region is such cells.
void contour_below(const contour_grid *g, double level, contour_piece *piece, void *user) {
  for (int j = 0; j + 1 < g->ny; j++) {
    for (int i = 0, next; i + 1 < g->nx; i = next) {
      next = i;
      while (next + 1 < g->nx && is_full(g, next, j, level)) next++;
      plot_point polygon[8] = {node(g, i, j), node(g, next, j), node(g, next, j + 1),
                               node(g, i, j + 1)};
      int count = next > i ? 4 : clip_cell(polygon, g, i, j, level);
      if (count >= 3) piece(polygon, count, user);
      if (next == i) next++;
    }
  }
}
