// SPDX-License-Identifier: Apache-2.0
// bicycle mujoco ride: the same rows as `bicycle ride`, from MuJoCo.
#include "cmd_ride_options.h"

#include "cli/ride_record.h"
#include "terminal/data.h"

#include <bicycle/error.h>
#include <bicycle/input.h>
#include <bicycle/output.h>
#include <math.h>
#include <signal.h>
#include <unistd.h>

// All that one ride needs.
typedef struct rider {
  const cmd_ride_options *options;
  runner_ride_def def;
  runner *run;
  bike_input_table *table; // NULL: the input is constant
  bike_output output;
  ride_record record;
  double slip, height; // m/s, m: largest of both wheels so far
} rider;

// Set by SIGINT; looked at after every sample.
static volatile sig_atomic_t interrupted = 0;

static void note_interrupt(int signal_number) {
  (void)signal_number;
  interrupted = 1;
}

// The first interrupt ends the ride in good order, a second one at once.
static void catch_interrupt(void) {
  struct sigaction old;
  const struct sigaction action = {.sa_handler = note_interrupt, .sa_flags = (int)SA_RESETHAND};
  if (sigaction(SIGINT, NULL, &old) == 0 && old.sa_handler != SIG_IGN)
    sigaction(SIGINT, &action, NULL);
}

static void give_input(double time, bike_input *out, void *user) {
  const rider *self = user;
  if (self->table)
    bike_input_table_at(time, out, self->table);
  else
    *out = self->options->constant;
}

static int take_sample(const runner_sample *sample, void *user) {
  rider *self = user;
  ride_record_add(&self->record, &sample->row, &sample->more);
  for (int i = 0; i < 2; i++) {
    self->slip = fmax(self->slip, sample->slip[i]);
    self->height = fmax(self->height, fabs(sample->height[i]));
  }
  bool lost = self->output.stream && ferror(self->output.stream);
  return interrupted || lost;
}

//---------------------------------- reports -------------------------------------------------------

static const char *name_of(const rider *self) {
  return runner_model(self->run)->names; // the model's name comes first
}

// Simulated over elapsed time; 0 for a ride without a step.
static double real_time_factor(const runner_ride_result *result) {
  return result->wall_time > 0 ? result->end_time / result->wall_time : 0;
}

static json_t *events_json(const runner_ride_result *result) {
  json_t *array = json_array();
  for (int i = 0; i < result->event_count && i < BIKE_MAX_EVENTS; i++) {
    const bike_event *event = &result->events[i];
    json_array_append_new(array, json_pack("{s:o, s:s}", "time", term_json_number(event->time),
                                           "reason", bike_event_string(event->kind)));
  }
  return array;
}

static bool print_json(const rider *self, const runner_ride_result *result, const char *error) {
  const ride_record *record = &self->record;
  json_t *document = json_pack(
      "{s:s, s:s, s:o, s:b, s:I, s:o, s:o, s:{s:o, s:o, s:o}}", "bicycle", name_of(self),
      "convention", term_convention_name(record->convention), "end_time",
      term_json_number(result->end_time), "complete", result->complete, "rows",
      (json_int_t)record->count, "events", events_json(result), "end", ride_record_end(record),
      "energy", "start", term_json_number(record->start_energy), "work",
      term_json_number(record->work), "balance", term_json_number(record->balance));
  json_object_set_new(document, "slip", term_json_number(self->slip));
  json_object_set_new(document, "height_error", term_json_number(self->height));
  json_object_set_new(document, "timestep",
                      term_json_number(runner_model(self->run)->opt.timestep));
  json_object_set_new(document, "steps", json_integer(result->steps));
  json_object_set_new(document, "real_time_factor", term_json_number(real_time_factor(result)));
  if (error) json_object_set_new(document, "error", json_string(error));
  if (record->columns) json_object_set(document, "samples", record->columns);
  return term_json_write(document, stdout);
}

// Events and a summary on stderr.
static void tell(const rider *self, const runner_ride_result *result) {
  const ride_record *record = &self->record;
  for (int i = 0; i < result->event_count && i < BIKE_MAX_EVENTS; i++)
    term_message("%.9g s: %s", result->events[i].time, bike_event_string(result->events[i].kind));
  if (result->event_count > BIKE_MAX_EVENTS)
    term_message("and %d more events", result->event_count - BIKE_MAX_EVENTS);
  term_message(
      "%ld rows to %.9g s, convention %s, energy balance %.1e, slip %.1e m/s, height error "
      "%.1e m, %.0f times real time",
      record->count, result->end_time, term_convention_name(record->convention), record->balance,
      self->slip, self->height, real_time_factor(result));
}

//---------------------------------- the ride ------------------------------------------------------

// Ends the output: kept where rows mean something, also those before an accident.
static term_exit close_output(rider *self, term_exit code, bool keep) {
  bike_file_error error;
  if (!keep) {
    bike_output_abort(&self->output);
    return code;
  }
  if (self->output.stream && bike_output_commit(&self->output, &error) != BIKE_OK)
    return term_fail(TERM_USAGE, "%s", error.text);
  return code;
}

static term_exit ride(rider *self) {
  const cmd_ride_options *options = self->options;
  runner_ride_result result;
  mjcf_error error = {""};
  catch_interrupt();
  runner_status status = runner_ride(&result, self->run, &self->def, &error);
  term_progress_clear(&self->record.progress);
  if (interrupted) {
    close_output(self, TERM_INVALID, false);
    raise(SIGINT); // its action is the default again: the shell sees what happened
    return TERM_INVALID;
  }
  // A stream that takes no more rows is reported when it is committed.
  bool whole = status == RUNNER_OK || status == RUNNER_INTERRUPTED;
  term_exit code = whole ? TERM_DONE
                         : term_fail((term_exit)runner_exit_code(status), "%s: %s",
                                     options->start.file, error.text);
  bool keep = code != TERM_USAGE && self->record.count > 0;
  code = close_output(self, code, keep);
  if (!keep || code == TERM_USAGE) return code;
  tell(self, &result);
  if (options->show.json && !print_json(self, &result, whole ? NULL : error.text))
    return term_fail_bike(BIKE_ERROR_MEMORY, options->start.file);
  return code;
}

// The model, and in it what the command line may change.
static runner *make_runner(const cmd_ride_options *options, runner_status *status,
                           mjcf_error *error) {
  static const int integrators[] = {
      [MJCF_RK4] = mjINT_RK4, [MJCF_EULER] = mjINT_EULER, [MJCF_IMPLICIT] = mjINT_IMPLICIT};
  runner *r = runner_load(options->start.file, status, error);
  if (!r) return NULL;
  mjOption *opt = &runner_model(r)->opt;
  if (options->model.has_timestep) opt->timestep = options->model.options.timestep;
  if (options->model.has_integrator)
    opt->integrator = integrators[options->model.options.integrator];
  return r;
}

static term_exit load(rider *self) {
  const cmd_ride_options *options = self->options;
  const char *file = options->start.file;
  runner_status status;
  mjcf_error error = {""};
  if (options->is_model) {
    self->run = make_runner(options, &status, &error);
  } else {
    bike_bicycle bicycle;
    bike_model model;
    term_exit code = cli_load(&bicycle, &model, file, options->constant.rider_offset);
    if (code != TERM_DONE) return code;
    self->run = runner_create(&bicycle, &options->model.options, &status, &error);
  }
  if (self->run)
    status = options->has_start ? runner_start(self->run, &options->start.state, &error)
                                : runner_start_at_keyframe(self->run, &error);
  if (status == RUNNER_OK) return TERM_DONE;
  return term_fail((term_exit)runner_exit_code(status), "%s: %s", file, error.text);
}

// Reads the inputs over time, refuses what cannot be ridden, and finds where rows go.
static term_exit prepare(rider *self) {
  const cmd_ride_options *options = self->options;
  bike_file_error error;
  mjcf_error refusal;
  int code = BIKE_OK;
  self->def = options->def;
  self->def.input = give_input;
  self->def.on_sample = take_sample;
  self->def.user = self;
  if (runner_check_ride(self->run, &self->def, &refusal) != RUNNER_OK)
    return term_fail(TERM_USAGE, "%s: %s", options->start.file, refusal.text);
  if (options->input_file)
    code =
        bike_input_table_create(&self->table, options->input_file, options->def.duration, &error);
  bool wants_rows = options->output || !options->show.json;
  if (self->table && bike_input_table_has_rider(self->table))
    return term_fail(TERM_USAGE, "%s: rider_offset: %s", options->input_file,
                     runner_status_string(RUNNER_UNSUPPORTED));
  if (code == BIKE_OK && wants_rows)
    code = bike_output_begin(&self->output, options->output, &error);
  if (code != BIKE_OK) return term_fail(term_exit_of(code), "%s", error.text);
  self->record = (ride_record){.rows = self->output.stream,
                               .convention = options->show.convention,
                               .duration = options->def.duration,
                               .shows_progress = options->output || !isatty(STDOUT_FILENO)};
  ride_record_begin(&self->record, !wants_rows);
  return TERM_DONE;
}

static void finish(rider *self) {
  bike_output_abort(&self->output);
  bike_input_table_free(self->table);
  ride_record_free(&self->record);
  runner_free(self->run);
}

int cmd_ride(int argc, char **argv) {
  const cmd_ride_options options = cmd_parse_ride(argc, argv);
  rider self = {.options = &options};
  term_exit code = load(&self);
  if (code == TERM_DONE) code = prepare(&self);
  if (code == TERM_DONE) code = ride(&self);
  finish(&self);
  return code;
}
