// SPDX-License-Identifier: Apache-2.0
// bicycle turn: stationary circular motions.
#include "commands.h"
#include "terminal/data.h"
#include "turn_show.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

static const char example[] =
    "Example: bicycle turn roadster --speed 5.5 --rider-offset 0.01\n"
    "         bicycle turn benchmark --rider-offset 0 --steer -5deg --json\n"
    "         bicycle turn roadster --speed 6.5\n";

static const char documentation[] =
    "Circles ridden with constant lean, steer and speed, hands off or with a constant steer "
    "torque: every one that has the two values given, with its eigenvalues at constant energy. "
    "--speed or --rider-offset alone shows the folds and ends of the branches. A bicycle without "
    "a rider has --rider-offset 0. At a capsize speed, where riding straight is neutrally stable, "
    "the turns that branch off it are not distinct from it, and not listed. What no ground and no "
    "rider can do (a wheel that is pulled, more friction than --friction, a rider beyond --reach) "
    "is marked as outside physics.";

typedef struct arguments {
  term_question question;
  bike_turn_def def;
  term_limits limits;
} arguments;

// In the order of bike_turn_variable.
static const char *const names[BIKE_TURN_VARIABLES] = {"--speed", "--lean", "--steer",
                                                       "--rider-offset"};

enum {
  KEY_VARIABLE = TERM_KEY_FIRST,
  KEY_STEER_TORQUE = KEY_VARIABLE + BIKE_TURN_VARIABLES,
  KEY_SPEED_LIMIT,
  KEY_OFFSET_LIMIT
};

static void take(bike_turn_def *def, int v, const char *text) {
  bool angle = v == BIKE_TURN_LEAN || v == BIKE_TURN_STEER;
  def->value[v] = angle ? term_angle_of(names[v], text) : term_number_of(names[v], text);
  def->given[v] = true;
}

// What the library would refuse without saying which.
static void check(const bike_turn_def *def) {
  int count = 0;
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++) count += def->given[v];
  bool place = def->given[BIKE_TURN_LEAN] || def->given[BIKE_TURN_STEER];
  if (count > 2 || count == 0 || (count == 1 && place))
    term_usage("give two of --speed, --lean, --steer, --rider-offset (or --speed or "
               "--rider-offset alone)");
  if (def->given[BIKE_TURN_SPEED] && def->value[BIKE_TURN_SPEED] < 0)
    term_usage("--speed: %g is negative", def->value[BIKE_TURN_SPEED]);
}

// Limits are known once the bicycle is.
static term_exit check_range(const bike_turn_def *def) {
  const double degree = 3.14159265358979323846 / 180;
  const struct {
    double limit, unit;
    const char *name, *hint;
  } range[BIKE_TURN_VARIABLES] = {{def->speed_limit, 1, "m/s", " (see --speed-limit)"},
                                  {def->lean_limit, degree, "deg", ""},
                                  {def->steer_limit, degree, "deg", ""},
                                  {def->offset_limit, 1, "m", " (see --offset-limit)"}};
  for (int v = 0; v < BIKE_TURN_VARIABLES; v++)
    if (def->given[v] && fabs(def->value[v]) > range[v].limit)
      return term_fail(TERM_USAGE, "%s: %g %s is beyond the range of the search, %g %s%s", names[v],
                       def->value[v] / range[v].unit, range[v].name, range[v].limit / range[v].unit,
                       range[v].name, range[v].hint);
  return TERM_DONE;
}

static double limit_of(const char *option, const char *text) {
  double limit = term_number_of(option, text);
  if (!(limit > 0)) term_usage("%s: '%s' is not positive", option, text);
  return limit;
}

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->question;
    state->child_inputs[1] = &args->limits;
    return 0;
  case KEY_VARIABLE + BIKE_TURN_SPEED:
  case KEY_VARIABLE + BIKE_TURN_LEAN:
  case KEY_VARIABLE + BIKE_TURN_STEER:
  case KEY_VARIABLE + BIKE_TURN_OFFSET:
    take(&args->def, key - KEY_VARIABLE, text);
    return 0;
  case KEY_STEER_TORQUE:
    args->def.steer_torque = term_number_of("--steer-torque", text);
    return 0;
  case KEY_SPEED_LIMIT:
    args->def.speed_limit = limit_of("--speed-limit", text);
    return 0;
  case KEY_OFFSET_LIMIT:
    args->def.offset_limit = limit_of("--offset-limit", text);
    return 0;
  case ARGP_KEY_END:
    check(&args->def);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"speed", KEY_VARIABLE + BIKE_TURN_SPEED, "V", 0, "Speed of the rear contact point, m/s", 1},
    {"lean", KEY_VARIABLE + BIKE_TURN_LEAN, "ANGLE", 0, "Lean, right positive, rad or 5deg", 1},
    {"steer", KEY_VARIABLE + BIKE_TURN_STEER, "ANGLE", 0, "Steer, left positive, rad or 5deg", 1},
    {"rider-offset", KEY_VARIABLE + BIKE_TURN_OFFSET, "W", 0,
     "Rider to the right of the file's place, m", 1},
    {"steer-torque", KEY_STEER_TORQUE, "T", 0, "Torque on the steer, left positive, N m (0)", 2},
    {"speed-limit", KEY_SPEED_LIMIT, "V", 0,
     "Fastest speed that is looked for, m/s (50, of very small or large bicycles by their size)",
     3},
    {"offset-limit", KEY_OFFSET_LIMIT, "W", 0,
     "Farthest rider offset that is looked for, m (1, likewise)", 3},
    {0},
};

static term_exit fail(int error, const bike_turns *found, const char *file) {
  if (error == BIKE_ERROR_NO_CONVERGENCE)
    return term_fail(TERM_INVALID, "%s: no convergence: accelerations of %.3g rad/s^2 are left",
                     file, found->residual);
  if (error == BIKE_ERROR_NO_RIDER)
    return term_fail(TERM_USAGE,
                     "%s: no part is the rider, so that one of the two given has to be "
                     "--rider-offset 0",
                     file);
  return term_fail_bike(error, file);
}

int cmd_turn(int argc, char **argv) {
  const struct argp_child children[] = {
      {&term_question_argp, 0, NULL, 0}, {&term_limits_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {.def = bike_default_turn_def()};
  term_parse(&argp, example, argc, argv, &args);

  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_bicycle(&bicycle, &model, args.question.file);
  if (code != TERM_DONE) return code;
  args.def = bike_turn_limits(&args.def, &model);
  term_set_reach(&args.limits, &bicycle);
  code = check_range(&args.def);
  if (code != TERM_DONE) return code;

  bike_turns *found = calloc(1, sizeof *found); // large for a stack
  if (!found) return term_fail_bike(BIKE_ERROR_MEMORY, args.question.file);
  int error = bike_turns_find(found, &model, &args.def);
  if (error != BIKE_OK) {
    code = fail(error, found, args.question.file);
  } else {
    turn_answer answer = {&bicycle, &model, &args.def, found, &args.limits};
    bool printed = args.question.show.json
                       ? turn_print_json(&answer, args.question.show.convention)
                       : turn_print_tables(&answer, args.question.show.convention);
    code = printed ? TERM_DONE : term_fail_bike(BIKE_ERROR_MEMORY, args.question.file);
  }
  free(found);
  return code;
}
