// SPDX-License-Identifier: Apache-2.0
// bicycle mujoco ride: the same rows as `bicycle ride`, from MuJoCo.
#include "cmd.h"
#include "runner.h"

#include "terminal/ride.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

//---------------------------------- command line --------------------------------------------------

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
    "with exit status 3. Events are those of `bicycle ride`, but for the end of the model's "
    "validity: "
    "where its coordinates end MuJoCo's go on, and with them the ride. T and DT are multiples of "
    "the timestep. So should the times of --input "
    "be: RK4 loses its order in a step within which the input has a kink, and a line on stderr "
    "says when. A column rider_offset of a bicycle's input moves the rider, a driven joint then; "
    "in a "
    "model he moves if it was written with --moving-rider.";

typedef struct arguments {
  term_ride_options ride;
  cmd_model model;
  bool has_start; // a state was given; a model file may have its own
  bool is_model;  // FILE is .xml or .mjb
} arguments;

static error_t parse(int key, char *text, struct argp_state *state) {
  (void)text;
  arguments *args = state->input;
  if (key != ARGP_KEY_INIT) return ARGP_ERR_UNKNOWN;
  state->child_inputs[0] = &args->ride;
  state->child_inputs[1] = &args->model;
  return 0;
}

// What a model file says itself cannot be said again.
static void check_model(arguments *args) {
  const char *file = args->ride.start.file;
  args->is_model = term_ends_with(file, ".xml") || term_ends_with(file, ".mjb");
  args->has_start = cmd_has_start(&args->ride.start);
  if ((args->has_start || !args->is_model) && isnan(args->ride.start.state.speed))
    term_usage("--speed is missing");
  if (!args->is_model) return;
  if (args->model.has_root) term_usage("--root: %s has its own", file);
  if (args->model.has_rolling) term_usage("--rolling: %s has its own", file);
  if (args->ride.constant.rider_offset != 0)
    term_usage("--rider-offset: the rider of %s sits where he sits; give it to mjcf", file);
}

//---------------------------------- the ride ------------------------------------------------------

// All that one ride needs.
typedef struct rider {
  const arguments *args;
  runner_ride_def def;
  runner *run;
  term_ride ride;
  double slip, height; // m/s, m: largest of both wheels so far
} rider;

static void give_input(double time, bike_input *out, void *user) {
  rider *self = user;
  term_ride_input(time, out, &self->ride);
}

static int take_sample(const runner_sample *sample, void *user) {
  rider *self = user;
  for (int i = 0; i < 2; i++) {
    self->slip = fmax(self->slip, sample->slip[i]);
    self->height = fmax(self->height, fabs(sample->height[i]));
  }
  return term_ride_take(&self->ride, &sample->row, &sample->more);
}

// Keys of the JSON document beside those of `bicycle ride`.
static json_t *more_json(const rider *self, const runner_ride_result *result, double factor) {
  return json_pack("{s:o, s:o, s:o, s:I, s:o}", "slip", term_json_number(self->slip),
                   "height_error", term_json_number(self->height), "timestep",
                   term_json_number(runner_model(self->run)->opt.timestep), "steps",
                   (json_int_t)result->steps, "real_time_factor", term_json_number(factor));
}

static term_exit ride(rider *self) {
  runner_ride_result result;
  mjcf_error error = {""};
  runner_status status = runner_ride(&result, self->run, &self->def, &error);
  term_ride_stop(&self->ride);
  // A stream that takes no more rows is reported when it is committed.
  bool whole = status == RUNNER_OK || status == RUNNER_INTERRUPTED;
  term_exit code = whole ? TERM_DONE
                         : term_fail((term_exit)runner_exit_code(status), "%s: %s",
                                     self->args->ride.start.file, error.text);
  // Simulated over elapsed time; 0 for a ride without a step.
  double factor = result.wall_time > 0 ? result.end_time / result.wall_time : 0;
  char note[128];
  snprintf(note, sizeof note, ", slip %.1e m/s, height error %.1e m, %.0f times real time",
           self->slip, self->height, factor);
  const term_ride_outcome outcome = {
      .bicycle = runner_model(self->run)->names, // the model's name comes first
      .end_time = result.end_time,
      .complete = result.complete,
      .end = status == RUNNER_OK ? &result.end : NULL,
      .event_count = result.event_count,
      .events = result.events,
      .error = whole ? NULL : error.text,
      .note = note,
      .more = more_json(self, &result, factor)};
  return term_ride_end(&self->ride, &outcome, code);
}

//---------------------------------- preparation ---------------------------------------------------

// The model, and in it what the command line may change.
static runner *load_model(const arguments *args, runner_status *status, mjcf_error *error) {
  static const int integrators[] = {
      [MJCF_RK4] = mjINT_RK4, [MJCF_EULER] = mjINT_EULER, [MJCF_IMPLICIT] = mjINT_IMPLICIT};
  runner *r = runner_load(args->ride.start.file, status, error);
  if (!r) return NULL;
  mjOption *opt = &runner_model(r)->opt;
  if (args->model.has_timestep) opt->timestep = args->model.options.timestep;
  if (args->model.has_integrator) opt->integrator = integrators[args->model.options.integrator];
  return r;
}

static term_exit load(rider *self) {
  const arguments *args = self->args;
  const char *file = args->ride.start.file;
  runner_status status;
  mjcf_error error = {""};
  if (args->is_model) {
    self->run = load_model(args, &status, &error);
  } else {
    bike_bicycle bicycle;
    bike_model model;
    double rider_offset = args->ride.constant.rider_offset;
    term_exit code = term_load_with_rider(&bicycle, &model, file, rider_offset);
    if (code != TERM_DONE) return code;
    mjcf_options options = args->model.options;
    options.rider_offset = rider_offset;
    options.moving_rider = self->ride.table && bike_input_table_has_rider(self->ride.table);
    self->run = runner_create(&bicycle, &options, &status, &error);
  }
  if (self->run)
    status = args->has_start ? runner_start(self->run, &args->ride.start.state, &error)
                             : runner_start_at_keyframe(self->run, &error);
  if (status == RUNNER_OK) return TERM_DONE;
  return term_fail((term_exit)runner_exit_code(status), "%s: %s", file, error.text);
}

// How many rows of the input fall within a step of the ride.
static size_t count_kinks(const rider *self) {
  // Within a millionth of a step a time is that of the step to the rounding of decimals: such a
  // kink is as good as on it.
  static const double tolerance = 1e-6;
  double step = runner_model(self->run)->opt.timestep;
  size_t rows, kinks = 0;
  const double *time = bike_input_table_times(self->ride.table, &rows);
  for (size_t i = 0; i < rows; i++) {
    double steps = time[i] / step;
    if (time[i] > 0 && time[i] < self->def.duration && fabs(steps - round(steps)) > tolerance)
      kinks++;
  }
  return kinks;
}

// Refuses what the MuJoCo bicycle cannot do, and tells of what it does less well.
static term_exit check_input(const rider *self) {
  const bike_input_table *table = self->ride.table;
  const char *file = self->args->ride.input_file;
  if (!table) return TERM_DONE;
  if (bike_input_table_has_rider(table) && !runner_rider_moves(self->run))
    return term_fail(TERM_USAGE, "%s: rider_offset: %s", file,
                     runner_status_string(RUNNER_UNSUPPORTED));
  size_t kinks = runner_model(self->run)->opt.integrator == mjINT_RK4 ? count_kinks(self) : 0;
  if (kinks > 0)
    term_message("%s: time: RK4 loses its order where rows lie within a timestep: %zu do", file,
                 kinks);
  return TERM_DONE;
}

static term_exit prepare(rider *self) {
  const term_ride_options *options = &self->args->ride;
  mjcf_error refusal;
  self->def = (runner_ride_def){.duration = options->duration,
                                .sample = options->sample,
                                .lean_limit = options->lean_limit,
                                .stop_at_lift = options->stop_at_lift,
                                .input = give_input,
                                .on_sample = take_sample,
                                .user = self};
  if (runner_check_ride(self->run, &self->def, &refusal) != RUNNER_OK)
    return term_fail(TERM_USAGE, "%s: %s", options->start.file, refusal.text);
  return check_input(self);
}

int cmd_ride(int argc, char **argv) {
  const struct argp_child children[] = {
      {&term_ride_argp, 0, NULL, 0}, {&cmd_model_argp, 0, NULL, 0}, {0}};
  const struct argp argp = {NULL, parse, "FILE", documentation, children, NULL, NULL};
  arguments args = {
      .ride = {.start = cmd_no_start(), .lean_limit = runner_default_ride_def().lean_limit},
      .model = {.options = mjcf_default_options()}};
  term_parse(&argp, example, argc, argv, &args);
  check_model(&args);

  rider self = {.args = &args};
  // The input says whether the model's rider must be able to move.
  term_exit code = term_ride_begin(&self.ride, &args.ride);
  if (code == TERM_DONE) code = load(&self);
  if (code == TERM_DONE) code = prepare(&self);
  if (code == TERM_DONE) code = ride(&self);
  term_ride_free(&self.ride);
  runner_free(self.run);
  return code;
}
