// SPDX-License-Identifier: Apache-2.0
#include "ride_options.h"

#include <math.h>
#include <string.h>

static const char example[] = "Example: bicycle ride roadster --speed 6 --lean-rate 0.2 --time 10 "
                              "--sample 0.01 -o ride.csv\n";

static const char documentation[] =
    "Rides a bicycle from a given state, hands off or with one of the inputs, and writes the "
    "motion "
    "as CSV, one row at every multiple of the sampling time. Wheel lift is reported and does not "
    "end "
    "the ride; lying down, standstill and the end of the model's validity do. FILE is a bicycle "
    "file or the name of a shipped bicycle.";

enum {
  KEY_TIME = TERM_KEY_FIRST,
  KEY_SAMPLE,
  KEY_STEER_TORQUE,
  KEY_ROLL_TORQUE,
  KEY_RIDER_OFFSET,
  KEY_INPUT,
  KEY_METHOD,
  KEY_RTOL,
  KEY_ATOL,
  KEY_STEP,
  KEY_LEAN_LIMIT,
  KEY_STOP_AT
};

static const struct argp_option options[] = {
    {"time", KEY_TIME, "T", 0, "How long to ride, s (required)", 2},
    {"sample", KEY_SAMPLE, "DT", 0, "Time between rows, s (required)", 2},
    {"output", 'o', "X.csv", 0, "Where to write the rows (standard output)", 2},
    {"steer-torque", KEY_STEER_TORQUE, "T", 0, "Constant torque on the steer, left positive, N m",
     3},
    {"roll-torque", KEY_ROLL_TORQUE, "T", 0, "Constant torque on the frame, right positive, N m",
     3},
    {"rider-offset", KEY_RIDER_OFFSET, "W", 0, "Rider to the right of the file's place, m", 3},
    {"input", KEY_INPUT, "X.csv", 0,
     "Inputs over time: columns time, steer_torque, roll_torque, rider_offset", 3},
    {"method", KEY_METHOD, "rk8|adams|rk4", 0,
     "Adaptive Runge-Kutta of order 8 (default), Adams, or fixed-step Runge-Kutta of order 4", 4},
    {"rtol", KEY_RTOL, "X", 0, "Relative tolerance of rk8 and adams (1e-13)", 4},
    {"atol", KEY_ATOL, "X", 0, "Absolute tolerance of rk8 and adams (1e-13)", 4},
    {"step", KEY_STEP, "H", 0, "Step of rk4, a whole fraction of the sampling time, s (0.001)", 4},
    {"lean-limit", KEY_LEAN_LIMIT, "ANGLE", 0, "Lean at which the ride ends (80deg)", 5},
    {"stop-at", KEY_STOP_AT, "lift", 0, "End the ride when a wheel lifts", 5},
    {0},
};

// Inputs exclude each other: their sum is what --input is for.
static double action_of(ride_options *args, const char *option, const char *text) {
  if (args->action && strcmp(args->action, option) != 0)
    term_usage("%s and %s exclude each other; use --input for both", args->action, option);
  args->action = option;
  return strcmp(option, "--input") == 0 ? 0 : term_number_of(option, text);
}

static bike_method method_of(const char *text) {
  static const char *const names[] = {
      [BIKE_METHOD_RK8] = "rk8", [BIKE_METHOD_ADAMS] = "adams", [BIKE_METHOD_RK4] = "rk4"};
  for (int i = BIKE_METHOD_RK8; i <= BIKE_METHOD_RK4; i++)
    if (strcmp(text, names[i]) == 0) return (bike_method)i;
  term_usage("--method: '%s' is none of rk8, adams, rk4", text);
}

static double lean_limit_of(const char *text) {
  double limit = term_angle_of("--lean-limit", text);
  if (!(limit > 0 && limit <= M_PI / 2)) term_usage("--lean-limit: %s is not in 0 to 90deg", text);
  return limit;
}

static void check_complete(const ride_options *args) {
  const bike_ride_def *def = &args->def;
  if (!(def->duration > 0)) term_usage("--time is missing");
  if (!(def->sample > 0)) term_usage("--sample is missing");
  if (def->sample > def->duration)
    term_usage("--sample %g is longer than --time %g", def->sample, def->duration);
  bool fixed = def->method == BIKE_METHOD_RK4;
  if (args->has_step && !fixed) term_usage("--step is for --method rk4");
  if (args->has_tolerance && fixed) term_usage("--rtol and --atol are not for --method rk4");
}

// Options that say how to integrate and when to end.
static error_t parse_method(int key, const char *text, ride_options *args) {
  switch (key) {
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
  case KEY_LEAN_LIMIT:
    args->def.lean_limit = lean_limit_of(text);
    return 0;
  case KEY_STOP_AT:
    if (strcmp(text, "lift") != 0) term_usage("--stop-at: '%s' is not lift", text);
    args->def.stop_at_lift = true;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static error_t parse(int key, char *text, struct argp_state *state) {
  ride_options *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->start;
    state->child_inputs[1] = &args->show;
    return 0;
  case KEY_TIME:
    args->def.duration = term_positive_of("--time", text);
    return 0;
  case KEY_SAMPLE:
    args->def.sample = term_positive_of("--sample", text);
    return 0;
  case KEY_STEER_TORQUE:
    args->constant.steer_torque = action_of(args, "--steer-torque", text);
    return 0;
  case KEY_ROLL_TORQUE:
    args->constant.roll_torque = action_of(args, "--roll-torque", text);
    return 0;
  case KEY_RIDER_OFFSET:
    args->constant.rider_offset = action_of(args, "--rider-offset", text);
    return 0;
  case KEY_INPUT:
    action_of(args, "--input", text);
    args->input_file = text;
    return 0;
  case 'o':
    args->output = text;
    return 0;
  case ARGP_KEY_END:
    check_complete(args);
    return 0;
  default:
    return parse_method(key, text, args);
  }
}

ride_options ride_parse(int argc, char **argv) {
  const struct argp_child children[] = {
      {&cli_start_argp, 0, NULL, 0}, {&term_show_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  ride_options args = {.def = bike_default_ride_def()};
  term_parse(&argp, example, argc, argv, &args);
  args.def.start = args.start.state;
  return args;
}
