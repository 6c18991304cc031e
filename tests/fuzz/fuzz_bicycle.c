// SPDX-License-Identifier: Apache-2.0
// Bicycle files, YAML and the text form. What is accepted obeys every rule of a bicycle, has finite
// answers or codes, and comes back from its own file.
#include "fuzz.h"

#include <bicycle/error.h>
#include <bicycle/file.h>
#include <bicycle/linear.h>
#include <bicycle/parameters.h>
#include <bicycle/state.h>
#include <math.h>
#include <string.h>

static void require_finite(const double *values, size_t count, const char *what) {
  for (size_t i = 0; i < count; i++) FUZZ_REQUIRE(isfinite(values[i]), "%s[%zu]", what, i);
}

static void require_answers(const bike_model *model) {
  const bike_state state = {.lean = 0.1, .steer = 0.05, .lean_rate = 0.3, .speed = 4};
  bike_acceleration a;
  bike_upright_matrices m;
  if (bike_accelerate(&a, model, &state, NULL) == BIKE_OK)
    require_finite((const double *)&a, sizeof a / sizeof(double), "acceleration");
  if (bike_linearize_upright(&m, model) == BIKE_OK)
    require_finite((const double *)&m, sizeof m / sizeof(double), "upright matrices");
}

// z points up in files of people: what lies below the ground was meant the other way.
static void require_above_ground(const bike_bicycle *b) {
  for (int i = 0; i < b->part_count; i++)
    FUZZ_REQUIRE(b->parts[i].position[2] >= -1e-5 * (fabs(b->geometry.L_r) + fabs(b->geometry.L_f)),
                 "%s at %g m", b->parts[i].name, b->parts[i].position[2]);
}

// Numbers edited to what they are change nothing.
static void require_parameters(const char *path, const bike_file *file) {
  bike_parameters *parameters;
  bike_file again;
  bike_bicycle edited;
  FUZZ_REQUIRE(bike_parameters_read(&parameters, &again, path, NULL) == BIKE_OK, "%s", path);
  int index = bike_parameters_count(parameters) - 1;
  double value = bike_parameters_value(parameters, index);
  FUZZ_REQUIRE(bike_parameters_find(parameters, bike_parameters_name(parameters, index)) >= 0,
               "number %d", index);
  FUZZ_REQUIRE(bike_parameters_apply(&edited, parameters, &index, &value, 1, NULL) == BIKE_OK,
               "number %d", index);
  FUZZ_REQUIRE(edited.part_count == file->bicycle.part_count, "%d parts", edited.part_count);
  bike_parameters_free(parameters);
}

static void require_round_trip(const bike_file *file) {
  bike_file again;
  bike_file_error error = {""};
  const char *path = fuzz_write("written.txt", "", 0);
  if (bike_file_write(&file->bicycle, path, &error) != BIKE_OK) {
    FUZZ_REQUIRE(fuzz_one_line(error.text), "'%s'", error.text);
    return;
  }
  FUZZ_REQUIRE(bike_file_read(&again, path, &error) == BIKE_OK, "%s", error.text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  bike_file file;
  bike_model model;
  bike_file_error error = {""};
  const char *path = fuzz_write("bicycle.yml", data, size);
  if (bike_file_read(&file, path, &error) != BIKE_OK) {
    FUZZ_REQUIRE(strncmp(error.text, path, strlen(path)) == 0, "'%s'", error.text);
    FUZZ_REQUIRE(fuzz_one_line(error.text), "'%s'", error.text);
    return 0;
  }
  FUZZ_REQUIRE(bike_check(&file.bicycle, NULL, NULL) == BIKE_OK, "accepted");
  require_above_ground(&file.bicycle);
  require_parameters(path, &file);
  require_round_trip(&file);
  if (bike_model_init(&model, &file.bicycle) == BIKE_OK) require_answers(&model);
  return 0;
}
