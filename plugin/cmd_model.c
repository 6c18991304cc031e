// SPDX-License-Identifier: Apache-2.0
#include "cmd.h"

#include <math.h>
#include <string.h>

enum { KEY_ROOT = TERM_KEY_FIRST, KEY_ROLLING, KEY_INTEGRATOR, KEY_TIMESTEP };

// The place of a text among `count` names; ends the program where it is none of them.
static int choice_of(const char *option, const char *text, const char *const *names, int count) {
  char all[100] = "";
  for (int i = 0; i < count; i++) {
    if (strcmp(text, names[i]) == 0) return i;
    strncat(all, i ? ", " : "", sizeof all - strlen(all) - 1);
    strncat(all, names[i], sizeof all - strlen(all) - 1);
  }
  term_usage("%s: '%s' is none of %s", option, text, all);
}

static error_t parse(int key, char *text, struct argp_state *state) {
  static const char *const roots[] = {[MJCF_ROOT_HINGE] = "hinge", [MJCF_ROOT_FREE] = "free"};
  static const char *const rollings[] = {
      [MJCF_ROLLING_EXACT] = "exact", [MJCF_ROLLING_CONTACT] = "contact"};
  static const char *const integrators[] = {
      [MJCF_RK4] = "RK4", [MJCF_EULER] = "Euler", [MJCF_IMPLICIT] = "implicit"};
  cmd_model *model = state->input;
  switch (key) {
  case KEY_ROOT:
    model->options.root = (mjcf_root)choice_of("--root", text, roots, 2);
    model->has_root = true;
    return 0;
  case KEY_ROLLING:
    model->options.rolling = (mjcf_rolling)choice_of("--rolling", text, rollings, 2);
    model->has_rolling = true;
    return 0;
  case KEY_INTEGRATOR:
    model->options.integrator = (mjcf_integrator)choice_of("--integrator", text, integrators, 3);
    model->has_integrator = true;
    return 0;
  case KEY_TIMESTEP:
    model->options.timestep = term_positive_of("--timestep", text);
    model->has_timestep = true;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"root", KEY_ROOT, "hinge|free", 0,
     "Slides and hinges (default; RK4 is of order 4), or a free joint (order 2)", 4},
    {"rolling", KEY_ROLLING, "exact|contact", 0,
     "The exact rolling constraint (default), or MuJoCo's own contacts", 4},
    {"integrator", KEY_INTEGRATOR, "RK4|Euler|implicit", 0, "MuJoCo's integrator (RK4)", 4},
    {"timestep", KEY_TIMESTEP, "H", 0, "MuJoCo's timestep, s (0.001)", 4},
    {0},
};

const struct argp cmd_model_argp = {.options = options, .parser = parse};

term_start cmd_no_start(void) {
  // Whether a speed is needed depends on the file.
  return (term_start){.state = {NAN, NAN, NAN, NAN, NAN}, .speed_optional = true};
}

bool cmd_has_start(term_start *start) {
  double *numbers[] = {&start->state.lean, &start->state.steer, &start->state.lean_rate,
                       &start->state.steer_rate};
  bool given = !isnan(start->state.speed);
  for (int i = 0; i < 4; i++) {
    if (isnan(*numbers[i]))
      *numbers[i] = 0;
    else
      given = true;
  }
  return given;
}

term_exit cmd_exit_of(const mjcf_error *error) {
  return error->no_memory ? TERM_INVALID : TERM_USAGE;
}

term_exit cmd_fail_model(const char *file, const mjcf_error *error) {
  return term_fail(cmd_exit_of(error), "%s: %s", file, error->text);
}
