// SPDX-License-Identifier: Apache-2.0
// The columns of a ride: their names and order, every bit of every number, both conventions.
#include "support/near.h"

#include <bicycle/table.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char HEADER[] =
    "time,x,y,yaw,lean,pitch,steer,lean_rate,steer_rate,speed,rear_angle,front_angle,energy,"
    "rear_normal,front_normal,rear_friction,front_friction";

// Each member differs from the others and has no short decimal form.
static bike_sample sample(void) {
  return (bike_sample){.time = 1.0 / 3,
                       .x = 2.0 / 3,
                       .y = 4.0 / 3,
                       .yaw = 5.0 / 3,
                       .lean = 7.0 / 3,
                       .pitch = 8.0 / 3,
                       .steer = 10.0 / 3,
                       .lean_rate = 11.0 / 3,
                       .steer_rate = 13.0 / 3,
                       .speed = 14.0 / 3,
                       .rear_angle = 16.0 / 3,
                       .front_angle = 17.0 / 3,
                       .energy = 19.0 / 3,
                       .rear_normal = 20.0 / 3,
                       .front_normal = 22.0 / 3,
                       .rear_friction = 23.0 / 3,
                       .front_friction = 25.0 / 3};
}

// Header and row, terminated.
static void write_sample(char out[2048], const bike_sample *s, bike_convention convention) {
  FILE *stream = fmemopen(out, 2048, "w");
  assert_non_null(stream);
  bike_table_header(stream);
  bike_table_row(stream, s, convention);
  assert_int_equal(fclose(stream), 0);
}

static void header_and_bits(void **state) {
  (void)state;
  const bike_sample s = sample();
  char text[2048];
  write_sample(text, &s, BIKE_CONVENTION_ISO);
  char *line = strchr(text, '\n');
  assert_int_equal(strncmp(text, HEADER, strlen(HEADER)), 0);
  assert_int_equal(line - text, strlen(HEADER));
  static const double thirds[] = {1, 2, 4, 5, 7, 8, 10, 11, 13, 14, 16, 17, 19, 20, 22, 23, 25};
  for (int i = 0; i < BIKE_COLUMN_COUNT; ++i) {
    assert_near(strtod(line + 1, &line), thirds[i] / 3, 0); // every bit
    assert_int_equal(*line, i + 1 < BIKE_COLUMN_COUNT ? ',' : '\n');
  }
  assert_int_equal(line[1], '\0');
}

static void conventions(void **state) {
  (void)state;
  bike_sample s = sample();
  double iso[BIKE_COLUMN_COUNT], sae[BIKE_COLUMN_COUNT];
  bike_columns(iso, &s, BIKE_CONVENTION_ISO);
  bike_columns(sae, &s, BIKE_CONVENTION_SAE);
  for (int i = 0; i < BIKE_COLUMN_COUNT; ++i) {
    const char *name = bike_column_names()[i];
    const int left = !strcmp(name, "y") || !strcmp(name, "yaw") || !strcmp(name, "steer") ||
                     !strcmp(name, "steer_rate");
    assert_near(sae[i], left ? -iso[i] : iso[i], 0);
  }
  s.steer = 0;
  bike_columns(sae, &s, BIKE_CONVENTION_SAE);
  assert_false(signbit(sae[6])); // no "-0" in files
}

static void not_finite(void **state) {
  (void)state;
  bike_sample s = sample();
  s.front_friction = NAN;
  char text[2048];
  write_sample(text, &s, BIKE_CONVENTION_ISO);
  assert_non_null(strstr(text, "nan\n"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(header_and_bits),
                                     cmocka_unit_test(conventions), cmocka_unit_test(not_finite)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
