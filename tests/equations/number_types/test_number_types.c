// SPDX-License-Identifier: Apache-2.0
// One kernel source, three number types: the same numbers.
#include "equations/bicycles.h"
#include "instances.h"
#include "support/near.h"
#include "support/random.h"
#include <bicycle/error.h>

// Complex division and the lanes' sine and cosine round differently; some tens of roundings,
// amplified by the conditioning of M, measured in the largest of the results.
static void check_close(const instance_result *got, const instance_result *want) {
  double largest = 1;
  for (int i = 0; i < INSTANCE_RESULTS; i++) largest = fmax(largest, fabs(want->value[i]));
  for (int i = 0; i < INSTANCE_RESULTS; i++)
    assert_near(got->value[i], want->value[i], 1e-13 * largest);
}

static bike_input random_input(random_source *source, bool rider) {
  double w = rider ? 0.1 : 0;
  return (bike_input){.steer_torque = random_between(source, -5, 5),
                      .roll_torque = random_between(source, -5, 5),
                      .rider_offset = random_between(source, -w, w),
                      .rider_velocity = random_between(source, -w, w),
                      .rider_acceleration = random_between(source, -w, w)};
}

// Different bicycles in the lanes, so that a lane that leaks into another shows.
static void number_types_agree(void **state) {
  (void)state;
  random_source source = random_begin("number types", 20070);
  for (int round = 0; round < 500; round++) {
    bike_model model[INSTANCE_LANES];
    bike_state at[INSTANCE_LANES];
    bike_input input[INSTANCE_LANES];
    for (int i = 0; i < INSTANCE_LANES; i++) {
      const shipped_bicycle *shipped = &shipped_bicycles[(round + i) % SHIPPED_COUNT];
      bike_bicycle bicycle = read_shipped(shipped->name);
      assert_int_equal(bike_model_init(&model[i], &bicycle), BIKE_OK);
      at[i] = random_state(&source, &shipped->range);
      input[i] = random_input(&source, model[i].rider_mass > 0);
    }
    instance_result lanes[INSTANCE_LANES], one, complex_one;
    run_lanes(lanes, model, at, input);
    for (int i = 0; i < INSTANCE_LANES; i++) {
      run_double(&one, &model[i], &at[i], &input[i]);
      run_complex(&complex_one, &model[i], &at[i], &input[i]);
      check_close(&lanes[i], &one);
      check_close(&complex_one, &one);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(number_types_agree)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
