// SPDX-License-Identifier: Apache-2.0
// The commands of the program `bicycle-mujoco`, run as `bicycle mujoco NAME`, and what their
// command lines share.
#ifndef PLUGIN_CMD_H
#define PLUGIN_CMD_H

#include "bicycle_mjcf.h"

#include "terminal/start.h"

int cmd_import(int argc, char **argv);
int cmd_mjcf(int argc, char **argv);
int cmd_ride(int argc, char **argv);

// How the model is made, and which of it was asked for: a model file has its own.
typedef struct cmd_model {
  mjcf_options options;
  bool has_root, has_rolling, has_integrator, has_timestep;
} cmd_model;

// --root, --rolling, --integrator, --timestep: a child parser whose input is a cmd_model with
// default options.
extern const struct argp cmd_model_argp;

// A set of files to be made of a bicycle: model and scene apart (cmd_mjcf_set.c).
typedef struct cmd_set {
  const char *output;          // the folder, with a slash at its end
  const char *file;            // as it was asked for
  const bike_bicycle *bicycle; //
  const mjcf_options *options; //
  const mjcf_key *key;         //
  const bike_state *start;     // of the key
  const char *command;         // that asked for it
  bool no_picture;             //
} cmd_set;

// Writes it, whole or not at all.
term_exit cmd_write_set(const cmd_set *set);

// How the program ends where there is no model: TERM_INVALID when out of memory, else TERM_USAGE;
// the second reports it too, "file: text".
term_exit cmd_exit_of(const mjcf_error *error);
term_exit cmd_fail_model(const char *file, const mjcf_error *error);

// FILE and the start state, every number of it NAN until it is given: `speed` may be missing.
term_start cmd_no_start(void);

// Whether any number of the state was given; what was not becomes zero, but for the speed.
bool cmd_has_start(term_start *start);

#endif
