// SPDX-License-Identifier: Apache-2.0
// A ride from the command line, whoever rides: what acts on the bicycle, where samples go, and what
// is said at the end. In order: begin, then the engine's ride with term_ride_input and
// term_ride_take, then stop, then end; free in any case.
#ifndef BICYCLE_TERMINAL_RIDE_H
#define BICYCLE_TERMINAL_RIDE_H

#include "terminal/ride_options.h"
#include "terminal/ride_record.h"

#include <bicycle/output.h>

typedef struct term_ride {
  const term_ride_options *options; // must stay valid
  bike_input_table *table;          // what acts over time, NULL: the input is constant
  bike_output output;               //
  term_record record;               //
} term_ride;

// How a ride ended, as every engine can tell it.
typedef struct term_ride_outcome {
  const char *bicycle;             //
  double end_time;                 // s
  bool complete;                   //   the whole duration was ridden
  const bike_sample *end;          //   at end_time; NULL: the last row
  int event_count;                 //   may exceed BIKE_MAX_EVENTS
  const bike_event *events;        //   the first BIKE_MAX_EVENTS of them
  const bike_wheel_ground *ground; // two: what it asked of the ground under rear and front wheel
  term_limits limits;              //   those of the options, with the reach filled in
  const char *error;               //   why it failed, NULL: it did not
  const char *note; //   what the engine adds to the summary on stderr, "" for nothing
  json_t *more;     //   what it adds to the JSON document; taken over
} term_ride_outcome;

// Reads the inputs over time and finds where rows go. A failure is reported.
term_exit term_ride_begin(term_ride *out, const term_ride_options *options);

// The input at a time: a bike_input_function whose user is the term_ride.
void term_ride_input(double time, bike_input *out, void *user);

// Records a sample. True if the ride should stop: interrupted, or its output is lost.
bool term_ride_take(term_ride *ride, const bike_sample *sample, const bike_sample_more *more);

// The same for rows that the caller writes itself, to output.stream where that is not NULL: counts
// one at a time, shows progress.
bool term_ride_count(term_ride *ride, double time);

// After the engine's ride, before anything is said. An interrupt (SIGINT) ends the program here,
// and leaves no output.
void term_ride_stop(term_ride *ride);

// Ends the output and reports. `code` is how the ride ended; rows are kept unless it is TERM_USAGE
// or there are none. Returns how the program ends.
term_exit term_ride_end(term_ride *ride, const term_ride_outcome *outcome, term_exit code);

// The first half of that, for who reports otherwise: rows are kept unless `code` is TERM_USAGE or
// there are none. False if there is nothing left to report; `code` is then how the program ends.
bool term_ride_close(term_ride *ride, term_exit *code);

// Leaves no half-written output; does nothing to a ride that is zeroed.
void term_ride_free(term_ride *ride);

#endif
