// SPDX-License-Identifier: Apache-2.0
// What acts on the bicycle during a scenario: `steer_torque`, `roll_torque`, or `input`, a file.
#include "scenario_keys.h"

#include "files/text.h"

#include <bicycle/error.h>

int scenario_read_input_file(const bike_yaml *yaml, const bike_field *field, void *target) {
  scenario_input *input = target;
  int code = bike_yaml_text(yaml, field, input->name, sizeof input->name);
  if (code || scenario_relative_path(input->path, yaml->path, input->name)) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_FILE, "the path is too long");
}

enum { LARGEST_FILE = 128 << 20 }; // bytes; as bike_csv_read takes

// So that reports of rides with another input are not taken for the same.
static int hash_file(scenario_input *input, bike_file_error *error) {
  bike_text text;
  int code = bike_text_read(&text, input->path, LARGEST_FILE, error);
  if (code) return code;
  sha256_hex(input->sha256, text.data, text.size);
  bike_text_free(&text);
  return BIKE_OK;
}

int scenario_load_input(const bike_yaml *yaml, scenario_input *input, double duration) {
  static const char *const torques[] = {"steer_torque", "roll_torque"};
  bike_field field = {.key = "input"}, torque;
  bike_file_error error;
  if (!*input->path) return BIKE_OK;
  bike_yaml_find(yaml->root, field.key, &field);
  for (int i = 0; i < 2; i++)
    if (bike_yaml_find(yaml->root, torques[i], &torque))
      return bike_yaml_fail(yaml, &torque, BIKE_ERROR_SYNTAX,
                            "torques come from 'input' or from here, not from both");
  int code = hash_file(input, &error);
  if (!code) code = bike_input_table_create(&input->table, input->path, duration, &error);
  return code ? bike_yaml_fail(yaml, &field, code, "%s", error.text) : BIKE_OK;
}

bool scenario_has_input(const scenario_input *input) {
  return input->table || input->steer_torque != 0 || input->roll_torque != 0;
}

void scenario_input_at(double time, bike_input *out, void *user) {
  const scenario_input *input = user;
  if (input->table)
    bike_input_table_at(time, out, input->table);
  else
    *out = (bike_input){.steer_torque = input->steer_torque, .roll_torque = input->roll_torque};
}
