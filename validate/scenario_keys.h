// SPDX-License-Identifier: Apache-2.0
// Readers of the parts of a scenario file, for the YAML reader of src/files.
#ifndef VALIDATE_SCENARIO_KEYS_H
#define VALIDATE_SCENARIO_KEYS_H

#include "scenario.h"

#include "files/yaml.h"

// Where a file is read into; `here` is its path, from which other paths are relative.
typedef struct scenario_draft {
  scenario *out;
  const char *here;
} scenario_draft;

bike_value_reader scenario_read_engine; // engine_choice
bike_value_reader scenario_read_gates;  // gate_rules

bike_value_reader scenario_read_input_file; // scenario_input

// Loads the input's file, if it has one, when all keys are read.
int scenario_load_input(const bike_yaml *yaml, scenario_input *input, double duration);

// The questions of single layers (scenario_study.c).
bike_value_reader scenario_read_linear;      // scenario_linear
bike_value_reader scenario_read_convergence; // scenario_convergence
bike_value_reader scenario_read_horizon;     // scenario_horizon
bike_value_reader scenario_read_cost;        // scenario_cost

// Whether engines and gates are such that they can be answered; when all is read.
int scenario_check_studies(const bike_yaml *yaml, const scenario *s);

// A whole number 0..most, read as a double.
int scenario_read_whole(const bike_yaml *yaml, const bike_field *field, double most, double *out);

// Rules of a file that holds `gates:` and nothing else.
int scenario_include_gates(gate_rules *out, const char *path, bike_file_error *error);

// "folder of `from`/name", or `name` itself where it is absolute; false when too long.
bool scenario_relative_path(char out[SCENARIO_PATH], const char *from, const char *name);

#endif
