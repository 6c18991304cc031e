// SPDX-License-Identifier: Apache-2.0
// bicycle sweep names: what the axes of a sweep may be called for a bicycle.
#include "cmd.h"

#include "terminal/command.h"
#include "terminal/data.h"
#include "terminal/json.h"

#include <bicycle/error.h>
#include <bicycle/parameters.h>
#include <string.h>
#include <unistd.h>

static const char example[] = "Example: bicycle sweep names roadster\n";

static const char documentation[] =
    "Lists the numbers of a bicycle's file by the names that the axes of a sweep have, with their "
    "values. Beside them any sweep knows speed, lean, steer, lean_rate, steer_rate, rider_offset, "
    "and property.trail, .head_angle, .wheel_inertia, .front_wheel_inertia, .steering_inertia, "
    ".rider_forward and .steer_damping.";

typedef struct arguments {
  const char *file;
  bool json;
} arguments;

enum { KEY_JSON = TERM_KEY_FIRST };

static error_t parse(int key, char *text, struct argp_state *state) {
  (void)text;
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->file;
    return 0;
  case KEY_JSON:
    args->json = true;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"json", KEY_JSON, NULL, 0, "Print one JSON document", 1},
    {0},
};

static void print_list(const bike_parameters *p) {
  for (int i = 0; i < bike_parameters_count(p); i++)
    printf("%-36s %.17g\n", bike_parameters_name(p, i), bike_parameters_value(p, i));
}

static term_exit print_json(const bike_parameters *p) {
  json_t *all = json_object();
  for (int i = 0; i < bike_parameters_count(p); i++)
    json_object_set_new(all, bike_parameters_name(p, i),
                        term_json_number(bike_parameters_value(p, i)));
  return term_json_write(all, stdout) ? TERM_DONE : term_fail_bike(BIKE_ERROR_MEMORY, "--json");
}

int cmd_names(int argc, char **argv) {
  const struct argp_child children[] = {{&term_file_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {0};
  term_parse(&argp, example, argc, argv, &args);
  char path[TERM_PATH_SIZE];
  bike_parameters *parameters;
  bike_file file;
  bike_file_error error;
  if (!term_bicycle_path(path, args.file)) return term_fail(TERM_USAGE, "the path is too long");
  const int code = bike_parameters_read(&parameters, &file, path, &error);
  if (code) return term_fail(term_exit_of(code), "%s", error.text);
  term_exit status = TERM_DONE;
  if (args.json)
    status = print_json(parameters);
  else
    print_list(parameters);
  bike_parameters_free(parameters);
  return status;
}
