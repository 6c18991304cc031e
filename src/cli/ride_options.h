// SPDX-License-Identifier: Apache-2.0
// The command line of `bicycle ride`.
#ifndef BICYCLE_CLI_RIDE_OPTIONS_H
#define BICYCLE_CLI_RIDE_OPTIONS_H

#include "start.h"

#include <bicycle/ride.h>

typedef struct ride_options {
  cli_start start;
  bike_ride_def def;      // without what is called during the ride
  const char *action;     // the option that gave the input, NULL: none
  bike_input constant;    // what acts all the time
  const char *input_file; // what acts over time, NULL: nothing
  const char *output;     // NULL: the standard output
  bool has_step, has_tolerance;
  term_show show;
} ride_options;

// Ends the program where the command line is wrong.
ride_options ride_parse(int argc, char **argv);

#endif
