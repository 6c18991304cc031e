// SPDX-License-Identifier: Apache-2.0
// Good files of every form: what they mean.
#include "samples.h"
#include "scratch.h"

#include "support/near.h"

#include <bicycle/error.h>
#include <bicycle/file.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A few roundings of lengths near one metre.
static const double ROUNDING = 1e-15;

static bike_file read_file(const char *path) {
  bike_file file;
  bike_file_error error = {""};
  if (bike_file_read(&file, path, &error) != BIKE_OK) fail_msg("%s", error.text);
  return file;
}

static bike_file read_sample(const char *name, const char *text) {
  return read_file(scratch_write(name, text));
}

// Reads `good` with the first `from` replaced.
static bike_file read_edited(const char *good, const char *from, const char *to) {
  char text[4096];
  const char *at = strstr(good, from);
  assert_non_null(at);
  snprintf(text, sizeof text, "%.*s%s%s", (int)(at - good), good, to, at + strlen(from));
  return read_sample("good.yml", text);
}

static const bike_part *part_named(const bike_bicycle *bicycle, const char *name) {
  for (int i = 0; i < bicycle->part_count; ++i)
    if (strcmp(bicycle->parts[i].name, name) == 0) return &bicycle->parts[i];
  fail_msg("no part '%s'", name);
  return NULL;
}

static void check_vector(const double *found, const double *expected, int count) {
  for (int i = 0; i < count; ++i) assert_near(found[i], expected[i], ROUNDING);
}

// Hand-computed from table 1 with the formulas of its geometry.
static void check_benchmark(const bike_bicycle *b) {
  bike_upright upright;
  assert_int_equal(bike_upright_position(&upright, &b->geometry), BIKE_OK);
  assert_near(upright.wheelbase, 1.02, 4 * ROUNDING);
  assert_near(upright.trail, 0.08, 4 * ROUNDING);
  assert_near(upright.tilt, M_PI / 10, 4 * ROUNDING);
  assert_near(b->geometry.L_r, 1.1 * cos(M_PI / 10) - 0.3 * sin(M_PI / 10), ROUNDING);
  assert_near(b->geometry.L_f, 0.35 * sin(M_PI / 10) - 0.08 * cos(M_PI / 10), ROUNDING);
  assert_near(b->geometry.L_s, 1.02 * sin(M_PI / 10) - 0.05 * cos(M_PI / 10), 4 * ROUNDING);
  assert_int_equal(b->part_count, 4);
  const bike_part *B = part_named(b, "B"), *H = part_named(b, "H"), *F = part_named(b, "F");
  assert_int_equal(B->assembly, BIKE_REAR_FRAME);
  assert_false(B->rider);
  check_vector(B->position, (const double[]){0.3, 0, 0.9}, 3);
  check_vector(B->inertia, (const double[]){9.2, 11, 2.8, 0, -2.4, 0}, 6); // z turned: Ixz too
  assert_int_equal(H->assembly, BIKE_FRONT_FRAME);
  check_vector(H->inertia, (const double[]){0.05892, 0.06, 0.00708, 0, 0.00756, 0}, 6);
  assert_int_equal(F->assembly, BIKE_FRONT_WHEEL);
  check_vector(F->position, (const double[]){1.02, 0, 0.35}, 3);
  check_vector(F->inertia, (const double[]){0.1405, 0.28, 0.1405, 0, 0, 0}, 6);
  assert_near(part_named(b, "R")->mass, 2, 0);
  assert_near(b->gravity, 9.81, 0);
}

static void meijaard_forms(void **state) {
  (void)state;
  const bike_file values = read_sample("values.yml", SAMPLE_VALUES);
  check_benchmark(&values.bicycle);
  assert_string_equal(values.bicycle.name, "bench");
  assert_true(values.has_meijaard);
  assert_false(values.has_uncertainty);
  const bike_file flat = read_sample("flat.bike.yml", SAMPLE_FLAT);
  check_benchmark(&flat.bicycle);
  assert_string_equal(flat.bicycle.name, "flat.bike");
  const bike_file text = read_sample("text.txt", SAMPLE_TEXT);
  check_benchmark(&text.bicycle);
  const bike_file named = read_edited(SAMPLE_VALUES, "Meijaard2007", "benchmark");
  check_benchmark(&named.bicycle);
}

static int symbol(const char *name) {
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; ++i)
    if (strcmp(bike_meijaard_symbols()[i], name) == 0) return i;
  fail_msg("no symbol %s", name);
  return -1;
}

static void uncertainties(void **state) {
  (void)state;
  const bike_file file = read_sample("text.txt", SAMPLE_TEXT);
  assert_true(file.has_uncertainty);
  assert_near(file.meijaard.sigma[symbol("w")], 0.001, 0);
  assert_near(file.meijaard.sigma[symbol("g")], 0.01, 0);
  assert_near(file.meijaard.sigma[symbol("c")], 0, 0);
  assert_near(file.meijaard.sigma[symbol("IRxx")], 0.01e-2, 0);
  assert_near(file.meijaard.value[symbol("IRxx")], 0.0603, 0);
  assert_near(file.meijaard.value[symbol("IHxz")], -0.00756, 0);
}

// What BicycleParameters' other models add is read and not used.
static void unused_keys(void **state) {
  (void)state;
  const bike_file file =
      read_edited(SAMPLE_VALUES, "  c: 0.08\n",
                  "  c: 0.08\n  v: 5.0\n  d1: 0.9\n  d2: 0.2\n  d3: 0.1\n  xcl: 1\n  zcl: -1\n"
                  "  mG: 1\n  xG: 1\n  zG: 1\n  IGxx: 1\n  IGxz: 1\n  mS: 1\n  xS: 1\n  zS: -1\n"
                  "  ISyy: 1\n  IRzz: 0.0603\n  IFzz: 0.1405\n  yB: 0.0\n");
  check_benchmark(&file.bicycle);
}

static void lateral_positions(void **state) {
  (void)state;
  const bike_file file =
      read_edited(SAMPLE_VALUES, "  c: 0.08\n", "  c: 0.08\n  yB: 0.02\n  yH: -0.01\n");
  assert_near(part_named(&file.bicycle, "B")->position[1], -0.02, 0); // right positive there
  assert_near(part_named(&file.bicycle, "H")->position[1], 0.01, 0);
}

// As BicycleParameters' own to_yaml writes it: empty texts, no rider.
// Any JSON file is YAML: words may be quoted. Numbers may not (test_file_wrong.c).
static void quoted_words(void **state) {
  (void)state;
  bike_file file = read_edited(SAMPLE_VALUES, "parameterization: Meijaard2007",
                               "\"parameterization\": \"Meijaard2007\"");
  check_benchmark(&file.bicycle);
}

static void empty_metadata(void **state) {
  (void)state;
  const bike_file file =
      read_edited(SAMPLE_VALUES, "parameters: bench\nrider: true\ndescription: a bicycle\n",
                  "description: ''\nparameters: ''\nrider: null\n");
  check_benchmark(&file.bicycle);
  assert_string_equal(file.bicycle.name, "good");
}

static void shapes_of_text(void **state) {
  (void)state;
  char text[4096] = "\xef\xbb\xbf";
  size_t length = strlen(text);
  for (const char *c = SAMPLE_VALUES; *c; ++c) { // a byte order mark, CRLF
    if (*c == '\n') text[length++] = '\r';
    text[length++] = *c;
  }
  const bike_file crlf = read_sample("crlf.yml", text);
  check_benchmark(&crlf.bicycle);
  text[length - 2] = '\0'; // no line feed at the end
  const bike_file end = read_sample("end.yml", text);
  check_benchmark(&end.bicycle);
  const bike_file spelt = read_edited(SAMPLE_VALUES, "c: 0.08", "c: +8.0E-02 # trail");
  check_benchmark(&spelt.bicycle);
}

static void components(void **state) {
  (void)state;
  const bike_file file = read_sample("parts.yml", SAMPLE_COMPONENTS);
  const bike_bicycle *b = &file.bicycle;
  assert_string_equal(b->name, "roadster");
  assert_false(file.has_meijaard);
  assert_near(b->steer_damping, 0.5, 0);
  assert_int_equal(b->part_count, 5);
  const double tilt = M_PI / 2 - 1.1868238913561442;
  check_vector(part_named(b, "rear wheel")->position, (const double[]){0, 0, 0.34}, 3);
  check_vector(part_named(b, "rear wheel")->inertia, (const double[]){0, 0.2, 0, 0, 0, 0}, 6);
  check_vector(part_named(b, "frame")->inertia, (const double[]){0.5, 0.6, 0.4, 0.01, -0.1, 0.02},
               6);
  check_vector(part_named(b, "frame")->position, (const double[]){0.45, 0.01, 0.55}, 3);
  assert_true(part_named(b, "rider")->rider);
  assert_false(part_named(b, "frame")->rider);
  // e_S = (-sin, 0, cos): the axis leans back going up
  const double s = sin(tilt), c = cos(tilt);
  check_vector(part_named(b, "bar")->inertia,
               (const double[]){0.1 * s * s, 0, 0.1 * c * c, 0, -0.1 * s * c, 0}, 6);
  const bike_file lengths = read_sample("lengths.yml", SAMPLE_LENGTHS);
  assert_near(lengths.bicycle.geometry.L_s, b->geometry.L_s, ROUNDING);
  assert_near(lengths.bicycle.geometry.L_r, b->geometry.L_r, ROUNDING);
  assert_near(lengths.bicycle.geometry.L_f, b->geometry.L_f, ROUNDING);
  assert_string_equal(lengths.bicycle.name, "lengths");
}

// The benchmark with its lengths, masses and inertias multiplied; whether it is read.
static int read_scaled(double length, double mass, double inertia) {
  char text[4096];
  int used = 0;
  const bike_file file = read_sample("benchmark.yml", SAMPLE_FLAT);
  for (int i = 0; i < BIKE_MEIJAARD_COUNT; ++i) {
    const char *name = bike_meijaard_symbols()[i];
    const bool plain = strcmp(name, "lam") == 0 || strcmp(name, "g") == 0;
    const double factor = plain ? 1 : *name == 'I' ? inertia : *name == 'm' ? mass : length;
    used += snprintf(text + used, sizeof text - (size_t)used, "%s: %.17g\n", name,
                     factor * file.meijaard.value[i]);
  }
  bike_file scaled;
  return bike_file_read(&scaled, scratch_write("scaled.yml", text), NULL);
}

// Bicycles of any size are bicycles, if their mass is that of the size; lengths in centimetres or
// millimetres are not, whatever the unit of the inertias.
static void sizes_and_units(void **state) {
  (void)state;
  static const double sizes[] = {1e-4, 1e-2, 0.5, 4, 100, 1e4};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
    assert_int_equal(read_scaled(sizes[i], pow(sizes[i], 3), pow(sizes[i], 5)), BIKE_OK);
  for (double unit = 100; unit <= 1000; unit *= 10)
    for (double mass = 0.1; mass < 1.5; mass *= 3) { // as light as a frame, as heavy as a rider
      assert_int_equal(read_scaled(unit, mass, mass), BIKE_ERROR_PARAMETER);
      assert_int_equal(read_scaled(unit, mass, mass * unit * unit), BIKE_ERROR_PARAMETER);
    }
  assert_int_equal(read_scaled(4, 0.2, 3), BIKE_OK); // a long, light one
}

// A skate's mass lies on the ground.
static void mass_on_the_ground(void **state) {
  (void)state;
  read_edited(SAMPLE_VALUES, "zH: -0.7", "zH: 0");
  read_edited(SAMPLE_VALUES, "zH: -0.7", "zH: 1e-17");
  read_edited(SAMPLE_COMPONENTS, "[0.86, 0, 0.85]", "[0.86, 0, 0]");
}

// A wheel's place is put exactly on the hub.
static void hub_rounding(void **state) {
  (void)state;
  const bike_file file = read_edited(SAMPLE_COMPONENTS, "[1.11, 0, 0.34]", "[1.1100005, 0, 0.34]");
  assert_near(part_named(&file.bicycle, "front wheel")->position[0], 1.11, ROUNDING);
}

static void shipped(void **state) {
  (void)state;
  static const struct {
    const char *name;
    double wheelbase, trail, head_angle, mass, damping;
    bool rider;
  } bicycles[] = {
      {"roadster", 1.11, 0.07, 68, 89, 0, true},
      {"roadster_riderless", 1.11, 0.07, 68, 19, 0, false},
      {"penny_farthing", 0.95, 0.05, 82, 89, 0, true},
      {"recumbent", 1.65, 0.10, 60, 90, 0, true},
      {"recumbent_damped", 1.65, 0.10, 60, 90, 1, true},
      {"benchmark", 1.02, 0.08, 72, 94, 0, false},
  };
  for (size_t i = 0; i < sizeof bicycles / sizeof *bicycles; ++i) {
    char path[1024];
    snprintf(path, sizeof path, "%s/model/%s/%s.yml", BICYCLE_SOURCE_DIR, bicycles[i].name,
             bicycles[i].name);
    const bike_file file = read_file(path);
    bike_upright upright;
    assert_int_equal(bike_upright_position(&upright, &file.bicycle.geometry), BIKE_OK);
    assert_near(upright.wheelbase, bicycles[i].wheelbase, 4 * ROUNDING);
    assert_near(upright.trail, bicycles[i].trail, 4 * ROUNDING);
    assert_near(90 - upright.tilt * 180 / M_PI, bicycles[i].head_angle, 1e-13);
    assert_near(file.bicycle.steer_damping, bicycles[i].damping, 0);
    double mass = 0, rider = 0;
    for (int k = 0; k < file.bicycle.part_count; ++k) {
      mass += file.bicycle.parts[k].mass;
      if (file.bicycle.parts[k].rider) rider += file.bicycle.parts[k].mass;
    }
    assert_near(mass, bicycles[i].mass, 1e-13);
    assert_near(rider, bicycles[i].rider ? 70 : 0, 0);
  }
}

// A value with all digits of a double in a file of each form; the sample's numbers are the
// reference.
static void long_numbers(void **state) {
  (void)state;
  static const struct {
    const char *good, *from, *format;
  } cases[] = {{SAMPLE_VALUES, "c: 0.08", "c: %.500f"},
               {SAMPLE_FLAT, "c: 0.08", "c: %.500f"},
               {SAMPLE_TEXT, "c = 0.08+/-0.0", "c = %.500f+/-0.0"},
               {SAMPLE_TEXT, "c = 0.08+/-0.0", "c = (%.500f+/-0.0)e+00"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char to[1000];
    snprintf(to, sizeof to, cases[i].format, 0.08);
    const bike_file file = read_edited(cases[i].good, cases[i].from, to);
    const bike_file plain = read_edited(cases[i].good, cases[i].from, cases[i].from);
    assert_memory_equal(&file.bicycle.geometry, &plain.bicycle.geometry,
                        sizeof file.bicycle.geometry);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(meijaard_forms),  cmocka_unit_test(uncertainties),
      cmocka_unit_test(unused_keys),     cmocka_unit_test(lateral_positions),
      cmocka_unit_test(quoted_words),    cmocka_unit_test(empty_metadata),
      cmocka_unit_test(shapes_of_text),  cmocka_unit_test(components),
      cmocka_unit_test(hub_rounding),    cmocka_unit_test(shipped),
      cmocka_unit_test(sizes_and_units), cmocka_unit_test(mass_on_the_ground),
      cmocka_unit_test(long_numbers),
  };
  return cmocka_run_group_tests(tests, scratch_create, scratch_remove);
}
