// SPDX-License-Identifier: Apache-2.0
// bicycle mujoco import: a bicycle file from anybody's MuJoCo model of a bicycle.
#include "bicycle_import.h"
#include "cmd.h"

#include "terminal/message.h"

#include <bicycle/error.h>
#include <bicycle/output.h>
#include <math.h>

static const char example[] = "Example: bicycle mujoco import mine.xml -o mine.yml\n"
                              "         bicycle ride mine.yml --speed 5 --time 10 --sample 0.01\n";

static const char documentation[] =
    "Reads the bicycle out of a MuJoCo model (.xml or .mjb): two wheels on hinges, a steering "
    "hinge between what they are on, and a root with six freedoms, whatever their names and axes. "
    "Writes it as a bicycle file, rigid parts lumped, and says on stderr how it was understood: "
    "the "
    "direction of travel, the steer, where the radii are from. The model must be unsteered at qpos "
    "0. "
    "What acts on it and is not in the equations (springs, servos, wind, flags) is refused by "
    "name; "
    "a tuple 'rolling_discs' of the model says which radii are meant.";

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
  return code == BIKE_OK ? TERM_DONE : term_fail(term_exit_of(code), "%s", error.text);
}

//---------------------------------- how it was understood -----------------------------------------

// The heading at qpos 0, where the bicycle may be pitched.
static void tell_travel(const import_map *map) {
  double x = map->travel[0], y = map->travel[1], length = hypot(x, y);
  if (fabs(x) > (1 - 1e-9) * length || fabs(y) > (1 - 1e-9) * length)
    term_message("travels along %s",
                 fabs(x) > fabs(y) ? (x > 0 ? "+x" : "-x") : (y > 0 ? "+y" : "-y"));
  else
    term_message("travels along (%.4g, %.4g, 0)", x / length, y / length);
}

static void tell_wheel(const mjModel *m, const import_map *map, int wheel) {
  static const char *const names[] = {"rear", "front"};
  char body[64], geom[64], place[64] = "";
  double clearance = map->clearance[wheel];
  bool from_geom = map->source[wheel] == IMPORT_GEOM;
  const char *source = map->source[wheel] == IMPORT_MARKER ? "the marker rolling_discs"
                       : from_geom                         ? "geom "
                                   : "the height of its hub above the ground";
  if (from_geom) import_name(geom, m->names + m->name_geomadr[map->geom[wheel]], map->geom[wheel]);
  if (fabs(clearance) > 1e-6)
    snprintf(place, sizeof place, "; at qpos 0 it is %.4g m %s the ground", fabs(clearance),
             clearance > 0 ? "above" : "below");
  term_message("%s wheel %s: radius %.6g m, from %s%s%s", names[wheel],
               import_body_name(body, m, map->wheel[wheel]), map->radius[wheel], source,
               from_geom ? geom : "", place);
}

static void tell(const mjModel *m, const import_map *map, const bike_bicycle *bicycle) {
  bike_upright upright;
  char stops[400], name[64];
  tell_travel(map);
  term_message("steer: joint %s, positive to the %s", import_joint_name(name, m, map->steer),
               map->steer_sign > 0 ? "left" : "right");
  for (int i = 0; i < IMPORT_WHEELS; i++) tell_wheel(m, map, i);
  if (bike_upright_position(&upright, &bicycle->geometry) == BIKE_OK)
    term_message("wheelbase %.6g m, trail %.6g m, head angle %.6g deg", upright.wheelbase,
                 upright.trail, 90 - upright.tilt * 180 / M_PI);
  if (import_stops(stops, sizeof stops, m))
    term_message("stops, which the bicycle file does not have: %s", stops);
}

int cmd_import(int argc, char **argv) {
  const struct argp argp = {options, parse, "MODEL", documentation, NULL, NULL, NULL};
  arguments args = {0};
  bike_bicycle bicycle;
  mjcf_error error = {.text = ""};
  term_parse(&argp, example, argc, argv, &args);
  import_map map;
  mjModel *model = mjcf_load(args.model, &error);
  bool found = model && import_bicycle(&bicycle, &map, model, &error);
  term_exit code =
      found ? write_bicycle(&bicycle, args.output) : cmd_fail_model(args.model, &error);
  if (code == TERM_DONE) tell(model, &map, &bicycle);
  if (model) mj_deleteModel(model);
  return code;
}
