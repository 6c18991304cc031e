// SPDX-License-Identifier: Apache-2.0
// The command line of `bicycle mujoco ride`.
#ifndef PLUGIN_CMD_RIDE_OPTIONS_H
#define PLUGIN_CMD_RIDE_OPTIONS_H

#include "cmd.h"
#include "runner.h"

typedef struct cmd_ride_options {
  cli_start start;        //
  bool has_start;         // a state was given; a model file may have its own
  bool is_model;          // FILE is .xml or .mjb
  cmd_model model;        //
  runner_ride_def def;    // without what is called during the ride
  const char *action;     // the option that gave the input, NULL: none
  bike_input constant;    // what acts all the time
  const char *input_file; // what acts over time, NULL: nothing
  const char *output;     // NULL: the standard output
  term_show show;         //
} cmd_ride_options;

// Ends the program where the command line is wrong.
cmd_ride_options cmd_parse_ride(int argc, char **argv);

#endif
