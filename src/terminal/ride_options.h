// SPDX-License-Identifier: Apache-2.0
// What every ride is told alike, whoever rides: start, duration, rows, inputs, ends, output.
#ifndef BICYCLE_TERMINAL_RIDE_OPTIONS_H
#define BICYCLE_TERMINAL_RIDE_OPTIONS_H

#include "terminal/outside.h"
#include "terminal/start.h"

#include <bicycle/input.h>

typedef struct term_ride_options {
  term_start start;       //
  double duration;        // s    required
  double sample;          // s    required, at most the duration
  double lean_limit;      // rad  set it before parsing; 0 < limit <= pi/2
  bool stop_at_lift;      //
  term_limits limits;     //
  const char *action;     //      the option that gave the input, NULL: none
  bike_input constant;    //      what acts all the time
  const char *input_file; //      what acts over time, NULL: nothing
  const char *output;     //      NULL: the standard output
  term_show show;         //
} term_ride_options;

// FILE, the start, --time, --sample, -o, --steer-torque, --roll-torque, --rider-offset, --input,
// --lean-limit, --stop-at, --friction, --reach, --json and --convention: a child parser whose input
// is a term_ride_options. Ends the program where one is wrong, missing, or excludes another.
extern const struct argp term_ride_argp;

#endif
