// SPDX-License-Identifier: Apache-2.0
// What `bicycle mujoco ride` is told, and its two kinds of ride.
#ifndef PLUGIN_CMD_RIDE_H
#define PLUGIN_CMD_RIDE_H

#include "cmd.h"
#include "cmd_picture.h"
#include "runner_any.h"

#include "terminal/ride.h"

typedef struct cmd_ride_arguments {
  term_ride_options ride;
  cmd_model model;
  cmd_picture picture;
  bool has_start; // a state was given; a model file may have its own
  bool is_model;  // FILE is .xml or .mjb
  bool sensors;   // to be told of
  bool project;   // a start that does not fit is put right
} cmd_ride_arguments;

// What of the command line a model may be changed in.
void cmd_adjust_model(mjModel *model, const cmd_model *asked);

// Rides a model that is no bicycle, in its own coordinates: `why` says why it is none.
term_exit cmd_ride_any(runner_any *any, const cmd_ride_arguments *args, term_ride *ride,
                       const char *why);

#endif
