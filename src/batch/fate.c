// SPDX-License-Identifier: Apache-2.0
// What becomes of a ride from any start.
#include <bicycle/basin.h>

#include <bicycle/cycle.h>
#include <bicycle/error.h>
#include <bicycle/ride.h>
#include <bicycle/stability.h>
#include <math.h>

// Looked at this often, riding straight for a second cannot be a passage of an oscillation.
static const double LOOK = 0.05; // s
static const int LOOKS_SETTLED = 20;

// What is looked for during a ride.
typedef struct watch {
  const bike_model *model;
  double settled;      // rad, rad/s
  bool straight;       // lean and steer must be small too, not only their rates
  bool judges;         // asks at the end of the second whether this motion is stable
  int quiet;           // looks in a row
  double rider_offset; // m  all the time
} watch;

// Whether every motion about the one that the ride has settled to decays.
static bool attracts(const watch *w, const bike_sample *s) {
  bike_linear linear;
  bike_eigenvalues e;
  bike_state here = {s->lean, s->steer, s->lean_rate, s->steer_rate, s->speed};
  bike_input input = {.rider_offset = w->rider_offset};
  if (w->straight) here = (bike_state){.speed = s->speed};
  return !bike_linearize(&linear, w->model, &here, &input) && !bike_eigenvalues_of(&e, linear.A) &&
         bike_all_decay(&e);
}

static int look(const bike_sample *s, const bike_sample_more *more, void *user) {
  (void)more;
  watch *w = user;
  double most = fmax(fabs(s->lean_rate), fabs(s->steer_rate));
  if (w->straight) most = fmax(most, fmax(fabs(s->lean), fabs(s->steer)));
  w->quiet = most < w->settled ? w->quiet + 1 : 0;
  if (w->quiet < LOOKS_SETTLED) return 0;
  if (!w->judges || attracts(w, s)) return 1;
  w->quiet = 0;
  return 0;
}

static void hold_rider(double time, bike_input *out, void *user) {
  (void)time;
  out->rider_offset = ((const watch *)user)->rider_offset;
}

static bool is_lifted(const bike_ride_result *result) {
  for (int i = 0; i < result->event_count && i < BIKE_MAX_EVENTS; i++) {
    bike_event_kind kind = result->events[i].kind;
    if (kind == BIKE_EVENT_REAR_LIFT || kind == BIKE_EVENT_FRONT_LIFT) return true;
  }
  return false;
}

static bool is_no_start(int code) {
  return code == BIKE_ERROR_GEOMETRY || code == BIKE_ERROR_SINGULAR ||
         code == BIKE_ERROR_NOT_STATIONARY;
}

// Rides until the watch sees what it looks for, or the end.
static int ride_out(bike_fate *out, double *time, const bike_basin_def *def,
                    const bike_state *start, watch *w) {
  bike_ride_def ride = bike_default_ride_def();
  ride.start = *start;
  ride.duration = def->duration;
  ride.sample = LOOK;
  ride.rtol = 1e-9; // fates change at the edge of the basin alone, by less than a picture shows
  ride.atol = 1e-11;
  ride.on_sample = look;
  ride.user = w;
  if (w->rider_offset != 0) ride.input = hold_rider;
  bike_ride_result result;
  int code = bike_ride(&result, w->model, &ride);
  if (time) *time = result.end_time;
  if (code && code != BIKE_ERROR_INTERRUPTED) return code;
  if (code == BIKE_ERROR_INTERRUPTED)
    *out = is_lifted(&result) ? BIKE_FATE_LIFTED : BIKE_FATE_STRAIGHT;
  else
    *out = result.complete ? BIKE_FATE_RIDING : BIKE_FATE_FALLEN;
  return BIKE_OK;
}

int bike_fate_of_start(bike_fate *out, double *time, const bike_model *model,
                       const bike_basin_def *def, const bike_state *start, double rider_offset) {
  if (!out || !model || !def || !start || !(def->duration >= LOOK) || !(def->settled > 0))
    return BIKE_ERROR_ARGUMENT;
  if (time) *time = 0;
  bike_upright_matrices m;
  bike_snapshot first;
  bike_input input = {.rider_offset = rider_offset};
  int code = bike_evaluate(&first, model, start, &input);
  if (is_no_start(code)) {
    *out = BIKE_FATE_NO_START;
    return BIKE_OK;
  }
  if (code) return code;
  watch w = {.model = model,
             .settled = def->settled,
             .straight = rider_offset == 0 && !bike_linearize_upright(&m, model),
             .judges = true,
             .rider_offset = rider_offset};
  return ride_out(out, time, def, start, &w);
}
