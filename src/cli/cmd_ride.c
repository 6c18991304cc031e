// SPDX-License-Identifier: Apache-2.0
// bicycle ride: the equations integrated in time.
#include "commands.h"
#include "terminal/ride.h"

#include <bicycle/error.h>
#include <bicycle/ride.h>
#include <string.h>

//---------------------------------- command line --------------------------------------------------

static const char example[] = "Example: bicycle ride roadster --speed 6 --lean-rate 0.2 --time 10 "
                              "--sample 0.01 -o ride.csv\n";

static const char documentation[] =
    "Rides a bicycle from a given state, hands off or with one of the inputs, and writes the "
    "motion as CSV, one row at every multiple of the sampling time. Wheel lift is reported and "
    "does not end the ride; lying down, standstill and the end of the model's validity do. At the "
    "end the largest friction asked is told, and what no ground and no rider can do. FILE is a "
    "bicycle file or the name of a shipped bicycle.";

typedef struct arguments {
  term_ride_options ride;
  bike_ride_def def; // how to integrate; the rest is filled in from `ride`
  bool has_step, has_tolerance;
} arguments;

enum { KEY_METHOD = TERM_KEY_FIRST, KEY_RTOL, KEY_ATOL, KEY_STEP };

static const struct argp_option options[] = {
    {"method", KEY_METHOD, "rk8|adams|rk4", 0,
     "Adaptive Runge-Kutta of order 8 (default), Adams, or fixed-step Runge-Kutta of order 4", 4},
    {"rtol", KEY_RTOL, "X", 0, "Relative tolerance of rk8 and adams (1e-13)", 4},
    {"atol", KEY_ATOL, "X", 0, "Absolute tolerance of rk8 and adams (1e-13)", 4},
    {"step", KEY_STEP, "H", 0, "Step of rk4, a whole fraction of the sampling time, s (0.001)", 4},
    {0},
};

static bike_method method_of(const char *text) {
  static const char *const names[] = {
      [BIKE_METHOD_RK8] = "rk8", [BIKE_METHOD_ADAMS] = "adams", [BIKE_METHOD_RK4] = "rk4"};
  for (int i = BIKE_METHOD_RK8; i <= BIKE_METHOD_RK4; i++)
    if (strcmp(text, names[i]) == 0) return (bike_method)i;
  term_usage("--method: '%s' is none of rk8, adams, rk4", text);
}

static void check_method(const arguments *args) {
  bool fixed = args->def.method == BIKE_METHOD_RK4;
  if (args->has_step && !fixed) term_usage("--step is for --method rk4");
  if (args->has_tolerance && fixed) term_usage("--rtol and --atol are not for --method rk4");
}

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->ride;
    return 0;
  case KEY_METHOD:
    args->def.method = method_of(text);
    return 0;
  case KEY_RTOL:
    args->def.rtol = term_positive_of("--rtol", text);
    args->has_tolerance = true;
    return 0;
  case KEY_ATOL:
    args->def.atol = term_positive_of("--atol", text);
    args->has_tolerance = true;
    return 0;
  case KEY_STEP:
    args->def.step = term_positive_of("--step", text);
    args->has_step = true;
    return 0;
  case ARGP_KEY_END:
    check_method(args);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

// The definition without what is called during the ride.
static void complete_def(arguments *args) {
  const term_ride_options *ride = &args->ride;
  args->def.start = ride->start.state;
  args->def.duration = ride->duration;
  args->def.sample = ride->sample;
  args->def.lean_limit = ride->lean_limit;
  args->def.stop_at_lift = ride->stop_at_lift;
  args->def.friction_limit = ride->limits.friction;
}

//---------------------------------- the ride ------------------------------------------------------

static int take_sample(const bike_sample *sample, const bike_sample_more *more, void *user) {
  return term_ride_take(user, sample, more);
}

static term_exit fail_ride(const term_ride *self, const bike_ride_def *def, int error,
                           double time) {
  const char *file = self->options->start.file;
  const char *rule = error == BIKE_ERROR_ARGUMENT ? bike_ride_broken_rule(def) : NULL;
  if (rule) return term_fail(TERM_USAGE, "%s", rule);
  if (self->record.count == 0) return term_fail_bike(error, file);
  return term_fail(term_exit_of(error), "%s at %.9g s: %s", file, time, bike_error_string(error));
}

static term_exit ride(term_ride *self, bike_ride_def def, const bike_bicycle *bicycle,
                      const bike_model *model) {
  bike_ride_result result = {0};
  def.input = term_ride_input;
  def.on_sample = take_sample;
  def.user = self;
  if (self->table) def.breakpoints = bike_input_table_times(self->table, &def.breakpoint_count);
  int error = bike_ride(&result, model, &def);
  term_ride_stop(self);
  // A stream that takes no more rows is reported when it is committed.
  bool whole = error == BIKE_OK || error == BIKE_ERROR_INTERRUPTED;
  term_exit code = whole ? TERM_DONE : fail_ride(self, &def, error, result.end_time);
  const term_ride_outcome outcome = {.bicycle = bicycle->name,
                                     .end_time = result.end_time,
                                     .complete = result.complete,
                                     .end = whole ? &result.end : NULL,
                                     .event_count = result.event_count,
                                     .events = result.events,
                                     .ground = result.ground,
                                     .limits = self->options->limits,
                                     .error = whole ? NULL : bike_error_string(error),
                                     .note = "",
                                     .more = json_pack("{s:I, s:I}", "evaluations",
                                                       (json_int_t)result.evaluations, "steps",
                                                       (json_int_t)result.steps)};
  return term_ride_end(self, &outcome, code);
}

int cmd_ride(int argc, char **argv) {
  const struct argp_child children[] = {{&term_ride_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {.def = bike_default_ride_def()};
  args.ride.lean_limit = args.def.lean_limit;
  term_parse(&argp, example, argc, argv, &args);
  complete_def(&args);

  bike_bicycle bicycle;
  bike_model model;
  term_ride self = {0};
  term_exit code =
      term_load_with_rider(&bicycle, &model, args.ride.start.file, args.ride.constant.rider_offset);
  if (code == TERM_DONE) term_set_reach(&args.ride.limits, &bicycle);
  if (code == TERM_DONE) code = term_ride_begin(&self, &args.ride);
  if (code == TERM_DONE) code = ride(&self, args.def, &bicycle, &model);
  term_ride_free(&self);
  return code;
}
