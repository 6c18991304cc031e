// SPDX-License-Identifier: Apache-2.0
// bicycle ride: the equations integrated in time.
#include "commands.h"
#include "ride_options.h"
#include "ride_record.h"
#include "terminal/data.h"

#include <bicycle/error.h>
#include <bicycle/input.h>
#include <bicycle/output.h>
#include <bicycle/ride.h>
#include <math.h>
#include <signal.h>
#include <unistd.h>

// All that one ride needs.
typedef struct rider {
  const ride_options *options;
  bike_bicycle bicycle;
  bike_model model;
  bike_input_table *table; // NULL: the input is constant
  bike_output output;
  ride_record record;
} rider;

// Set by SIGINT; looked at after every sample.
static volatile sig_atomic_t interrupted = 0;

static void note_interrupt(int signal_number) {
  (void)signal_number;
  interrupted = 1;
}

// The first interrupt ends the ride in good order, a second one at once. Where interrupts are
// ignored (a job in the background) they stay so.
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

static int take_sample(const bike_sample *sample, const bike_sample_more *more, void *user) {
  rider *self = user;
  ride_record_add(&self->record, sample, more);
  bool lost = self->output.stream && ferror(self->output.stream);
  return interrupted || lost;
}

static json_t *events_json(const bike_ride_result *result) {
  json_t *array = json_array();
  for (int i = 0; i < result->event_count && i < BIKE_MAX_EVENTS; i++) {
    const bike_event *event = &result->events[i];
    json_array_append_new(array, json_pack("{s:o, s:s}", "time", term_json_number(event->time),
                                           "reason", bike_event_string(event->kind)));
  }
  return array;
}

static bool print_json(const rider *self, const bike_ride_result *result, int error) {
  const ride_record *record = &self->record;
  json_t *document = json_pack(
      "{s:s, s:s, s:o, s:b, s:I, s:o, s:o, s:{s:o, s:o, s:o}, s:I, s:I}", "bicycle",
      self->bicycle.name, "convention", term_convention_name(record->convention), "end_time",
      term_json_number(result->end_time), "complete", result->complete, "rows",
      (json_int_t)record->count, "events", events_json(result), "end", ride_record_end(record),
      "energy", "start", term_json_number(record->start_energy), "work",
      term_json_number(record->work), "balance", term_json_number(record->balance), "evaluations",
      (json_int_t)result->evaluations, "steps", (json_int_t)result->steps);
  if (error != BIKE_OK)
    json_object_set_new(document, "error", json_string(bike_error_string(error)));
  if (record->columns) json_object_set(document, "samples", record->columns);
  return term_json_write(document, stdout);
}

// Events and a summary on stderr.
static void tell(const rider *self, const bike_ride_result *result) {
  const ride_record *record = &self->record;
  for (int i = 0; i < result->event_count && i < BIKE_MAX_EVENTS; i++)
    term_message("%.9g s: %s", result->events[i].time, bike_event_string(result->events[i].kind));
  if (result->event_count > BIKE_MAX_EVENTS)
    term_message("and %d more events", result->event_count - BIKE_MAX_EVENTS);
  term_message("%ld rows to %.9g s, convention %s, energy balance %.1e", record->count,
               result->end_time, term_convention_name(record->convention), record->balance);
}

static term_exit fail_ride(const rider *self, int error, double time) {
  if (error == BIKE_ERROR_ARGUMENT)
    return term_fail(TERM_USAGE, "a number is outside its range: 0 < sample <= time <= 1e9 sample, "
                                 "the step divides the sample, rtol >= 9e-16");
  if (self->record.count == 0) return term_fail_bike(error, self->options->start.file);
  return term_fail(term_exit_of(error), "%s at %.9g s: %s", self->options->start.file, time,
                   bike_error_string(error));
}

// Ends the output: kept where rows mean something, also those before a failure of the solver.
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
  bike_ride_def def = self->options->def;
  bike_ride_result result = {0};
  def.input = give_input;
  def.on_sample = take_sample;
  def.user = self;
  if (self->table) def.breakpoints = bike_input_table_times(self->table, &def.breakpoint_count);
  catch_interrupt();
  int error = bike_ride(&result, &self->model, &def);
  term_progress_clear(&self->record.progress);
  if (interrupted) {
    close_output(self, TERM_INVALID, false);
    raise(SIGINT); // its action is the default again: the shell sees what happened
    return TERM_INVALID;
  }
  term_exit code = error == BIKE_OK || error == BIKE_ERROR_INTERRUPTED
                       ? TERM_DONE
                       : fail_ride(self, error, result.end_time);
  bool keep = code != TERM_USAGE && self->record.count > 0;
  code = close_output(self, code, keep);
  if (!keep || code == TERM_USAGE) return code;
  tell(self, &result);
  if (self->options->show.json && !print_json(self, &result, error))
    return term_fail_bike(BIKE_ERROR_MEMORY, self->options->start.file);
  return code;
}

// Reads the inputs over time and finds where rows go. What is opened is closed by `finish`.
static term_exit prepare(rider *self) {
  const ride_options *options = self->options;
  bike_file_error error;
  int code = BIKE_OK;
  if (options->input_file)
    code =
        bike_input_table_create(&self->table, options->input_file, options->def.duration, &error);
  bool wants_rows = options->output || !options->show.json;
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
}

int cmd_ride(int argc, char **argv) {
  const ride_options options = ride_parse(argc, argv);
  rider self = {.options = &options};
  term_exit code =
      cli_load(&self.bicycle, &self.model, options.start.file, options.constant.rider_offset);
  if (code == TERM_DONE) code = prepare(&self);
  if (code == TERM_DONE) code = ride(&self);
  finish(&self);
  return code;
}
