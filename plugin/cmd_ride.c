// SPDX-License-Identifier: Apache-2.0
// bicycle mujoco ride: the same rows as `bicycle ride`, from MuJoCo.
#include "cmd_ride.h"
#include "cmd_tally.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>

//---------------------------------- command line --------------------------------------------------

static const char example[] =
    "Example: bicycle mujoco ride roadster --speed 6 --lean-rate 0.2 --time 10 --sample 0.01 "
    "-o ride.csv\n"
    "         bicycle mujoco ride roadster.xml --time 10 --sample 0.01 --picture end.png\n";

static const char documentation[] =
    "Rides a bicycle in MuJoCo and writes the same rows as `bicycle ride`. FILE is a bicycle file, "
    "the name of a shipped bicycle, or a model (.xml, .mjb) with the bodies and joints that "
    "`bicycle mujoco mjcf` writes; a model starts from its keyframe 'test' unless a state is "
    "given. Any other model in which something rolls (libmujoco_rolling) rides in its own "
    "coordinates: rows of its joints, discs and sensors; what it asks of the ground is then looked "
    "at "
    "in rows. "
    "A step at which MuJoCo warns, resets its time or loses the rolling constraint ends the ride "
    "with exit status 3. Events are those of `bicycle ride`, but for the end of the model's "
    "validity: where its coordinates end MuJoCo's go on, and with them the ride. T and DT are "
    "multiples of the timestep. So should the times of --input be: RK4 loses its order in a step "
    "within which the input has a kink, and a line on stderr says when. A column rider_offset of a "
    "bicycle's input moves the rider, a driven joint then; in a model he moves if it was written "
    "with --moving-rider.";

enum { KEY_SENSORS = TERM_KEY_FIRST, KEY_PROJECT };

static const struct argp_option options[] = {
    {"sensors", KEY_SENSORS, NULL, 0, "Tell of the model's sensors: smallest, largest, at the end",
     7},
    {"project", KEY_PROJECT, NULL, 0,
     "Put the keyframe of a model that is no bicycle on the ground, rolling", 7},
    {0},
};

static error_t parse(int key, char *text, struct argp_state *state) {
  (void)text;
  cmd_ride_arguments *args = state->input;
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &args->ride;
    state->child_inputs[1] = &args->model;
    state->child_inputs[2] = &args->picture;
    return 0;
  case KEY_SENSORS:
    args->sensors = true;
    return 0;
  case KEY_PROJECT:
    args->project = true;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

// What a model file says itself cannot be said again.
static void check_model(cmd_ride_arguments *args) {
  const char *file = args->ride.start.file;
  args->is_model = term_ends_with(file, ".xml") || term_ends_with(file, ".mjb");
  args->has_start = cmd_has_start(&args->ride.start);
  if ((args->has_start || !args->is_model) && isnan(args->ride.start.state.speed))
    term_usage("--speed is missing");
  cmd_check_picture(&args->picture, args->ride.duration, args->ride.output);
  if (!args->is_model && args->project) term_usage("--project: %s is a bicycle", file);
  if (!args->is_model) return;
  if (args->model.has_root) term_usage("--root: %s has its own", file);
  if (args->model.has_rolling) term_usage("--rolling: %s has its own", file);
  if (args->ride.constant.rider_offset != 0)
    term_usage("--rider-offset: the rider of %s sits where he sits; give it to mjcf", file);
}

//---------------------------------- the ride ------------------------------------------------------

// All that one ride needs.
typedef struct rider {
  const cmd_ride_arguments *args;
  runner_ride_def def;
  runner *run;
  mjModel *look; // what a picture shows of a bicycle that rides unseen; NULL: the model that rides
  runner_any *any; // instead of `run`: a model that is no bicycle
  mjcf_error why;  // it is none
  term_ride ride;
  cmd_disc discs[2];  // rear, front
  term_limits limits; // those asked for, with the reach of the bicycle
  cmd_sensors sensors;
  cmd_shot shot;
} rider;

static void give_input(double time, bike_input *out, void *user) {
  rider *self = user;
  term_ride_input(time, out, &self->ride);
}

static int take_sample(const runner_sample *sample, void *user) {
  rider *self = user;
  for (int i = 0; i < 2; i++) cmd_disc_take(&self->discs[i], sample->slip[i], sample->height[i]);
  cmd_sensors_take(&self->sensors, runner_measured(self->run)->sensordata);
  cmd_shot_take(&self->shot, sample->row.time, runner_data(self->run)->qpos);
  return term_ride_take(&self->ride, &sample->row, &sample->more);
}

static double slip_of(const rider *self) {
  return fmax(self->discs[0].slip, self->discs[1].slip);
}

static double height_of(const rider *self) {
  return fmax(self->discs[0].height, self->discs[1].height);
}

// Keys of the JSON document beside those of `bicycle ride`.
static json_t *more_json(const rider *self, const runner_ride_result *result, double factor) {
  json_t *more = json_pack(
      "{s:o, s:o, s:o, s:I, s:o, s:o}", "slip", term_json_number(slip_of(self)), "height_error",
      term_json_number(height_of(self)), "timestep",
      term_json_number(runner_model(self->run)->opt.timestep), "steps", (json_int_t)result->steps,
      "real_time_factor", term_json_number(factor), "discs", cmd_discs_json(self->discs, 2));
  if (self->args->sensors) json_object_set_new(more, "sensors", cmd_sensors_json(&self->sensors));
  return more;
}

static void note_ground(rider *self, const runner_ride_result *result) {
  for (int i = 0; i < 2; i++) self->discs[i].ground = result->ground[i];
  for (int i = 0; i < result->event_count && i < BIKE_MAX_EVENTS; i++) {
    const bike_event *event = &result->events[i];
    if (event->kind == BIKE_EVENT_REAR_LIFT) cmd_disc_lift(&self->discs[0], event->time);
    if (event->kind == BIKE_EVENT_FRONT_LIFT) cmd_disc_lift(&self->discs[1], event->time);
  }
}

static term_exit ride(rider *self) {
  runner_ride_result result;
  mjcf_error error = {.text = ""};
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
           slip_of(self), height_of(self), factor);
  note_ground(self, &result);
  const term_ride_outcome outcome = {
      .bicycle = runner_model(self->run)->names, // the model's name comes first
      .end_time = result.end_time,
      .complete = result.complete,
      .end = status == RUNNER_OK ? &result.end : NULL,
      .event_count = result.event_count,
      .events = result.events,
      .ground = result.ground,
      .limits = self->limits,
      .error = whole ? NULL : error.text,
      .note = note,
      .more = more_json(self, &result, factor)};
  code = term_ride_end(&self->ride, &outcome, code);
  if (self->ride.record.count > 0 && code != TERM_USAGE) {
    cmd_discs_tell(self->discs, 2);
    cmd_sensors_tell(&self->sensors);
  }
  return cmd_shot_end(&self->shot, code);
}

//---------------------------------- preparation ---------------------------------------------------

void cmd_adjust_model(mjModel *model, const cmd_model *asked) {
  static const int integrators[] = {
      [MJCF_RK4] = mjINT_RK4, [MJCF_EULER] = mjINT_EULER, [MJCF_IMPLICIT] = mjINT_IMPLICIT};
  if (asked->has_timestep) model->opt.timestep = asked->options.timestep;
  if (asked->has_integrator) model->opt.integrator = integrators[asked->options.integrator];
}

static term_exit fail(const rider *self, runner_status status, const mjcf_error *error) {
  return term_fail((term_exit)runner_exit_code(status), "%s: %s", self->args->ride.start.file,
                   error->text);
}

// A bicycle or, where something else rolls, that.
static term_exit load_model(rider *self) {
  const char *file = self->args->ride.start.file;
  runner_status status;
  mjcf_error refusal = {.text = ""};
  self->run = runner_load(file, &status, &self->why);
  if (self->run) cmd_adjust_model(runner_model(self->run), &self->args->model);
  if (self->run || status != RUNNER_MODEL)
    return self->run ? TERM_DONE : fail(self, status, &self->why);
  self->any = runner_any_load(file, &status, &refusal);
  if (self->any) return TERM_DONE;
  // Where nothing is marked, a bicycle was meant.
  return fail(self, status, status == RUNNER_MODEL ? &self->why : &refusal);
}

static term_exit make_model(rider *self) {
  const cmd_ride_arguments *args = self->args;
  bike_bicycle bicycle;
  bike_model model;
  runner_status status;
  mjcf_error error = {.text = ""};
  double rider_offset = args->ride.constant.rider_offset;
  term_exit code = term_load_with_rider(&bicycle, &model, args->ride.start.file, rider_offset);
  if (code != TERM_DONE) return code;
  term_set_reach(&self->limits, &bicycle);
  mjcf_options made = args->model.options;
  made.rider_offset = rider_offset;
  made.moving_rider = self->ride.table && bike_input_table_has_rider(self->ride.table);
  self->run = runner_create(&bicycle, &made, &status, &error);
  if (!self->run) return fail(self, status, &error);
  if (args->picture.output) self->look = mjcf_model(&bicycle, &made, NULL, &error);
  if (!args->picture.output || self->look) return TERM_DONE;
  return cmd_fail_model(args->ride.start.file, &error);
}

static term_exit start(rider *self) {
  mjcf_error error = {.text = ""};
  if (self->args->project)
    return term_fail(TERM_USAGE, "--project: %s is a bicycle: --speed and the like place it",
                     self->args->ride.start.file);
  runner_status status = self->args->has_start
                             ? runner_start(self->run, &self->args->ride.start.state, &error)
                             : runner_start_at_keyframe(self->run, &error);
  return status == RUNNER_OK ? TERM_DONE : fail(self, status, &error);
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
  const term_ride_options *asked = &self->args->ride;
  mjcf_error refusal;
  self->def = (runner_ride_def){.duration = asked->duration,
                                .sample = asked->sample,
                                .lean_limit = asked->lean_limit,
                                .stop_at_lift = asked->stop_at_lift,
                                .friction_limit = asked->limits.friction,
                                .input = give_input,
                                .on_sample = take_sample,
                                .user = self};
  if (runner_check_ride(self->run, &self->def, &refusal) != RUNNER_OK)
    return term_fail(TERM_USAGE, "%s: %s", asked->start.file, refusal.text);
  if (self->args->sensors && !cmd_sensors_begin(&self->sensors, runner_model(self->run)))
    return term_fail_bike(BIKE_ERROR_MEMORY, asked->start.file);
  term_exit code = check_input(self);
  if (code != TERM_DONE) return code;
  return cmd_shot_begin(&self->shot, &self->args->picture,
                        self->look ? self->look : runner_model(self->run));
}

static void free_rider(rider *self) {
  cmd_shot_free(&self->shot);
  cmd_sensors_free(&self->sensors);
  term_ride_free(&self->ride);
  mj_deleteModel(self->look);
  runner_any_free(self->any);
  runner_free(self->run);
}

int cmd_ride(int argc, char **argv) {
  const struct argp_child children[] = {{&term_ride_argp, 0, NULL, 0},
                                        {&cmd_model_argp, 0, NULL, 0},
                                        {&cmd_picture_argp, 0, NULL, 0},
                                        {0}};
  const struct argp argp = {options, parse, "FILE", documentation, children, NULL, NULL};
  cmd_ride_arguments args = {
      .ride = {.start = cmd_no_start(), .lean_limit = runner_default_ride_def().lean_limit},
      .model = {.options = mjcf_default_options()},
      .picture = cmd_no_picture()};
  term_parse(&argp, example, argc, argv, &args);
  check_model(&args);

  rider self = {.args = &args, .discs = {{.name = "rear_wheel"}, {.name = "front_wheel"}}};
  self.limits = args.ride.limits;
  // The input says whether the model's rider must be able to move.
  term_exit code = term_ride_begin(&self.ride, &args.ride);
  if (code == TERM_DONE) code = args.is_model ? load_model(&self) : make_model(&self);
  if (code == TERM_DONE && self.any) {
    code = cmd_ride_any(self.any, &args, &self.ride, self.why.text);
  } else {
    if (code == TERM_DONE) code = start(&self);
    if (code == TERM_DONE) code = prepare(&self);
    if (code == TERM_DONE) code = ride(&self);
  }
  free_rider(&self);
  return code;
}
