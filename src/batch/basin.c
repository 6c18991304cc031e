// SPDX-License-Identifier: Apache-2.0
#include <bicycle/basin.h>

#include <bicycle/cycle.h>
#include <bicycle/ensemble.h>
#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "batch/fate.h"
#include "batch/parallel.h"

const char *bike_fate_string(bike_fate fate) {
  static const char *const names[BIKE_FATES] = {"straight", "lifted", "riding", "fallen",
                                                "no start"};
  return fate < BIKE_FATES ? names[fate] : "unknown";
}

bike_basin_def bike_default_basin_def(void) {
  return (bike_basin_def){.duration = 60, .settled = 0.005, .threads = 1};
}

// Whether anything can be attracted: a slow fall looks like riding straight for a long time.
static int find_stable(bool *out, const bike_model *model, double speed) {
  bike_eigenvalues e;
  bike_upright_matrices m;
  int code = bike_linearize_upright(&m, model); // refuses what cannot ride straight
  if (!code) code = bike_upright_eigenvalues(&e, model, speed);
  if (!code) *out = bike_all_decay(&e);
  return code;
}

// A start of the energy of riding straight; false: there is none.
static int start_of(bike_state *out, bool *exists, const bike_model *model, double speed,
                    double lean, double steer) {
  *out = (bike_state){.lean = lean, .steer = steer};
  int code = bike_speed_of_equal_energy(&out->speed, model, out, speed);
  *exists = !code;
  return fate_is_no_start(code) ? BIKE_OK : code;
}

// Room for the members of a grid, and where in it each stands.
typedef struct grid {
  size_t count; // of members
  bike_member *members;
  bike_member_result *results;
  size_t *places;
} grid;

static int allocate(grid *g, size_t size) {
  g->members = calloc(size, sizeof *g->members);
  g->results = calloc(size, sizeof *g->results);
  g->places = calloc(size, sizeof *g->places);
  return g->members && g->results && g->places ? BIKE_OK : BIKE_ERROR_MEMORY;
}

static void release(grid *g) {
  free(g->members);
  free(g->results);
  free(g->places);
}

static int gather(grid *g, bike_fate *out, const bike_model *model, const bike_basin_def *def) {
  size_t size = def->lean_count * def->steer_count;
  for (size_t k = 0; k < size; k++) {
    bike_state start;
    bool exists;
    int code = start_of(&start, &exists, model, def->speed, def->leans[k % def->lean_count],
                        def->steers[k / def->lean_count]);
    if (code) return code;
    out[k] = BIKE_FATE_NO_START;
    if (!exists) continue;
    g->members[g->count] = (bike_member){.model = model, .start = start};
    g->places[g->count++] = k;
  }
  return BIKE_OK;
}

static int ride_all(grid *g, bike_fate *out, double *times, const bike_model *model,
                    const bike_basin_def *def) {
  bool stable = false;
  int code = find_stable(&stable, model, def->speed);
  if (!code) code = allocate(g, def->lean_count * def->steer_count);
  if (!code) code = gather(g, out, model, def);
  bike_ensemble_def ensemble = fate_ensemble(def);
  if (!stable) ensemble.settled = 0;
  if (!code) code = bike_ensemble_ride(g->results, g->members, g->count, &ensemble);
  for (size_t i = 0; i < g->count && !code; i++) {
    const bike_member_result *r = &g->results[i];
    code = r->error;
    out[g->places[i]] = fate_of_result(r);
    if (times) times[g->places[i]] = r->time;
  }
  return code;
}

static int check(const bike_basin_def *def) {
  bool right = def->speed > 0 && isfinite(def->speed) && def->leans && def->steers &&
               def->lean_count > 0 && def->steer_count > 0 &&
               def->lean_count <= SIZE_MAX / sizeof(bike_member_result) / def->steer_count &&
               def->duration > 0 && isfinite(def->duration) && def->settled > 0 &&
               def->threads >= 1 && def->threads <= PARALLEL_MOST_THREADS;
  return right ? BIKE_OK : BIKE_ERROR_ARGUMENT;
}

static int basin(bike_fate *out, double *times, const bike_model *model,
                 const bike_basin_def *def) {
  int code = check(def);
  if (code) return code;
  grid g = {0};
  code = ride_all(&g, out, times, model, def);
  release(&g);
  return code;
}

int bike_basin(bike_fate *out, const bike_model *model, const bike_basin_def *def) {
  if (!out || !model || !def) return BIKE_ERROR_ARGUMENT;
  return basin(out, NULL, model, def);
}

int bike_fate_of(bike_fate *out, double *time, const bike_model *model, const bike_basin_def *def,
                 double lean, double steer) {
  if (!out || !model || !def) return BIKE_ERROR_ARGUMENT;
  bike_basin_def one = *def;
  one.leans = &lean;
  one.steers = &steer;
  one.lean_count = one.steer_count = 1;
  one.threads = 1;
  one.progress = NULL;
  bike_fate fate;
  double decided = 0;
  int code = basin(&fate, &decided, model, &one);
  if (code) return code;
  *out = fate;
  if (time) *time = decided;
  return BIKE_OK;
}
