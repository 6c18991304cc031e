// SPDX-License-Identifier: Apache-2.0
#include <bicycle/basin.h>

#include <bicycle/cycle.h>
#include <bicycle/error.h>
#include <bicycle/ride.h>
#include <bicycle/stability.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

// Looked at this often, riding straight for a second cannot be a passage of an oscillation.
static const double LOOK = 0.05; // s
static const int LOOKS_SETTLED = 20;

const char *bike_fate_string(bike_fate fate) {
  static const char *const names[BIKE_FATES] = {"straight", "lifted", "riding", "fallen",
                                                "no start"};
  return fate < BIKE_FATES ? names[fate] : "unknown";
}

bike_basin_def bike_default_basin_def(void) {
  return (bike_basin_def){.duration = 60, .settled = 0.005, .threads = 1};
}

typedef struct watch {
  double settled; // rad
  int quiet;      // looks in a row
} watch;

// Whether anything can be attracted: a slow fall looks like riding straight for a long time.
static int find_stable(bool *out, const bike_model *model, double speed) {
  bike_eigenvalues e;
  bike_upright_matrices m;
  int code = bike_linearize_upright(&m, model); // refuses what cannot ride straight
  if (!code) code = bike_upright_eigenvalues(&e, model, speed);
  if (!code) *out = bike_all_decay(&e);
  return code;
}

static int look(const bike_sample *s, const bike_sample_more *more, void *user) {
  (void)more;
  watch *w = user;
  double most =
      fmax(fmax(fabs(s->lean), fabs(s->steer)), fmax(fabs(s->lean_rate), fabs(s->steer_rate)));
  w->quiet = most < w->settled ? w->quiet + 1 : 0;
  return w->quiet >= LOOKS_SETTLED;
}

static bool is_lifted(const bike_ride_result *result) {
  for (int i = 0; i < result->event_count && i < BIKE_MAX_EVENTS; i++) {
    bike_event_kind kind = result->events[i].kind;
    if (kind == BIKE_EVENT_REAR_LIFT || kind == BIKE_EVENT_FRONT_LIFT) return true;
  }
  return false;
}

int bike_fate_of(bike_fate *out, double *time, const bike_model *model, const bike_basin_def *def,
                 double lean, double steer) {
  if (!out || !model || !def) return BIKE_ERROR_ARGUMENT;
  if (time) *time = 0;
  bool stable;
  int code = find_stable(&stable, model, def->speed);
  if (code) return code;
  bike_ride_def ride = bike_default_ride_def();
  ride.start = (bike_state){.lean = lean, .steer = steer};
  code = bike_speed_of_equal_energy(&ride.start.speed, model, &ride.start, def->speed);
  if (code == BIKE_ERROR_GEOMETRY || code == BIKE_ERROR_SINGULAR ||
      code == BIKE_ERROR_NOT_STATIONARY) {
    *out = BIKE_FATE_NO_START;
    return BIKE_OK;
  }
  if (code) return code;
  watch w = {.settled = stable ? def->settled : 0};
  ride.duration = def->duration;
  ride.sample = LOOK;
  ride.rtol = 1e-9; // fates change at the edge of the basin alone, by less than a picture shows
  ride.atol = 1e-11;
  ride.on_sample = look;
  ride.user = &w;
  bike_ride_result result;
  code = bike_ride(&result, model, &ride);
  if (time) *time = result.end_time;
  if (code && code != BIKE_ERROR_INTERRUPTED) return code;
  if (code == BIKE_ERROR_INTERRUPTED)
    *out = is_lifted(&result) ? BIKE_FATE_LIFTED : BIKE_FATE_STRAIGHT;
  else
    *out = result.complete ? BIKE_FATE_RIDING : BIKE_FATE_FALLEN;
  return BIKE_OK;
}

// Shared by the threads: each takes the next start until none is left.
typedef struct work {
  bike_fate *out;
  const bike_model *model;
  const bike_basin_def *def;
  atomic_size_t next;
  atomic_int error; // the first
} work;

static void *run(work *w, bool tells) {
  const bike_basin_def *def = w->def;
  size_t count = def->lean_count * def->steer_count;
  for (;;) {
    size_t k = atomic_fetch_add(&w->next, 1);
    if (k >= count || atomic_load(&w->error)) return NULL;
    int none = BIKE_OK;
    int code = bike_fate_of(&w->out[k], NULL, w->model, def, def->leans[k % def->lean_count],
                            def->steers[k / def->lean_count]);
    if (code) atomic_compare_exchange_strong(&w->error, &none, code);
    if (tells && def->progress) def->progress((double)(k + 1) / (double)count, def->user);
  }
}

static void *helper(void *user) {
  return run(user, false);
}

enum { MOST_THREADS = 256 };

static int check(const bike_basin_def *def) {
  bool right = def->speed > 0 && isfinite(def->speed) && def->leans && def->steers &&
               def->duration >= LOOK && isfinite(def->duration) && def->settled > 0 &&
               def->threads >= 1 && def->threads <= MOST_THREADS;
  return right ? BIKE_OK : BIKE_ERROR_ARGUMENT;
}

int bike_basin(bike_fate *out, const bike_model *model, const bike_basin_def *def) {
  if (!out || !model || !def) return BIKE_ERROR_ARGUMENT;
  int code = check(def);
  if (code) return code;
  work w = {.out = out, .model = model, .def = def};
  pthread_t threads[MOST_THREADS];
  int started = 0;
  // a thread that cannot be had leaves its share to the others
  while (started < def->threads - 1 && !pthread_create(&threads[started], NULL, helper, &w))
    started++;
  run(&w, true);
  for (int i = 0; i < started; i++) pthread_join(threads[i], NULL);
  return atomic_load(&w.error);
}
