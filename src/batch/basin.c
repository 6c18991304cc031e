// SPDX-License-Identifier: Apache-2.0
#include <bicycle/basin.h>

#include <bicycle/cycle.h>
#include <bicycle/ensemble.h>
#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdint.h>

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

static int gather(fate_riders *riders, bike_fate *out, const bike_model *model,
                  const bike_basin_def *def) {
  size_t size = def->lean_count * def->steer_count;
  for (size_t k = 0; k < size; k++) {
    bike_state start;
    bool exists;
    int code = start_of(&start, &exists, model, def->speed, def->leans[k % def->lean_count],
                        def->steers[k / def->lean_count]);
    if (code) return code;
    out[k] = BIKE_FATE_NO_START;
    bike_member member = {.model = model, .start = start};
    if (exists) fate_riders_add(riders, &member, k);
  }
  return BIKE_OK;
}

static int ride_all(fate_riders *riders, bike_fate *out, double *times, const bike_model *model,
                    const bike_basin_def *def) {
  bool stable = false;
  int code = find_stable(&stable, model, def->speed);
  if (!code) code = gather(riders, out, model, def);
  bike_ensemble_def ensemble = fate_ensemble(def);
  if (!stable) ensemble.settled = 0;
  if (!code) code = fate_riders_ride(riders, out, times, NULL, &ensemble);
  for (size_t i = 0; i < riders->count && !code; i++) code = riders->results[i].error;
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
  fate_riders riders;
  code = fate_riders_allocate(&riders, def->lean_count * def->steer_count);
  if (!code) code = ride_all(&riders, out, times, model, def);
  fate_riders_free(&riders);
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
