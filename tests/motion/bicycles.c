// SPDX-License-Identifier: Apache-2.0
#include "motion/bicycles.h"

#include "equations/bicycles.h"
#include "support/near.h"

static bike_model model_of(const bike_bicycle *bicycle) {
  bike_model model;
  assert_int_equal(bike_model_init(&model, bicycle), 0);
  return model;
}

bike_model shipped(const char *name) {
  bike_bicycle bicycle = read_shipped(name);
  return model_of(&bicycle);
}

bike_model roadster(void) {
  return shipped("roadster");
}

bike_model roadster_with_rider_at(double offset) {
  bike_bicycle bicycle = read_shipped("roadster");
  for (int i = 0; i < bicycle.part_count; i++)
    if (bicycle.parts[i].rider) bicycle.parts[i].position[1] -= offset;
  return model_of(&bicycle);
}

bike_model damped_roadster(double damping) {
  bike_bicycle bicycle = read_shipped("roadster");
  bicycle.steer_damping = damping;
  return model_of(&bicycle);
}

bike_model penny_farthing(void) {
  return shipped("penny_farthing");
}

bike_model benchmark(void) {
  return shipped("benchmark");
}
