// SPDX-License-Identifier: Apache-2.0
#include "cmd_ride_options.h"

#include <math.h>
#include <string.h>

static const char example[] =
    "Example: bicycle mujoco ride roadster --speed 6 --lean-rate 0.2 --time 10 --sample 0.01 "
    "-o ride.csv\n"
    "         bicycle mujoco ride roadster.xml --time 10 --sample 0.01\n";

static const char documentation[] =
    "Rides a bicycle in MuJoCo and writes the same rows as `bicycle ride`. FILE is a bicycle file, "
    "the name of a shipped bicycle, or a model (.xml, .mjb) with the bodies and joints that "
    "`bicycle mujoco mjcf` writes; a model starts from its keyframe 'test' unless a state is "
    "given. "
    "A step at which MuJoCo warns, resets its time or loses the rolling constraint ends the ride "
    "with exit status 3.";

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
    {"sample", KEY_SAMPLE, "DT", 0, "Time between rows, a multiple of the timestep, s (required)",
     2},
    {"output", 'o', "X.csv", 0, "Where to write the rows (standard output)", 2},
    {"steer-torque", KEY_STEER_TORQUE, "T", 0, "Constant torque on the steer, left positive, N m",
     3},
    {"roll-torque", KEY_ROLL_TORQUE, "T", 0, "Constant torque on the frame, right positive, N m",
     3},
    {"rider-offset", KEY_RIDER_OFFSET, "W", 0, "Rider to the right of the file's place, m", 3},
    {"input", KEY_INPUT, "X.csv", 0, "Torques over time: columns time, steer_torque, roll_torque",
     3},
    {"lean-limit", KEY_LEAN_LIMIT, "ANGLE", 0, "Lean at which the ride ends (80deg)", 5},
    {"stop-at", KEY_STOP_AT, "lift", 0, "End the ride when a wheel lifts", 5},
    {0},
};

// Inputs exclude each other: their sum is what --input is for.
static double action_of(cmd_ride_options *args, const char *option, const char *text) {
  if (args->action && strcmp(args->action, option) != 0)
    term_usage("%s and %s exclude each other; use --input for both", args->action, option);
  args->action = option;
  return strcmp(option, "--input") == 0 ? 0 : term_number_of(option, text);
}

static double lean_limit_of(const char *text) {
  double limit = term_angle_of("--lean-limit", text);
  if (!(limit > 0 && limit < M_PI / 2)) term_usage("--lean-limit: %s is not in 0 to 90deg", text);
  return limit;
}

static bool ends_with(const char *text, const char *end) {
  size_t length = strlen(text), tail = strlen(end);
  return length > tail && strcmp(text + length - tail, end) == 0;
}

static void check_complete(cmd_ride_options *args) {
  if (!(args->def.duration > 0)) term_usage("--time is missing");
  if (!(args->def.sample > 0)) term_usage("--sample is missing");
  if (args->def.sample > args->def.duration)
    term_usage("--sample %g is longer than --time %g", args->def.sample, args->def.duration);
}

// What a model file says itself cannot be said again.
static void check_model(cmd_ride_options *args) {
  const char *file = args->start.file;
  args->is_model = ends_with(file, ".xml") || ends_with(file, ".mjb");
  args->has_start = cmd_has_start(&args->start);
  if ((args->has_start || !args->is_model) && isnan(args->start.state.speed))
    term_usage("--speed is missing");
  if (!args->is_model) return;
  if (args->model.has_root) term_usage("--root: %s has its own", file);
  if (args->model.has_rolling) term_usage("--rolling: %s has its own", file);
  if (args->constant.rider_offset != 0)
    term_usage("--rider-offset: the rider of %s sits where he sits; give it to mjcf", file);
}

static error_t parse(int key, char *text, struct argp_state *state) {
  cmd_ride_options *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->start;
    state->child_inputs[1] = &args->model;
    state->child_inputs[2] = &args->show;
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
  case KEY_LEAN_LIMIT:
    args->def.lean_limit = lean_limit_of(text);
    return 0;
  case KEY_STOP_AT:
    if (strcmp(text, "lift") != 0) term_usage("--stop-at: '%s' is not lift", text);
    args->def.stop_at_lift = true;
    return 0;
  case 'o':
    args->output = text;
    return 0;
  case ARGP_KEY_END:
    check_complete(args);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

cmd_ride_options cmd_parse_ride(int argc, char **argv) {
  const struct argp_child children[] = {{&cli_start_argp, 0, NULL, 0},
                                        {&cmd_model_argp, 0, NULL, 0},
                                        {&term_show_argp, 0, NULL, 0},
                                        {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  cmd_ride_options args = {.start = cmd_no_start(),
                           .model = {.options = mjcf_default_options()},
                           .def = runner_default_ride_def()};
  args.def.duration = args.def.sample = 0; // required
  term_parse(&argp, example, argc, argv, &args);
  check_model(&args);
  args.model.options.rider_offset = args.constant.rider_offset;
  return args;
}
