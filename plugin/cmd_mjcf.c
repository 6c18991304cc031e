// SPDX-License-Identifier: Apache-2.0
// bicycle mujoco mjcf: a bicycle as a MuJoCo model, ready to be ridden in any program that loads
// libmujoco_rolling.so.
#include "cmd.h"
#include "runner.h"

#include "files/memory_stream.h"
#include "terminal/data.h"

#include <bicycle/error.h>
#include <bicycle/output.h>
#include <bicycle/stability.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

static const char example[] =
    "Example: bicycle mujoco mjcf roadster -o roadster.xml\n"
    "         bicycle mujoco mjcf roadster -o roadster/\n"
    "         LD_PRELOAD=libmujoco_rolling.so mujoco-simulate roadster.xml\n";

static const char documentation[] =
    "Writes a bicycle as a MuJoCo 2.2 model: MJCF (.xml), or compiled (.mjb), which holds also "
    "what MJCF refuses. A name with a slash at its end becomes a folder in the manner of MuJoCo "
    "Menagerie: NAME.xml with default classes, motor and sensors, scene.xml, which includes it, "
    "README.md, the bicycle file and a picture; a folder that holds anything else is not replaced. "
    "The keyframe 'test' is a start that rolls; without a speed one is chosen at which the bicycle "
    "is stable, if there is one. FILE is a bicycle file or the name of a shipped bicycle.";

typedef struct arguments {
  term_start start;
  cmd_model model;
  const char *output; // NULL: the standard output
  bool no_picture;    //
} arguments;

enum { KEY_RIDER_OFFSET = TERM_KEY_FIRST, KEY_MOVING_RIDER, KEY_NO_PICTURE };

static error_t parse(int key, char *text, struct argp_state *state) {
  arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->start;
    state->child_inputs[1] = &args->model;
    return 0;
  case KEY_RIDER_OFFSET:
    args->model.options.rider_offset = term_number_of("--rider-offset", text);
    return 0;
  case KEY_MOVING_RIDER:
    args->model.options.moving_rider = true;
    return 0;
  case KEY_NO_PICTURE:
    args->no_picture = true;
    return 0;
  case 'o':
    args->output = text;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp_option options[] = {
    {"output", 'o', "X.xml|X.mjb|X/", 0, "Where to write the model (MJCF on the standard output)",
     2},
    {"no-picture", KEY_NO_PICTURE, NULL, 0, "A folder without the picture, which needs OSMesa", 2},
    {"rider-offset", KEY_RIDER_OFFSET, "W", 0, "Rider to the right of the file's place, m", 3},
    {"moving-rider", KEY_MOVING_RIDER, NULL, 0,
     "The rider on a slide, a driven joint that follows userdata", 3},
    {0},
};

// A state to start from that shows what the bicycle can do: a small push at a speed at which it
// rights itself.
static bike_state lively_state(const bike_model *model) {
  bike_state state = {.lean_rate = 0.1, .speed = 5};
  bike_critical_speeds critical;
  if (bike_upright_critical_speeds(&critical, model, 0, bike_search_end(model)) == BIKE_OK &&
      critical.range_count > 0) {
    // In the middle of the first stable range, or 1 m/s into a wide one.
    const double *range = critical.ranges[0];
    state.speed = range[0] + fmin((range[1] - range[0]) / 2, 1);
  }
  return state;
}

// The keyframe: qpos and qvel of a state, found by the runner.
static term_exit find_key(mjcf_key *key, const bike_bicycle *bicycle, const mjcf_options *made,
                          const bike_state *state, const char *file) {
  runner_status status;
  mjcf_error error = {.text = ""};
  runner *r = runner_create(bicycle, made, &status, &error);
  if (r) status = runner_start(r, state, &error);
  if (status == RUNNER_OK) {
    mju_copy(key->qpos, runner_data(r)->qpos, runner_model(r)->nq);
    mju_copy(key->qvel, runner_data(r)->qvel, runner_model(r)->nv);
  }
  runner_free(r);
  if (status == RUNNER_OK) return TERM_DONE;
  return term_fail((term_exit)runner_exit_code(status), "%s: %s", file, error.text);
}

static term_exit write_bytes(const char *path, const void *bytes, size_t size) {
  bike_output out;
  bike_file_error error;
  int code = bike_output_begin(&out, path, &error);
  if (code == BIKE_OK) {
    fwrite(bytes, 1, size, out.stream); // an error stays in the stream, and commit finds it
    code = bike_output_commit(&out, &error);
  }
  bike_output_abort(&out);
  return code == BIKE_OK ? TERM_DONE : term_fail(term_exit_of(code), "%s", error.text);
}

// mj_sizeModel is some kB more than mj_saveModel writes, and mj_loadModel refuses the difference:
// the size is that of a file in memory.
static term_exit write_binary(const mjModel *model, const char *path) {
  char name[40];
  struct stat about;
  int file = memfd_create("model", 0);
  snprintf(name, sizeof name, "/proc/self/fd/%d", file);
  if (file >= 0) mj_saveModel(model, name, NULL, 0);
  bool saved = file >= 0 && fstat(file, &about) == 0 && about.st_size > 0;
  size_t size = saved ? (size_t)about.st_size : 0;
  void *bytes = saved ? mmap(NULL, size, PROT_READ, MAP_PRIVATE, file, 0) : MAP_FAILED;
  term_exit code = bytes == MAP_FAILED ? term_fail_bike(BIKE_ERROR_MEMORY, path)
                                       : write_bytes(path, bytes, size);
  if (bytes != MAP_FAILED) munmap(bytes, size);
  if (file >= 0) close(file);
  return code;
}

static void tell_of_placeholders(const bike_bicycle *bicycle, const mjcf_options *made,
                                 const char *where) {
  int count = mjcf_placeholder_count(bicycle, made);
  if (count == 0) return;
  term_message("%s: MJCF refuses the inertia of %d %s; other programs see a placeholder, ours the "
               "exact tensor, as does any program in an .mjb file",
               where, count, count == 1 ? "body" : "bodies");
}

static term_exit write_model(const arguments *args, const bike_bicycle *bicycle,
                             const mjcf_key *key) {
  bool binary = args->output && term_ends_with(args->output, ".mjb");
  mjcf_error error = {.text = ""};
  char *text = mjcf_text(bicycle, &args->model.options, key, &error);
  // Compiled also where only the text is asked for: no file leaves here that MuJoCo would refuse.
  mjModel *model = text ? mjcf_compile(text, &error) : NULL;
  term_exit code;
  if (!model)
    code = cmd_fail_model(args->start.file, &error);
  else if (binary)
    code = write_binary(model, args->output);
  else
    code = write_bytes(args->output, text, strlen(text));
  if (code == TERM_DONE && !binary)
    tell_of_placeholders(bicycle, &args->model.options,
                         args->output ? args->output : args->start.file);
  mj_deleteModel(model);
  free(text);
  return code;
}

static bool is_folder(const arguments *args) {
  return args->output && term_ends_with(args->output, "/");
}

static void check(const arguments *args) {
  const char *output = args->output;
  if (args->no_picture && !is_folder(args)) term_usage("--no-picture: only a folder has one");
  if (!output || strcmp(output, "-") == 0 || is_folder(args)) return;
  if (!term_ends_with(output, ".xml") && !term_ends_with(output, ".mjb"))
    term_usage("--output: '%s' ends neither in .xml nor in .mjb, nor is it a folder (X/)", output);
}

// The command line in one line; NULL without memory.
static char *join(int argc, char **argv) {
  char *text = NULL;
  size_t size = 0;
  FILE *out = bike_memory_stream(&text, &size);
  for (int i = 0; out && i < argc; i++) fprintf(out, "%s%s", i ? " " : "", argv[i]);
  return out && fclose(out) == 0 ? text : NULL;
}

static term_exit write_set(const arguments *args, const bike_bicycle *bicycle, const mjcf_key *key,
                           const bike_state *start, const char *command) {
  const cmd_set set = {.output = args->output,
                       .file = args->start.file,
                       .bicycle = bicycle,
                       .options = &args->model.options,
                       .key = key,
                       .start = start,
                       .command = command,
                       .no_picture = args->no_picture};
  term_exit code = cmd_write_set(&set);
  if (code == TERM_DONE) tell_of_placeholders(bicycle, &args->model.options, args->output);
  return code;
}

static term_exit make(arguments *args, const char *command) {
  bool given = cmd_has_start(&args->start);
  if (given && isnan(args->start.state.speed)) term_usage("--speed is missing");
  bike_bicycle bicycle;
  bike_model model;
  term_exit code = term_load_bicycle(&bicycle, &model, args->start.file);
  if (code != TERM_DONE) return code;
  mjcf_key key;
  bike_state state = given ? args->start.state : lively_state(&model);
  code = find_key(&key, &bicycle, &args->model.options, &state, args->start.file);
  if (code != TERM_DONE) return code;
  return is_folder(args) ? write_set(args, &bicycle, &key, &state, command)
                         : write_model(args, &bicycle, &key);
}

int cmd_mjcf(int argc, char **argv) {
  const struct argp_child children[] = {
      {&term_start_argp, 0, NULL, 0}, {&cmd_model_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {.start = cmd_no_start(), .model = {.options = mjcf_default_options()}};
  char *command = join(argc, argv); // before argp puts it into another order
  term_parse(&argp, example, argc, argv, &args);
  check(&args);
  term_exit code =
      command ? make(&args, command) : term_fail_bike(BIKE_ERROR_MEMORY, args.start.file);
  free(command);
  return code;
}
