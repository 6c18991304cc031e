// SPDX-License-Identifier: Apache-2.0
// What several commands are told alike: the bicycle and the state in which it is found.
#ifndef BICYCLE_TERMINAL_START_H
#define BICYCLE_TERMINAL_START_H

#include "terminal/command.h"

#include <bicycle/bicycle.h>
#include <bicycle/model.h>
#include <bicycle/state.h>
#include <stdbool.h>

typedef struct term_start {
  const char *file;    // the bicycle: required
  bike_state state;    // zero where not given
  bool has_speed;      //
  bool speed_optional; // what reads the start says itself what is missing; set it before parsing
} term_start;

// FILE, --lean, --steer, --lean-rate, --steer-rate, --speed: a child parser whose input is a
// term_start. Ends the program where a required one is missing.
extern const struct argp term_start_argp;

// Loads the bicycle, and refuses a rider offset without a rider.
term_exit term_load_with_rider(bike_bicycle *bicycle, bike_model *model, const char *file,
                               double rider_offset);

#endif
