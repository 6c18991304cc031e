// SPDX-License-Identifier: Apache-2.0
// What becomes of rides from any start.
#include "batch/fate.h"

#include <bicycle/error.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdlib.h>

#include "batch/parallel.h"

bike_ensemble_def fate_ensemble(const bike_basin_def *def) {
  bike_ensemble_def ensemble = bike_default_ensemble_def();
  ensemble.duration = def->duration;
  ensemble.settled = def->settled;
  ensemble.rtol = 1e-9; // fates change at the edge of the basin alone, by less than a picture shows
  ensemble.atol = 1e-11;
  ensemble.threads = def->threads;
  ensemble.progress = def->progress;
  ensemble.user = def->user;
  return ensemble;
}

bike_fate fate_of_result(const bike_member_result *r) {
  switch (r->outcome) {
  case BIKE_OUTCOME_SETTLED:
    return r->lifted ? BIKE_FATE_LIFTED : BIKE_FATE_STRAIGHT;
  case BIKE_OUTCOME_COMPLETE:
    return BIKE_FATE_RIDING;
  default:
    return BIKE_FATE_FALLEN;
  }
}

bool fate_is_no_start(int code) {
  return code == BIKE_ERROR_GEOMETRY || code == BIKE_ERROR_SINGULAR ||
         code == BIKE_ERROR_NOT_STATIONARY;
}

// Whether every motion about the one to which a ride has settled decays: a slow fall looks settled
// for a long time.
static bool attracts(const bike_member *member, const bike_state *state, void *user) {
  (void)user;
  bike_linear linear;
  bike_eigenvalues e;
  bike_state straight = {.speed = state->speed};
  const bike_state *about = member->circles ? state : &straight;
  return !bike_linearize(&linear, member->model, about, &member->input) &&
         !bike_eigenvalues_of(&e, linear.A) && bike_all_decay(&e);
}

int fate_riders_allocate(fate_riders *r, size_t size) {
  size_t room = size ? size : 1;
  *r = (fate_riders){.members = calloc(room, sizeof *r->members),
                     .results = calloc(room, sizeof *r->results),
                     .places = calloc(room, sizeof *r->places)};
  return r->members && r->results && r->places ? BIKE_OK : BIKE_ERROR_MEMORY;
}

void fate_riders_free(fate_riders *r) {
  free(r->members);
  free(r->results);
  free(r->places);
}

void fate_riders_add(fate_riders *r, const bike_member *member, size_t place) {
  r->members[r->count] = *member;
  r->places[r->count++] = place;
}

int fate_riders_ride(fate_riders *r, bike_fate *out, double *times, int *codes,
                     const bike_ensemble_def *ensemble) {
  int code = bike_ensemble_ride(r->results, r->members, r->count, ensemble);
  for (size_t i = 0; i < r->count && !code; i++) {
    const bike_member_result *result = &r->results[i];
    if (codes) codes[r->places[i]] = result->error;
    out[r->places[i]] = fate_of_result(result);
    if (times) times[r->places[i]] = result->time;
  }
  return code;
}

// The code of a start that cannot be ridden; 0 also where there is no such state.
static int add(fate_riders *riders, const bike_member *member, size_t place) {
  bike_snapshot first;
  bike_upright_matrices m;
  int code = bike_evaluate(&first, member->model, &member->start, &member->input);
  if (code) return fate_is_no_start(code) ? BIKE_OK : code;
  bike_member rides = *member;
  rides.circles =
      member->input.rider_offset != 0 || bike_linearize_upright(&m, member->model) != BIKE_OK;
  fate_riders_add(riders, &rides, place);
  return BIKE_OK;
}

static int ride_all(fate_riders *riders, bike_fate *out, double *times, int *codes,
                    const bike_member *members, size_t count, const bike_basin_def *def) {
  for (size_t i = 0; i < count; i++) {
    out[i] = BIKE_FATE_NO_START;
    codes[i] = add(riders, &members[i], i);
    if (times) times[i] = 0;
  }
  bike_ensemble_def ensemble = fate_ensemble(def);
  ensemble.judge = attracts;
  return fate_riders_ride(riders, out, times, codes, &ensemble);
}

static bool is_right(const bike_member *members, size_t count, const bike_basin_def *def) {
  bool right = def->duration > 0 && isfinite(def->duration) && def->settled > 0 &&
               def->threads >= 1 && def->threads <= PARALLEL_MOST_THREADS;
  for (size_t i = 0; i < count && right; i++) {
    const bike_input *in = &members[i].input;
    right = members[i].model && in->steer_torque == 0 && in->roll_torque == 0 &&
            in->rider_velocity == 0 && in->rider_acceleration == 0;
  }
  return right;
}

int bike_fates_of_starts(bike_fate *out, double *times, int *codes, const bike_member *members,
                         size_t count, const bike_basin_def *def) {
  if (!out || !codes || !members || !def || !is_right(members, count, def))
    return BIKE_ERROR_ARGUMENT;
  fate_riders riders;
  int code = fate_riders_allocate(&riders, count);
  if (!code) code = ride_all(&riders, out, times, codes, members, count, def);
  fate_riders_free(&riders);
  return code;
}

int bike_fate_of_start(bike_fate *out, double *time, const bike_model *model,
                       const bike_basin_def *def, const bike_state *start, double rider_offset) {
  if (!out || !model || !def || !start) return BIKE_ERROR_ARGUMENT;
  bike_member member = {.model = model, .start = *start, .input = {.rider_offset = rider_offset}};
  bike_basin_def alone = *def;
  alone.threads = 1;
  alone.progress = NULL;
  bike_fate fate;
  double decided;
  int own, code = bike_fates_of_starts(&fate, &decided, &own, &member, 1, &alone);
  if (!code) code = own;
  if (code) return code;
  *out = fate;
  if (time) *time = decided;
  return BIKE_OK;
}
