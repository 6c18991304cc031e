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

typedef struct starts {
  size_t count; // of those that ride
  bike_member *members;
  bike_member_result *results;
  size_t *places;
} starts;

// The code of a start that cannot be ridden; 0 also where there is no such state.
static int add(starts *s, const bike_member *member, size_t place) {
  bike_snapshot first;
  bike_upright_matrices m;
  int code = bike_evaluate(&first, member->model, &member->start, &member->input);
  if (code) return fate_is_no_start(code) ? BIKE_OK : code;
  bike_member *rides = &s->members[s->count];
  *rides = *member;
  rides->circles =
      member->input.rider_offset != 0 || bike_linearize_upright(&m, member->model) != BIKE_OK;
  s->places[s->count++] = place;
  return BIKE_OK;
}

static int ride_all(starts *s, bike_fate *out, double *times, int *codes,
                    const bike_member *members, size_t count, const bike_basin_def *def) {
  if (!s->members || !s->results || !s->places) return BIKE_ERROR_MEMORY;
  for (size_t i = 0; i < count; i++) {
    out[i] = BIKE_FATE_NO_START;
    codes[i] = add(s, &members[i], i);
    if (times) times[i] = 0;
  }
  bike_ensemble_def ensemble = fate_ensemble(def);
  ensemble.judge = attracts;
  int code = bike_ensemble_ride(s->results, s->members, s->count, &ensemble);
  for (size_t i = 0; i < s->count && !code; i++) {
    const bike_member_result *r = &s->results[i];
    codes[s->places[i]] = r->error;
    out[s->places[i]] = fate_of_result(r);
    if (times) times[s->places[i]] = r->time;
  }
  return code;
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
  size_t room = count ? count : 1;
  starts s = {.members = calloc(room, sizeof *s.members),
              .results = calloc(room, sizeof *s.results),
              .places = calloc(room, sizeof *s.places)};
  int code = ride_all(&s, out, times, codes, members, count, def);
  free(s.members);
  free(s.results);
  free(s.places);
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
