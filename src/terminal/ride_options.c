// SPDX-License-Identifier: Apache-2.0
#include "terminal/ride_options.h"

#include <math.h>
#include <string.h>

enum {
  KEY_TIME = TERM_KEY_FIRST,
  KEY_SAMPLE,
  KEY_STEER_TORQUE,
  KEY_ROLL_TORQUE,
  KEY_RIDER_OFFSET,
  KEY_INPUT,
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
    {"lean-limit", KEY_LEAN_LIMIT, "ANGLE", 0, "Lean at which the ride ends (80deg)", 5},
    {"stop-at", KEY_STOP_AT, "lift", 0, "End the ride when a wheel lifts", 5},
    {0},
};

// Inputs exclude each other: their sum is what --input is for.
static void take_action(term_ride_options *args, const char *option) {
  if (args->action && strcmp(args->action, option) != 0)
    term_usage("%s and %s exclude each other; use --input for both", args->action, option);
  args->action = option;
}

static double action_of(term_ride_options *args, const char *option, const char *text) {
  take_action(args, option);
  return term_number_of(option, text);
}

static double lean_limit_of(const char *text) {
  double limit = term_angle_of("--lean-limit", text);
  if (!(limit > 0 && limit <= M_PI / 2)) term_usage("--lean-limit: %s is not in 0 to 90deg", text);
  return limit;
}

static void check_complete(const term_ride_options *args) {
  if (!(args->duration > 0)) term_usage("--time is missing");
  if (!(args->sample > 0)) term_usage("--sample is missing");
  if (args->sample > args->duration)
    term_usage("--sample %g is longer than --time %g", args->sample, args->duration);
  if (args->show.json && args->output && strcmp(args->output, "-") == 0)
    term_usage("--json and -o - both mean the standard output: give -o a file, or leave it out");
}

// Options that say what acts on the bicycle.
static error_t parse_action(int key, const char *text, term_ride_options *args) {
  switch (key) {
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
    take_action(args, "--input");
    args->input_file = text;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static error_t parse(int key, char *text, struct argp_state *state) {
  term_ride_options *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->start;
    state->child_inputs[1] = &args->limits;
    state->child_inputs[2] = &args->show;
    return 0;
  case KEY_TIME:
    args->duration = term_positive_of("--time", text);
    return 0;
  case KEY_SAMPLE:
    args->sample = term_positive_of("--sample", text);
    return 0;
  case KEY_LEAN_LIMIT:
    args->lean_limit = lean_limit_of(text);
    return 0;
  case KEY_STOP_AT:
    if (strcmp(text, "lift") != 0) term_usage("--stop-at: '%s' is not lift", text);
    args->stop_at_lift = true;
    return 0;
  case 'o':
    args->output = text;
    return 0;
  case ARGP_KEY_END:
    check_complete(args);
    return 0;
  default:
    return parse_action(key, text, args);
  }
}

static const struct argp_child children[] = {{&term_start_argp, 0, NULL, 0},
                                             {&term_limits_argp, 0, NULL, 0},
                                             {&term_show_argp, 0, NULL, 0},
                                             {0}};

const struct argp term_ride_argp = {.options = options, .parser = parse, .children = children};
