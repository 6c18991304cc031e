// SPDX-License-Identifier: Apache-2.0
// Numbers of a file by name: changing one gives, bit for bit, the bicycle of the edited file.
#include "samples.h"
#include "scratch.h"

#include "support/near.h"

#include <bicycle/error.h>
#include <bicycle/parameters.h>
#include <stdio.h>
#include <string.h>

typedef struct edit {
  const char *sample; // a good file
  const char *from, *to;
  const char *name; // the number that this changes
  double value;
} edit;

static const edit EDITS[] = {
    {SAMPLE_VALUES, "w: 1.02", "w: 1.05", "w", 1.05},
    {SAMPLE_VALUES, "lam: 0.3141592653589793", "lam: 0.25", "lam", 0.25},
    {SAMPLE_VALUES, "zB: -0.9", "zB: -1.1", "zB", -1.1},
    {SAMPLE_VALUES, "IRxx: 0.0603", "IRxx: 0.07", "IRxx", 0.07},
    {SAMPLE_VALUES, "IRxx: 0.0603\n", "IRxx: 0.0603\n  yH: 0.01\n", "yH", 0.01},
    {SAMPLE_FLAT, "rF: 0.35", "rF: 0.33", "rF", 0.33},
    {SAMPLE_TEXT, "(6.03+/-0.01)e-02", "0.07", "IRxx", 0.07},
    {SAMPLE_COMPONENTS, "g: 9.81", "g: 1.62", "g", 1.62},
    {SAMPLE_COMPONENTS, "steer_damping: 0.5", "steer_damping: 0.1", "steer_damping", 0.1},
    {SAMPLE_COMPONENTS, "trail: 0.07", "trail: -0.02", "geometry.trail", -0.02},
    {SAMPLE_COMPONENTS, "head_angle: 1.1868238913561442", "head_angle: 1.2", "geometry.head_angle",
     1.2},
    {SAMPLE_COMPONENTS, "rear_radius: 0.34", "rear_radius: 0.3", "geometry.rear_radius", 0.3},
    {SAMPLE_COMPONENTS, "mass: 70", "mass: 90", "parts.rider.mass", 90},
    {SAMPLE_COMPONENTS, "[0.36, 0, 1.08]", "[0.4, 0, 1.08]", "parts.rider.position.forward", 0.4},
    {SAMPLE_COMPONENTS, "[0.45, 0.01, 0.55]", "[0.45, 0.01, 0.6]", "parts.frame.position.up", 0.6},
    {SAMPLE_COMPONENTS, "{spin: 0.2}", "{spin: 0}", "parts.rear wheel.inertia.spin", 0},
    {SAMPLE_COMPONENTS, "{steering: 0.1}", "{steering: 0.3}", "parts.bar.inertia.steering", 0.3},
    {SAMPLE_COMPONENTS, "0.01, -0.1, 0.02]", "0.01, -0.2, 0.02]", "parts.frame.inertia.Ixz", -0.2},
    {SAMPLE_COMPONENTS, "[0.1, 0.2, 0.1, 0", "[0.12, 0.2, 0.12, 0", "parts.front wheel.inertia.Ixx",
     0.12},
    {SAMPLE_LENGTHS, "L_f: 0.062463371941734944", "L_f: 0.05", "geometry.L_f", 0.05},
};

static bike_parameters *read_text(const char *text, bike_file *file) {
  bike_parameters *p;
  bike_file_error error;
  if (bike_parameters_read(&p, file, scratch_write("sample.yml", text), &error))
    fail_msg("%s", error.text);
  return p;
}

static bike_bicycle edited(const edit *e) {
  const char *at = strstr(e->sample, e->from);
  if (!at) fail_msg("'%s' is not in the sample", e->from);
  char text[4096];
  snprintf(text, sizeof text, "%.*s%s%s", (int)(at - e->sample), e->sample, e->to,
           at + strlen(e->from));
  // Of a wheel the place is only repeated: it follows the hub.
  char *place = strstr(text, "    position: [1.11, 0, 0.34]\n");
  if (place) memmove(place, strchr(place, '\n') + 1, strlen(strchr(place, '\n')));
  bike_file file;
  bike_file_error error;
  if (bike_file_read(&file, scratch_write("sample.yml", text), &error)) fail_msg("%s", error.text);
  return file.bicycle;
}

static void a_changed_number_is_an_edited_file(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof EDITS / sizeof *EDITS; i++) {
    const edit *e = &EDITS[i];
    bike_file file;
    bike_parameters *p = read_text(e->sample, &file);
    const int index = bike_parameters_find(p, e->name);
    if (index < 0) fail_msg("'%s' is not found", e->name);
    bike_file_error error;
    bike_bicycle changed = {0};
    if (bike_parameters_apply(&changed, p, &index, &e->value, 1, &error))
      fail_msg("%s: %s", e->name, error.text);
    const bike_bicycle expected = edited(e);
    if (memcmp(&changed, &expected, sizeof changed) != 0) fail_msg("%s differs", e->name);
    bike_parameters_free(p);
  }
}

static const char *const SAMPLES[] = {SAMPLE_VALUES, SAMPLE_FLAT, SAMPLE_TEXT, SAMPLE_COMPONENTS,
                                      SAMPLE_LENGTHS};

// No number changed is the file itself; each one changed is not; the values are the file's.
static void every_name_means_something(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof SAMPLES / sizeof *SAMPLES; i++) {
    bike_file file;
    bike_parameters *p = read_text(SAMPLES[i], &file);
    bike_bicycle same = {0}, other = {0};
    assert_int_equal(bike_parameters_apply(&same, p, NULL, NULL, 0, NULL), 0);
    assert_memory_equal(&same, &file.bicycle, sizeof same);
    assert_true(bike_parameters_count(p) >= 20);
    for (int k = 0; k < bike_parameters_count(p); k++) {
      const double value = bike_parameters_value(p, k), shifted = value * 1.0001 + 1e-6;
      assert_int_equal(bike_parameters_find(p, bike_parameters_name(p, k)), k);
      assert_int_equal(bike_parameters_apply(&same, p, &k, &value, 1, NULL), 0);
      assert_memory_equal(&same, &file.bicycle, sizeof same);
      if (bike_parameters_apply(&other, p, &k, &shifted, 1, NULL)) continue; // refused: noticed
      if (memcmp(&other, &file.bicycle, sizeof other) == 0)
        fail_msg("%s changes nothing", bike_parameters_name(p, k));
    }
    bike_parameters_free(p);
  }
}

static void uncertainty_is_kept(void **state) {
  (void)state;
  bike_file file;
  bike_parameters *p = read_text(SAMPLE_TEXT, &file);
  assert_near(bike_parameters_sigma(p, bike_parameters_find(p, "w")), 0.001, 0);
  assert_near(bike_parameters_sigma(p, bike_parameters_find(p, "IRxx")), 1e-4, 1e-18);
  assert_near(bike_parameters_sigma(p, bike_parameters_find(p, "mB")), 0, 0);
  assert_int_equal(bike_parameters_find(p, "nosuch"), -1);
  bike_parameters_free(p);
}

// What no file could say is refused with its reason, and leaves the bicycle as it was.
static void impossible_values(void **state) {
  (void)state;
  static const struct {
    const char *sample, *name;
    double value;
    int code;
    const char *says;
  } wrong[] = {
      {SAMPLE_VALUES, "mB", -1, BIKE_ERROR_PARAMETER, "mB: must be positive"},
      {SAMPLE_VALUES, "lam", 18, BIKE_ERROR_PARAMETER, "pi/2; 18 deg are 0.314159"},
      {SAMPLE_VALUES, "lam", 90, BIKE_ERROR_PARAMETER, "lam: must be in radians"},
      {SAMPLE_VALUES, "w", NAN, BIKE_ERROR_NOT_FINITE, "w: must be finite"},
      {SAMPLE_VALUES, "IBxz", 90, BIKE_ERROR_PARAMETER, "part 'B': inertia must be positive"},
      {SAMPLE_COMPONENTS, "parts.rider.mass", 0, BIKE_ERROR_PARAMETER,
       "part 'rider': mass must be positive"},
      {SAMPLE_COMPONENTS, "parts.bar.inertia.steering", -1, BIKE_ERROR_PARAMETER,
       "part 'bar': inertia must not be negative"},
      {SAMPLE_COMPONENTS, "geometry.head_angle", 4, BIKE_ERROR_PARAMETER,
       "upright); 4 deg are 0.0698132"},
      {SAMPLE_COMPONENTS, "geometry.wheelbase", -1, BIKE_ERROR_PARAMETER, "wheelbase must be"},
      {SAMPLE_COMPONENTS, "geometry.front_radius", -0.3, BIKE_ERROR_PARAMETER, "radius"},
      {SAMPLE_LENGTHS, "geometry.L_f", -2, BIKE_ERROR_IMPOSSIBLE, "cannot stand"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    static const bike_bicycle untouched = {.name = "untouched"};
    bike_file file;
    bike_bicycle bicycle = untouched;
    bike_file_error error = {""};
    bike_parameters *p = read_text(wrong[i].sample, &file);
    const int index = bike_parameters_find(p, wrong[i].name);
    assert_true(index >= 0);
    const int code = bike_parameters_apply(&bicycle, p, &index, &wrong[i].value, 1, &error);
    if (code != wrong[i].code || !strstr(error.text, wrong[i].says) || error.text[0] == ':')
      fail_msg("%s: code %d, '%s'", wrong[i].name, code, error.text);
    // degrees are spoken of where they would be right
    assert_int_equal(strstr(error.text, " deg are ") != NULL,
                     strstr(wrong[i].says, " deg are ") != NULL);
    assert_memory_equal(&bicycle, &untouched, sizeof bicycle);
    bike_parameters_free(p);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_changed_number_is_an_edited_file),
      cmocka_unit_test(every_name_means_something),
      cmocka_unit_test(uncertainty_is_kept),
      cmocka_unit_test(impossible_values),
  };
  return cmocka_run_group_tests(tests, scratch_create, scratch_remove);
}
