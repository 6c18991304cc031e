// SPDX-License-Identifier: Apache-2.0
#include "spec_axis.h"

#include "files/angle.h"

#include <bicycle/error.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- what it changes ----

static const struct {
  const char *name;
  sweep_target target;
} own_names[] = {
    {"speed", SWEEP_SPEED},           {"lean", SWEEP_LEAN},
    {"steer", SWEEP_STEER},           {"lean_rate", SWEEP_LEAN_RATE},
    {"steer_rate", SWEEP_STEER_RATE}, {"rider_offset", SWEEP_RIDER_OFFSET},
};

// Of bike_variation, without the blanks of its names.
static const char *const properties[BIKE_VARIATIONS] = {
    [BIKE_VARY_TRAIL] = "property.trail",
    [BIKE_VARY_HEAD_ANGLE] = "property.head_angle",
    [BIKE_VARY_WHEEL_INERTIA] = "property.wheel_inertia",
    [BIKE_VARY_FRONT_WHEEL_INERTIA] = "property.front_wheel_inertia",
    [BIKE_VARY_STEERING_INERTIA] = "property.steering_inertia",
    [BIKE_VARY_RIDER_FORWARD] = "property.rider_forward",
    [BIKE_VARY_STEER_DAMPING] = "property.steer_damping",
};

static bool has_rider(const bike_bicycle *bicycle) {
  for (int i = 0; i < bicycle->part_count; i++)
    if (bicycle->parts[i].rider) return true;
  return false;
}

static int check_property(const sweep_spec *spec, const sweep_axis *axis, const bike_yaml *yaml,
                          const bike_field *field) {
  double value;
  const int code = bike_variation_value(&value, &spec->file.bicycle, (bike_variation)axis->index);
  if (!code) return BIKE_OK;
  return bike_yaml_fail(yaml, field, code, "this bicycle has no such property to change");
}

static int find_target(sweep_axis *axis, const sweep_spec *spec, const bike_yaml *yaml,
                       const bike_field *field) {
  for (size_t i = 0; i < sizeof own_names / sizeof *own_names; i++) {
    if (strcmp(field->key, own_names[i].name) != 0) continue;
    axis->target = own_names[i].target;
    if (axis->target == SWEEP_RIDER_OFFSET && !has_rider(&spec->file.bicycle))
      return bike_yaml_fail(yaml, field, BIKE_ERROR_NO_RIDER, "%s",
                            "no part of the bicycle is the rider");
    return BIKE_OK;
  }
  for (int i = 0; i < BIKE_VARIATIONS; i++) {
    if (strcmp(field->key, properties[i]) != 0) continue;
    axis->target = SWEEP_PROPERTY;
    axis->index = i;
    return check_property(spec, axis, yaml, field);
  }
  axis->target = SWEEP_FILE_NUMBER;
  axis->index = bike_parameters_find(spec->parameters, field->key);
  if (axis->index >= 0) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX,
                        "is neither a number of this bicycle's file nor known otherwise (bicycle "
                        "sweep names FILE lists them)");
}

// ---- its values ----

int sweep_read_whole(double *out, const bike_yaml *yaml, const bike_field *field, double low,
                     double high) {
  const int code = bike_yaml_number(yaml, field, out);
  if (code || (*out >= low && *out <= high && floor(*out) == *out)) return code;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER,
                        "must be a whole number from %.0f to %.0f", low, high);
}

static int read_count(const bike_yaml *yaml, const bike_field *field, void *target) {
  double count;
  const int code = sweep_read_whole(&count, yaml, field, 1, SWEEP_MOST_POINTS);
  if (!code) *(long *)target = (long)count;
  return code;
}

static int read_grid(sweep_axis *axis, const bike_yaml *yaml, const bike_field *field) {
  static const bike_key keys[] = {
      {"from", bike_yaml_number, offsetof(sweep_axis, a), true},
      {"to", bike_yaml_number, offsetof(sweep_axis, b), true},
      {"count", read_count, offsetof(sweep_axis, count), true},
  };
  axis->law = SWEEP_GRID;
  const int code = bike_yaml_read(yaml, field, field->value, (bike_keys){keys, 3}, axis);
  if (code) return code;
  if (axis->a > axis->b)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "from %g is above to %g", axis->a,
                          axis->b);
  if ((axis->a == axis->b) == (axis->count == 1)) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER,
                        "count 1 goes with from = to, and the other way round");
}

static int read_uniform(sweep_axis *axis, const bike_yaml *yaml, const bike_field *field) {
  double ends[2];
  const int code = bike_yaml_numbers(yaml, field, ends, 2);
  if (code) return code;
  if (!(ends[0] < ends[1]))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "must be [LOW, HIGH] with LOW < HIGH");
  axis->law = SWEEP_UNIFORM;
  axis->a = ends[0];
  axis->b = ends[1];
  return BIKE_OK;
}

// `normal: file` takes mean and standard uncertainty from the bicycle's file.
static int read_normal(sweep_axis *axis, const sweep_spec *spec, const bike_yaml *yaml,
                       const bike_field *field) {
  double law[2] = {0, 0};
  if (bike_yaml_is_text(field, "file")) {
    if (axis->target == SWEEP_FILE_NUMBER) {
      law[0] = bike_parameters_value(spec->parameters, axis->index);
      law[1] = bike_parameters_sigma(spec->parameters, axis->index);
    }
    if (!(law[1] > 0))
      return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER,
                            "the bicycle's file gives no uncertainty of '%s'", axis->name);
  } else {
    const int code = bike_yaml_numbers(yaml, field, law, 2);
    if (code) return code;
    if (!(law[1] > 0))
      return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER,
                            "must be [MEAN, DEVIATION] with DEVIATION > 0");
  }
  axis->law = SWEEP_NORMAL;
  axis->a = law[0];
  axis->b = law[1];
  return BIKE_OK;
}

static int read_law(sweep_axis *axis, const sweep_spec *spec, const bike_yaml *yaml,
                    const bike_field *field) {
  void *cursor = NULL;
  bike_field inner, more;
  const bool any = bike_yaml_next(field->value, &cursor, &inner);
  if (any && strcmp(inner.key, "uniform") != 0 && strcmp(inner.key, "normal") != 0)
    return read_grid(axis, yaml, field);
  if (!any || bike_yaml_next(field->value, &cursor, &more))
    return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX,
                          "must hold from, to and count, or uniform, or normal");
  return strcmp(inner.key, "uniform") == 0 ? read_uniform(axis, yaml, &inner)
                                           : read_normal(axis, spec, yaml, &inner);
}

static int read_list(sweep_axis *axis, const bike_yaml *yaml, const bike_field *field) {
  const int code = bike_yaml_expect_list(yaml, field);
  if (code) return code;
  long room = 0;
  void *cursor = NULL;
  bike_field entry = *field;
  axis->law = SWEEP_LIST;
  while (bike_yaml_next_entry(field->value, &cursor, &entry)) {
    if (axis->count == room) {
      room = room ? 2 * room : 16;
      double *grown = realloc(axis->list, (size_t)room * sizeof *grown);
      if (!grown) return bike_yaml_fail(yaml, field, BIKE_ERROR_MEMORY, "out of memory");
      axis->list = grown;
    }
    const int wrong = bike_yaml_number(yaml, &entry, &axis->list[axis->count]);
    if (wrong) return wrong;
    axis->count++;
  }
  if (axis->count > 0) return BIKE_OK;
  return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "the list is empty");
}

static bool is_list(const bike_field *field) {
  bike_yaml silent = {.path = ""};
  return bike_yaml_expect_list(&silent, field) == BIKE_OK;
}

static int read_values(sweep_axis *axis, const sweep_spec *spec, const bike_yaml *yaml,
                       const bike_field *field) {
  if (bike_yaml_is_mapping(field)) return read_law(axis, spec, yaml, field);
  if (is_list(field)) return read_list(axis, yaml, field);
  axis->law = SWEEP_GRID; // a single value
  axis->count = 1;
  const int code = bike_yaml_number(yaml, field, &axis->a);
  axis->b = axis->a;
  return code;
}

static int check_twice(const sweep_spec *spec, const bike_yaml *yaml, const bike_field *field) {
  for (int i = 0; i < spec->axis_count; i++)
    if (strcmp(spec->axes[i].name, field->key) == 0)
      return bike_yaml_fail(yaml, field, BIKE_ERROR_SYNTAX, "given twice");
  return BIKE_OK;
}

static int count_streams(const sweep_spec *spec) {
  int streams = 0;
  for (int i = 0; i < spec->axis_count; i++)
    streams += spec->axes[i].law == SWEEP_UNIFORM || spec->axes[i].law == SWEEP_NORMAL;
  return streams;
}

// The angles that an axis must not leave; NULL: it has none.
static const bike_angle_range *angles_of(const sweep_axis *axis) {
  switch (axis->target) {
  case SWEEP_LEAN:
    return &bike_tilt_range;
  case SWEEP_STEER:
    return &bike_steer_range;
  case SWEEP_PROPERTY:
    return axis->index == BIKE_VARY_HEAD_ANGLE ? &bike_head_angle_range : NULL;
  default: // numbers of the file are checked with it
    return NULL;
  }
}

// Degrees would be angles that no bicycle has. Draws of a normal law may have such by
// chance; its mean and deviation are within 100 turns.
static int check_angles(const sweep_axis *axis, const bike_yaml *yaml, const bike_field *field) {
  const bike_angle_range *range = angles_of(axis);
  if (range && axis->law == SWEEP_NORMAL) range = &bike_turns_range;
  const bool listed = axis->law == SWEEP_LIST;
  const double ends[2] = {axis->a, axis->b}, *value = listed ? axis->list : ends;
  const long count = listed ? axis->count : 2;
  char what[BIKE_ANGLE_TEXT];
  if (!range) return BIKE_OK;
  for (long i = 0; i < count; i++)
    if (!bike_angle_check(what, range, value[i]))
      return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "%g %s", value[i], what);
  return BIKE_OK;
}

int sweep_read_axis(sweep_spec *spec, const bike_yaml *yaml, const bike_field *field) {
  if (spec->axis_count == SWEEP_MOST_AXES)
    return bike_yaml_fail(yaml, field, BIKE_ERROR_PARAMETER, "more than %d axes", SWEEP_MOST_AXES);
  sweep_axis axis = {0};
  int code = check_twice(spec, yaml, field);
  if (!code) code = find_target(&axis, spec, yaml, field);
  if (!code) strncpy(axis.name, field->key, sizeof axis.name - 1); // it was found: it fits
  if (!code) code = read_values(&axis, spec, yaml, field);
  if (!code) code = check_angles(&axis, yaml, field);
  if (code) {
    free(axis.list);
    return code;
  }
  if (axis.law == SWEEP_UNIFORM || axis.law == SWEEP_NORMAL) {
    axis.count = 1;
    axis.stream = count_streams(spec);
  }
  spec->axes[spec->axis_count++] = axis;
  return BIKE_OK;
}
