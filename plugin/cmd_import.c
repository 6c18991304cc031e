// SPDX-License-Identifier: Apache-2.0
// bicycle mujoco import: a bicycle file from anybody's MuJoCo model of a bicycle.
#include "bicycle_import.h"
#include "cmd.h"

#include "terminal/message.h"

#include <bicycle/error.h>
#include <bicycle/output.h>

static const char example[] = "Example: bicycle mujoco import mine.xml -o mine.yml\n"
                              "         bicycle ride mine.yml --speed 5 --time 10 --sample 0.01\n";

static const char documentation[] =
    "Reads the bicycle out of a MuJoCo model (.xml or .mjb): two wheels on hinges, a steering "
    "hinge between what they are on, and a root with six freedoms, whatever their names and axes. "
    "Writes it as a bicycle file, rigid parts lumped. The model must be unsteered at qpos 0.";

typedef struct arguments {
  const char *model, *output; // output NULL: the standard output
} arguments;

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case 'o':
    args->output = text;
    return 0;
  case ARGP_KEY_ARG:
    if (args->model) term_usage("'%s' is one argument too many", text);
    args->model = text;
    return 0;
  case ARGP_KEY_END:
    if (!args->model) term_usage("a model file is missing");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"output", 'o', "Y.yml", 0, "Where to write the bicycle (the standard output)", 1},
    {0},
};

// A double-quoted scalar; control characters have no place in a name.
static void put_quoted(FILE *out, const char *text) {
  fputc('"', out);
  for (; *text; text++) {
    if (*text == '"' || *text == '\\') fputc('\\', out);
    fputc((unsigned char)*text < ' ' ? '?' : *text, out);
  }
  fputc('"', out);
}

static void put_list(FILE *out, const double *numbers, int count) {
  for (int i = 0; i < count; i++) fprintf(out, "%s%.17g", i ? ", " : "[", numbers[i] + 0.0);
  fputc(']', out);
}

static void put_part(FILE *out, const bike_part *part) {
  static const char *const assemblies[] = {"rear", "rear_wheel", "front", "front_wheel"};
  bool wheel = part->assembly == BIKE_REAR_WHEEL || part->assembly == BIKE_FRONT_WHEEL;
  fputs("  - name: ", out);
  put_quoted(out, part->name);
  fprintf(out, "\n    assembly: %s\n    mass: %.17g\n", assemblies[part->assembly], part->mass);
  if (!wheel) { // whose place is its hub
    fputs("    position: ", out);
    put_list(out, part->position, 3);
    fputc('\n', out);
  }
  fputs("    inertia: {full: ", out);
  put_list(out, part->inertia, 6);
  fputs("}\n", out);
}

static void put_bicycle(FILE *out, const bike_bicycle *b) {
  const bike_geometry *g = &b->geometry;
  fputs("# Made by `bicycle mujoco import`. SI and radians; positions are [forward of the rear\n"
        "# contact, left, up] of the upright bicycle; inertias about each part's centre of mass.\n"
        "parameterization: components\nname: ",
        out);
  put_quoted(out, b->name);
  fprintf(out, "\ng: %.17g\nsteer_damping: %.17g\n", b->gravity, b->steer_damping);
  fprintf(out,
          "geometry: {L_r: %.17g, L_f: %.17g, L_s: %.17g, R_r: %.17g, R_f: %.17g}\n"
          "parts:\n",
          g->L_r, g->L_f, g->L_s, g->R_r, g->R_f);
  for (int i = 0; i < b->part_count; i++) put_part(out, &b->parts[i]);
}

static term_exit write_bicycle(const bike_bicycle *bicycle, const char *path) {
  bike_output out;
  bike_file_error error;
  int code = bike_output_begin(&out, path, &error);
  if (code == BIKE_OK) {
    put_bicycle(out.stream, bicycle);
    code = bike_output_commit(&out, &error);
  }
  bike_output_abort(&out);
  return code == BIKE_OK ? TERM_DONE : term_fail(TERM_USAGE, "%s", error.text);
}

int cmd_import(int argc, char **argv) {
  const struct argp argp = {options, parse, "MODEL", documentation, NULL, NULL, NULL};
  arguments args = {0};
  bike_bicycle bicycle;
  mjcf_error error = {""};
  term_parse(&argp, example, argc, argv, &args);
  mjModel *model = mjcf_load(args.model, &error);
  bool found = model && import_bicycle(&bicycle, NULL, model, &error);
  if (model) mj_deleteModel(model);
  if (!found) return term_fail(TERM_USAGE, "%s: %s", args.model, error.text);
  return write_bicycle(&bicycle, args.output);
}
