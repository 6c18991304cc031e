// SPDX-License-Identifier: Apache-2.0
// A map is made in three passes: the lanes march from upright riding over the leans, several speeds
// side by side; what they could not reach is tried node by node from its neighbours; and stability
// is found for all, in lanes again.
#include <bicycle/map.h>

#include <bicycle/batch.h>
#include <bicycle/error.h>
#include <bicycle/turn.h>
#include <math.h>
#include <stdlib.h>

#include "batch/lanes.h"
#include "batch/parallel.h"

typedef struct map {
  bike_map_node *nodes;
  const bike_model *model;
  const bike_map_def *def;
  const lanes_functions *lanes;
  lanes_models *block; // the bicycle in every lane
} map;

// A motion farther than this from where its neighbours point, rad and m, is another one.
static const double NEAR_STEER = 0.1, NEAR_OFFSET = 0.05;
// Share of the work that the first pass is.
static const double MARCH_SHARE = 0.5;

static bike_map_node *node_at(const map *m, size_t i, size_t j) {
  return &m->nodes[j * m->def->speed_count + i];
}

static void no_motion(bike_map_node *n, int error) {
  *n = (bike_map_node){.steer = NAN, .rider_offset = NAN, .eps_max = NAN, .error = error};
  for (int k = 0; k < 4; k++) n->eigenvalues.re[k] = n->eigenvalues.im[k] = NAN;
}

// The column's solutions continued as a parabola in the lean, as far as there are three.
static void predict(double *steer, double *offset, const map *m, size_t i, size_t j) {
  const double *x = m->def->leans;
  *steer = *offset = 0;
  for (size_t a = 1; a <= 3 && a <= j; a++) {
    double weight = 1; // Lagrange's
    for (size_t b = 1; b <= 3 && b <= j; b++)
      if (b != a) weight *= (x[j] - x[j - b]) / (x[j - a] - x[j - b]);
    *steer += weight * node_at(m, i, j - a)->steer;
    *offset += weight * node_at(m, i, j - a)->rider_offset;
  }
}

// One row of a group of columns; spare lanes repeat the last column. `lost`: columns given up.
static void march_row(map *m, size_t first, size_t used, size_t j, bool lost[LANES_MOST]) {
  size_t width = (size_t)m->lanes->width;
  double speed[LANES_MOST], lean[LANES_MOST], steer[LANES_MOST], offset[LANES_MOST];
  double near_steer[LANES_MOST], near_offset[LANES_MOST];
  for (size_t i = 0; i < width; i++) {
    size_t column = first + (i < used ? i : used - 1);
    speed[i] = m->def->speeds[column];
    lean[i] = m->def->leans[j];
    predict(&near_steer[i], &near_offset[i], m, column, j);
    steer[i] = near_steer[i];
    offset[i] = near_offset[i];
  }
  unsigned solved = m->lanes->turn(steer, offset, m->block, speed, lean);
  for (size_t i = 0; i < used; i++) {
    bike_map_node *n = node_at(m, first + i, j);
    bool near = fabs(steer[i] - near_steer[i]) <= NEAR_STEER &&
                fabs(offset[i] - near_offset[i]) <= NEAR_OFFSET;
    lost[i] |= !(solved >> i & 1) || !near;
    no_motion(n, BIKE_ERROR_NO_CONVERGENCE);
    if (lost[i]) continue;
    n->steer = steer[i];
    n->rider_offset = offset[i];
    n->error = BIKE_OK;
  }
}

static void march_group(size_t group, void *user) {
  map *m = user;
  size_t width = (size_t)m->lanes->width, first = group * width;
  size_t left = m->def->speed_count - first, used = left < width ? left : width;
  bool lost[LANES_MOST] = {false};
  for (size_t j = 0; j < m->def->lean_count; j++) march_row(m, first, used, j, lost);
}

static bike_turn turn_of(const map *m, size_t i, size_t j) {
  const bike_map_node *n = node_at(m, i, j);
  return (bike_turn){.lean = m->def->leans[j],
                     .steer = n->steer,
                     .speed = m->def->speeds[i],
                     .rider_offset = n->rider_offset};
}

static int solve_near(bike_map_node *n, const map *m, size_t i, size_t j, const bike_turn *from) {
  bike_turn_def def = bike_default_turn_def();
  def.given[BIKE_TURN_SPEED] = def.given[BIKE_TURN_LEAN] = true;
  def.value[BIKE_TURN_SPEED] = m->def->speeds[i];
  def.value[BIKE_TURN_LEAN] = m->def->leans[j];
  bike_turn found;
  int code = bike_turn_near(&found, m->model, &def, from);
  if (code) return code;
  n->steer = found.steer;
  n->rider_offset = found.rider_offset;
  n->error = BIKE_OK;
  return BIKE_OK;
}

// From the neighbour below, of less lean, or else from that beside, of more speed.
static int solve_node(map *m, size_t i, size_t j) {
  bike_map_node *n = node_at(m, i, j);
  bike_turn from = {.speed = m->def->speeds[i]};
  bool below = j == 0 || !node_at(m, i, j - 1)->error;
  bool beside = i + 1 < m->def->speed_count && !node_at(m, i + 1, j)->error;
  int code = BIKE_ERROR_NO_CONVERGENCE;
  if (below) {
    if (j > 0) from = turn_of(m, i, j - 1);
    code = solve_near(n, m, i, j, &from);
  }
  if (code && beside) {
    from = turn_of(m, i + 1, j);
    code = solve_near(n, m, i, j, &from);
  }
  if (!code) return BIKE_OK;
  no_motion(n, code);
  return code == BIKE_ERROR_NO_RIDER || code == BIKE_ERROR_MEMORY ? code : BIKE_OK;
}

// From fast to slow: fast riding steers little.
static int solve_rest(map *m) {
  for (size_t i = m->def->speed_count; i-- > 0;)
    for (size_t j = 0; j < m->def->lean_count; j++) {
      int code = node_at(m, i, j)->error ? solve_node(m, i, j) : BIKE_OK;
      if (code) return code;
    }
  return BIKE_OK;
}

enum { CHUNK = 8 };

// Neighbouring nodes, those without a motion standing upright meanwhile.
static void judge_chunk(size_t chunk, void *user) {
  map *m = user;
  size_t nx = m->def->speed_count, all = nx * m->def->lean_count, first = chunk * CHUNK;
  size_t used = all - first < CHUNK ? all - first : CHUNK;
  bike_state states[CHUNK] = {0};
  bike_input inputs[CHUNK] = {0};
  for (size_t k = 0; k < used; k++) {
    const bike_map_node *n = &m->nodes[first + k];
    states[k] = (bike_state){.speed = m->def->speeds[(first + k) % nx]};
    if (n->error) continue;
    states[k].lean = m->def->leans[(first + k) / nx];
    states[k].steer = n->steer;
    inputs[k].rider_offset = n->rider_offset;
  }
  bike_linear linears[CHUNK] = {0};
  int linear_codes[CHUNK], codes[CHUNK];
  bike_eigenvalues e[CHUNK];
  bike_batch_linearize(linears, linear_codes, m->model, states, inputs, used);
  bike_batch_eigenvalues(e, codes, linears, used);
  for (size_t k = 0; k < used; k++) {
    bike_map_node *n = &m->nodes[first + k];
    if (n->error) continue;
    int code = linear_codes[k] ? linear_codes[k] : codes[k];
    if (code) {
      no_motion(n, code);
      continue;
    }
    n->eigenvalues = e[k];
    n->eps_max = e[k].re[0];
  }
}

typedef struct share {
  const bike_map_def *def;
  double from, width;
} share;

static void tell(double done, void *user) {
  const share *s = user;
  s->def->progress(s->from + s->width * done, s->def->user);
}

static void run(map *m, size_t count, void (*body)(size_t i, void *user), double from,
                double width) {
  share s = {m->def, from, width};
  parallel_run(count, m->def->threads, body, m, m->def->progress ? tell : NULL, &s);
}

static void mark_unsolved(map *m) {
  size_t all = m->def->speed_count * m->def->lean_count;
  for (size_t k = 0; k < all; k++) no_motion(&m->nodes[k], BIKE_ERROR_NO_CONVERGENCE);
}

static int make(map *m) {
  size_t width = (size_t)m->lanes->width, columns = m->def->speed_count;
  size_t all = columns * m->def->lean_count;
  if (m->def->plain)
    mark_unsolved(m);
  else
    run(m, (columns - 1) / width + 1, march_group, 0, MARCH_SHARE);
  int code = solve_rest(m);
  if (!code) run(m, (all - 1) / CHUNK + 1, judge_chunk, MARCH_SHARE, 1 - MARCH_SHARE);
  return code;
}

static bool rising(const double *x, size_t count) {
  bool right = count > 0 && isfinite(x[0]);
  for (size_t i = 1; i < count && right; i++) right = isfinite(x[i]) && x[i] > x[i - 1];
  return right;
}

static int check(const bike_map_def *def) {
  bool right = def->speeds && def->leans && rising(def->speeds, def->speed_count) &&
               rising(def->leans, def->lean_count) && def->speeds[0] >= 0 && def->threads >= 1 &&
               def->threads <= PARALLEL_MOST_THREADS &&
               def->speed_count <= (size_t)-1 / sizeof(bike_map_node) / def->lean_count;
  return right ? BIKE_OK : BIKE_ERROR_ARGUMENT;
}

int bike_map_turns(bike_map_node *out, const bike_model *model, const bike_map_def *def) {
  if (!out || !model || !def) return BIKE_ERROR_ARGUMENT;
  int code = check(def);
  if (code) return code;
  if (model->rider_mass == 0) return BIKE_ERROR_NO_RIDER;
  map m = {.nodes = out, .model = model, .def = def, .lanes = lanes_in_use()};
  m.block = aligned_alloc(64, m.lanes->block_size);
  if (!m.block) return BIKE_ERROR_MEMORY;
  for (int i = 0; i < m.lanes->width; i++) m.lanes->pack(m.block, model, i);
  code = make(&m);
  free(m.block);
  return code;
}
