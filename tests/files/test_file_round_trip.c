// SPDX-License-Identifier: Apache-2.0
// Written and read back: the same model, and what BicycleParameters needs to load it.
#include "samples.h"
#include "scratch.h"

#include "support/near.h"

#include <bicycle/error.h>
#include <bicycle/file.h>
#include <bicycle/model.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Of the largest entry: the lumps are sums of a few products of order one to a hundred.
static const double ROUNDING = 1e-14;

static void check_same(const double *found, const double *expected, int count, double scale,
                       const char *what) {
  for (int i = 0; i < count; ++i)
    if (!(fabs(found[i] - expected[i]) <= ROUNDING * scale))
      fail_msg("%s[%d]: %.17g is not %.17g", what, i, found[i], expected[i]);
}

static void check_body(const bike_body *found, const bike_body *expected) {
  check_same(&found->mass, &expected->mass, 1, expected->mass, "mass");
  check_same(found->centre, expected->centre, 3, 1, "centre");
  // the tensor about the centre is small beside the moments it was moved by: mass * metre^2
  check_same(found->inertia, expected->inertia, 6, expected->mass, "inertia");
  check_same(&found->spin_inertia, &expected->spin_inertia, 1, 1, "spin");
}

static void check_models(const bike_model *found, const bike_model *expected) {
  check_same(&found->geometry.L_r, &expected->geometry.L_r, 5, 1, "geometry");
  check_same(&found->gravity, &expected->gravity, 1, 0, "gravity");
  check_same(&found->steer_damping, &expected->steer_damping, 1, 0, "damping");
  check_body(&found->rear, &expected->rear);
  check_body(&found->front, &expected->front);
  check_same(&found->rider_mass, &expected->rider_mass, 1, 0, "rider mass");
  check_same(found->rider_place, expected->rider_place, 3, 1, "rider arm");
}

static bike_file read_file(const char *path) {
  bike_file file;
  bike_file_error error = {""};
  if (bike_file_read(&file, path, &error) != BIKE_OK) fail_msg("%s", error.text);
  return file;
}

// Writes, reads back, compares; then once more: the second file must be the first.
static void check_round_trip(const bike_bicycle *bicycle) {
  bike_file_error error = {""};
  const char *path = scratch_path("written.yml");
  if (bike_file_write(bicycle, path, &error) != BIKE_OK) fail_msg("%s", error.text);
  const bike_file back = read_file(path);
  assert_string_equal(back.bicycle.name, bicycle->name);
  bike_model expected, found;
  assert_int_equal(bike_model_init(&expected, bicycle), BIKE_OK);
  assert_int_equal(bike_model_init(&found, &back.bicycle), BIKE_OK);
  check_models(&found, &expected);
}

static void shipped(void **state) {
  (void)state;
  static const char *const names[] = {"roadster",  "roadster_riderless", "penny_farthing",
                                      "recumbent", "recumbent_damped",   "benchmark"};
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
    char path[1024];
    snprintf(path, sizeof path, "%s/model/%s/%s.yml", BICYCLE_SOURCE_DIR, names[i], names[i]);
    const bike_file file = read_file(path);
    check_round_trip(&file.bicycle);
  }
}

static bike_bicycle sample(const char *text) {
  return read_file(scratch_write("sample.yml", text)).bicycle;
}

// A rider with a tensor of its own, a frame and a bar off the middle plane, a name to be quoted.
static void lateral_and_rider(void **state) {
  (void)state;
  bike_bicycle bicycle = sample(SAMPLE_VALUES);
  snprintf(bicycle.name, sizeof bicycle.name, "it's: #1 \"x\"");
  bicycle.parts[0].position[1] = 0.013;
  bicycle.parts[2].position[1] = -0.004;
  bicycle.parts[bicycle.part_count++] = (bike_part){.name = "rider",
                                                    .assembly = BIKE_REAR_FRAME,
                                                    .rider = true,
                                                    .mass = 70,
                                                    .position = {0.4, 0.013, 1.1},
                                                    .inertia = {3, 4, 2, 0, 0.5, 0}};
  check_round_trip(&bicycle);
}

// Frames that are point masses or rods: what is left of B without the rider is zero or singular up
// to rounding, and must come back as a tensor that may exist.
static void singular_frames(void **state) {
  (void)state;
  for (int i = 0; i < 200; ++i) {
    bike_bicycle bicycle = sample(SAMPLE_VALUES);
    bike_part *frame = &bicycle.parts[0];
    *frame = (bike_part){.name = "frame", .mass = 3 + 0.37 * i, .position = {0.3, 0, 0.5}};
    frame->position[0] += 0.0123 * i;
    const double x = 0.01 * (i % 17), z = 0.013 * (i % 5); // a rod along (x, z), i = 0: a point
    bike_part rider = {.name = "rider", .rider = true, .mass = 71.3, .position = {0.31, 0, 1.07}};
    frame->inertia[0] = z * z;
    frame->inertia[1] = x * x + z * z;
    frame->inertia[2] = x * x;
    frame->inertia[4] = -x * z;
    bicycle.parts[bicycle.part_count++] = rider;
    check_round_trip(&bicycle);
  }
}

static void benchmark_numbers(void **state) {
  (void)state;
  const bike_file file = read_file(scratch_write("sample.yml", SAMPLE_VALUES));
  double value[BIKE_MEIJAARD_COUNT];
  assert_int_equal(bike_to_meijaard(value, &file.bicycle), BIKE_OK);
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; ++i)
    assert_near(value[i], file.meijaard.value[i], 1e-15);
}

// PyYAML's floats have a point and a signed exponent; BicycleParameters wants v, rider and floats.
static void other_readers(void **state) {
  (void)state;
  bike_bicycle bicycle = sample(SAMPLE_VALUES);
  bicycle.parts[1].inertia[0] = bicycle.parts[1].inertia[2] = 1e-5;
  assert_int_equal(bike_file_write(&bicycle, scratch_path("written.yml"), NULL), BIKE_OK);
  char *text = scratch_read(scratch_path("written.yml"));
  assert_non_null(strstr(text, "\nparameterization: Meijaard2007\n"));
  assert_non_null(strstr(text, "\nrider: null\n"));
  assert_non_null(strstr(text, "  v: 1.0"));
  assert_non_null(strstr(text, "  mB: 85.0\n"));
  assert_non_null(strstr(text, "  IRxx: 1.0000000000000001e-05\n"));
  assert_null(strstr(text, "-0.0\n"));
  free(text);
}

static void refuse(const bike_bicycle *bicycle, const char *what) {
  bike_file_error error = {""};
  scratch_write("kept.yml", "old");
  const char *path = scratch_path("kept.yml");
  const int before = scratch_count();
  assert_int_equal(bike_file_write(bicycle, path, &error), BIKE_ERROR_PARAMETER);
  if (!strstr(error.text, what)) fail_msg("'%s' does not say '%s'", error.text, what);
  assert_int_equal(scratch_count(), before);
  char *text = scratch_read(path);
  assert_string_equal(text, "old");
  free(text);
}

// What the form cannot hold is refused, not dropped.
static void unwritable_bicycles(void **state) {
  (void)state;
  const bike_bicycle good = sample(SAMPLE_VALUES);
  bike_bicycle bicycle = good;
  bicycle.parts[0].inertia[3] = 0.01;
  refuse(&bicycle, "a product of inertia Ixy or Iyz");
  bicycle = good;
  bicycle.parts[2].inertia[5] = -1e-6;
  refuse(&bicycle, "a product of inertia Ixy or Iyz");
  bicycle = sample(SAMPLE_COMPONENTS);
  refuse(&bicycle, "a product of inertia Ixy or Iyz");
  bicycle = good;
  bicycle.parts[2] = bicycle.parts[3]; // no front frame
  bicycle.part_count = 3;
  refuse(&bicycle, "a frame or wheel without mass");
  bicycle = good;
  bicycle.parts[0].mass = -1;
  refuse(&bicycle, "mass must be positive");
}

// Numbers are read and written with a point where the program's locale has a comma.
static void comma_locale(void **state) {
  (void)state;
  if (!setlocale(LC_ALL, "de_DE.UTF-8") && !setlocale(LC_ALL, "fr_FR.UTF-8")) skip();
  const bike_bicycle bicycle = sample(SAMPLE_VALUES);
  check_round_trip(&bicycle);
  setlocale(LC_ALL, "C");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shipped),
      cmocka_unit_test(lateral_and_rider),
      cmocka_unit_test(benchmark_numbers),
      cmocka_unit_test(singular_frames),
      cmocka_unit_test(other_readers),
      cmocka_unit_test(comma_locale),
      cmocka_unit_test(unwritable_bicycles),
  };
  return cmocka_run_group_tests(tests, scratch_create, scratch_remove);
}
