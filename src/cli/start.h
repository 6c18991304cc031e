// SPDX-License-Identifier: Apache-2.0
// What `state` and `ride` are told alike: the bicycle and the state in which it is found.
#ifndef BICYCLE_CLI_START_H
#define BICYCLE_CLI_START_H

#include "terminal/command.h"

#include <bicycle/bicycle.h>
#include <bicycle/model.h>
#include <bicycle/state.h>
#include <stdbool.h>

typedef struct cli_start {
  const char *file; // the bicycle: required
  bike_state state; // zero where not given
  bool has_speed;   // required
} cli_start;

// FILE, --lean, --steer, --lean-rate, --steer-rate, --speed: a child parser whose input is a
// cli_start. Ends the program where a required one is missing.
extern const struct argp cli_start_argp;

// Loads the bicycle, and refuses a rider offset without a rider.
term_exit cli_load(bike_bicycle *bicycle, bike_model *model, const char *file, double rider_offset);

#endif
