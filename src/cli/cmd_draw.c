// SPDX-License-Identifier: Apache-2.0
// bicycle draw: the paper's figure 1 for any bicycle.
#include "commands.h"
#include "draw/drawing.h"
#include "terminal/command.h"
#include "terminal/data.h"

#include <bicycle/error.h>
#include <bicycle/output.h>

static const char example[] = "Example: bicycle draw benchmark -o benchmark.svg\n";

static const char documentation[] =
    "Draws the upright bicycle from its right side as SVG: wheels, steering axis, centres of mass, "
    "and the lengths of figure 1 of Franke, Suhr and Riess (1990). FILE is a bicycle file or the "
    "name of a shipped bicycle.";

typedef struct arguments {
  const char *file;
  const char *output; // NULL: the standard output
} arguments;

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->file;
    return 0;
  case 'o':
    args->output = text;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"output", 'o', "X.svg", 0, "Where to write the picture (standard output)", 1},
    {0},
};

static term_exit write_picture(const bike_bicycle *bicycle, const char *path) {
  bike_output output;
  bike_file_error error;
  int code = bike_output_begin(&output, path, &error);
  if (code != BIKE_OK) return term_fail(term_exit_of(code), "%s", error.text);
  code = draw_bicycle(bicycle, output.stream);
  if (code != BIKE_OK) {
    bike_output_abort(&output);
    return term_fail_bike(code, bicycle->name);
  }
  code = bike_output_commit(&output, &error);
  return code == BIKE_OK ? TERM_DONE : term_fail(term_exit_of(code), "%s", error.text);
}

int cmd_draw(int argc, char **argv) {
  const struct argp_child children[] = {{&term_file_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {0};
  term_parse(&argp, example, argc, argv, &args);
  bike_bicycle bicycle;
  term_exit code = term_load_bicycle(&bicycle, NULL, args.file);
  return code == TERM_DONE ? write_picture(&bicycle, args.output) : code;
}
