// SPDX-License-Identifier: Apache-2.0
#include "terminal/ride.h"

#include <bicycle/error.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

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

term_exit term_ride_begin(term_ride *out, const term_ride_options *options) {
  bike_file_error error;
  int code = BIKE_OK;
  bool wants_rows = options->output || !options->show.json;
  *out = (term_ride){.options = options};
  if (options->input_file)
    code = bike_input_table_create(&out->table, options->input_file, options->duration, &error);
  if (code == BIKE_OK && wants_rows)
    code = bike_output_begin(&out->output, options->output, &error);
  if (code != BIKE_OK) return term_fail(term_exit_of(code), "%s", error.text);
  out->record = (term_record){.rows = out->output.stream,
                              .convention = options->show.convention,
                              .duration = options->duration,
                              .shows_progress = options->output || !isatty(STDOUT_FILENO)};
  if (!wants_rows) term_record_make_columns(&out->record);
  catch_interrupt();
  return TERM_DONE;
}

static void input_at(bike_input *out, const term_ride *ride, double time) {
  if (ride->table)
    bike_input_table_at(time, out, ride->table);
  else
    *out = ride->options->constant;
}

void term_ride_input(double time, bike_input *out, void *user) {
  input_at(out, user, time);
}

static bool should_stop(const term_ride *ride) {
  return interrupted || (ride->output.stream && ferror(ride->output.stream));
}

bool term_ride_take(term_ride *ride, const bike_sample *sample, const bike_sample_more *more) {
  term_record_add(&ride->record, sample, more);
  return should_stop(ride);
}

bool term_ride_count(term_ride *ride, double time) {
  term_record_count(&ride->record, time);
  return should_stop(ride);
}

void term_ride_stop(term_ride *ride) {
  term_progress_clear(&ride->record.progress);
  if (!interrupted) return;
  bike_output_abort(&ride->output);
  raise(SIGINT); // its action is the default again: the shell sees what happened
  exit(TERM_INVALID);
}

void term_ride_free(term_ride *ride) {
  bike_output_abort(&ride->output);
  bike_input_table_free(ride->table);
  term_record_free(&ride->record);
  *ride = (term_ride){0};
}

//---------------------------------- reports -------------------------------------------------------

static json_t *events_json(const term_ride_outcome *outcome) {
  json_t *array = json_array();
  for (int i = 0; i < outcome->event_count && i < BIKE_MAX_EVENTS; i++) {
    const bike_event *event = &outcome->events[i];
    json_array_append_new(array, json_pack("{s:o, s:s}", "time", term_json_number(event->time),
                                           "reason", bike_event_string(event->kind)));
  }
  return array;
}

// The largest offset of the rider at the rows of the input up to the end of the ride.
static double largest_offset(const term_ride *ride, double end) {
  size_t count = 0;
  const double *times = ride->table ? bike_input_table_times(ride->table, &count) : NULL;
  double largest = 0;
  for (size_t i = 0; i <= count; i++) {
    bike_input input = {0};
    double time = i < count ? times[i] : end;
    if (time < 0 || time > end) continue;
    input_at(&input, ride, time);
    largest = fmax(largest, fabs(input.rider_offset));
  }
  return largest;
}

static term_outside outside_of(const term_ride *ride, const term_ride_outcome *outcome) {
  term_outside out = {0};
  term_outside_ride(&out, "rear", false, &outcome->ground[0], &outcome->limits);
  term_outside_ride(&out, "front", false, &outcome->ground[1], &outcome->limits);
  term_outside_rider(&out, largest_offset(ride, outcome->end_time), &outcome->limits);
  return out;
}

static json_t *friction_json(const term_ride_outcome *outcome) {
  const bike_wheel_ground *rear = &outcome->ground[0], *front = &outcome->ground[1];
  return json_pack("{s:o, s:{s:o, s:o}, s:{s:o, s:o}}", "limit",
                   term_json_number(outcome->limits.friction), "rear", "largest",
                   term_json_number(rear->friction), "time", term_json_number(rear->friction_time),
                   "front", "largest", term_json_number(front->friction), "time",
                   term_json_number(front->friction_time));
}

static bool print_json(const term_ride *ride, const term_ride_outcome *outcome) {
  const term_record *record = &ride->record;
  json_t *document =
      json_pack("{s:s, s:s, s:o, s:b, s:I, s:o, s:o, s:{s:o, s:o, s:o}}", "bicycle",
                outcome->bicycle, "convention", term_convention_name(record->convention),
                "end_time", term_json_number(outcome->end_time), "complete", outcome->complete,
                "rows", (json_int_t)record->count, "events", events_json(outcome), "end",
                term_record_end(record, outcome->end), "energy", "start",
                term_json_number(record->start_energy), "work", term_json_number(record->work),
                "balance", term_json_number(record->balance));
  const term_outside outside = outside_of(ride, outcome);
  json_object_set_new(document, "friction_asked", friction_json(outcome));
  json_object_set_new(document, "outside_physics", term_outside_json(&outside));
  json_object_update(document, outcome->more);
  if (outcome->error) json_object_set_new(document, "error", json_string(outcome->error));
  if (record->columns) json_object_set(document, "samples", record->columns);
  return term_json_write(document, stdout);
}

// What the ride asked of the ground, and what of that none could give.
static void tell_ground(const term_ride *ride, const term_ride_outcome *outcome) {
  const bike_wheel_ground *rear = &outcome->ground[0], *front = &outcome->ground[1];
  const term_outside outside = outside_of(ride, outcome);
  char asked[2][32];
  term_friction_text(asked[0], rear->friction);
  term_friction_text(asked[1], front->friction);
  term_message("largest friction asked: rear %s at %.6g s, front %s at %.6g s", asked[0],
               rear->friction_time, asked[1], front->friction_time);
  for (int i = 0; i < outside.count; i++) {
    char text[TERM_OUTSIDE_SIZE];
    term_outside_text(text, &outside.items[i]);
    term_message("outside physics: %s", text);
  }
}

// Events and a summary on stderr.
static void tell(const term_ride *ride, const term_ride_outcome *outcome) {
  const term_record *record = &ride->record;
  for (int i = 0; i < outcome->event_count && i < BIKE_MAX_EVENTS; i++)
    term_message("%.9g s: %s", outcome->events[i].time, bike_event_string(outcome->events[i].kind));
  if (outcome->event_count > BIKE_MAX_EVENTS)
    term_message("and %d more events", outcome->event_count - BIKE_MAX_EVENTS);
  tell_ground(ride, outcome);
  term_message("%ld rows to %.9g s, convention %s, energy balance %.1e%s", record->count,
               outcome->end_time, term_convention_name(record->convention), record->balance,
               outcome->note);
}

// Kept where rows mean something, also those before an accident.
bool term_ride_close(term_ride *ride, term_exit *code) {
  bike_file_error error;
  if (*code == TERM_USAGE || ride->record.count == 0) {
    bike_output_abort(&ride->output);
    return false;
  }
  if (ride->output.stream && bike_output_commit(&ride->output, &error) != BIKE_OK) {
    *code = term_fail(TERM_USAGE, "%s", error.text);
    return false;
  }
  return true;
}

term_exit term_ride_end(term_ride *ride, const term_ride_outcome *outcome, term_exit code) {
  if (term_ride_close(ride, &code)) {
    tell(ride, outcome);
    if (ride->options->show.json && !print_json(ride, outcome))
      code = term_fail_bike(BIKE_ERROR_MEMORY, ride->options->start.file);
  }
  json_decref(outcome->more);
  return code;
}
