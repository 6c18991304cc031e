// SPDX-License-Identifier: Apache-2.0
#include "terminal/start.h"

#include "terminal/data.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>

enum { KEY_LEAN = TERM_KEY_FIRST, KEY_STEER, KEY_LEAN_RATE, KEY_STEER_RATE, KEY_SPEED };

// Radians are asked for, and degrees meant: no bicycle leans like that. Any steer has a meaning.
static double lean_of(const char *text) {
  double lean = term_angle_of("--lean", text);
  if (fabs(lean) > M_PI / 2)
    term_usage("--lean: %s is beyond 90deg; degrees have the suffix deg", text);
  return lean;
}

static double steer_of(const char *text) {
  double steer = term_angle_of("--steer", text);
  if (fabs(steer) > 2 * M_PI)
    term_message("--steer: %s is more than a whole turn; degrees have the suffix deg", text);
  return steer;
}

static error_t parse_start(int key, char *text, struct argp_state *argp_state) {
  term_start *start = argp_state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    argp_state->child_inputs[0] = &start->file;
    return 0;
  case KEY_LEAN:
    start->state.lean = lean_of(text);
    return 0;
  case KEY_STEER:
    start->state.steer = steer_of(text);
    return 0;
  case KEY_LEAN_RATE:
    start->state.lean_rate = term_rate_of("--lean-rate", text);
    return 0;
  case KEY_STEER_RATE:
    start->state.steer_rate = term_rate_of("--steer-rate", text);
    return 0;
  case KEY_SPEED:
    start->state.speed = term_number_of("--speed", text);
    start->has_speed = true;
    return 0;
  case ARGP_KEY_END:
    if (!start->speed_optional && !start->has_speed) term_usage("--speed is missing");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option start_options[] = {
    {"speed", KEY_SPEED, "V", 0, "Speed of the rear contact point, m/s", 1},
    {"lean", KEY_LEAN, "ANGLE", 0, "Lean, right positive, rad or 5deg", 1},
    {"steer", KEY_STEER, "ANGLE", 0, "Steer, left positive, rad or 5deg", 1},
    {"lean-rate", KEY_LEAN_RATE, "RATE", 0, "Rate of the lean, rad/s or 5deg", 1},
    {"steer-rate", KEY_STEER_RATE, "RATE", 0, "Rate of the steer, rad/s or 5deg", 1},
    {0},
};

// --help says of each command whether it needs a speed. argp frees what is not `text`.
static char *say_whether_required(int key, const char *text, void *input) {
  const term_start *start = input;
  char *told = NULL;
  if (key == KEY_SPEED && text && start)
    if (asprintf(&told, "%s (required%s)", text,
                 start->speed_optional ? " with any other number of the state" : "") < 0)
      told = NULL;
  return told ? told : (char *)(uintptr_t)text;
}

static const struct argp_child start_children[] = {{&term_file_argp, 0, NULL, 0}, {0}};

const struct argp term_start_argp = {.options = start_options,
                                     .parser = parse_start,
                                     .children = start_children,
                                     .help_filter = say_whether_required};

term_exit term_load_with_rider(bike_bicycle *bicycle, bike_model *model, const char *file,
                               double rider_offset) {
  term_exit code = term_load_bicycle(bicycle, model, file);
  if (code == TERM_DONE && rider_offset != 0 && !(model->rider_mass > 0))
    return term_fail_bike(BIKE_ERROR_NO_RIDER, file);
  return code;
}
