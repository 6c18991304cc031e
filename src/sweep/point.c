// SPDX-License-Identifier: Apache-2.0
#include "point.h"

#include "philox.h"
#include "terminal/number.h"

#include <bicycle/error.h>
#include <stdio.h>
#include <string.h>

static double value_of(const sweep_axis *axis, const sweep_spec *spec, long place, long index) {
  switch (axis->law) {
  case SWEEP_LIST:
    return axis->list[place];
  case SWEEP_GRID:
    return term_range_point(&(term_range){axis->a, axis->b, axis->count}, place);
  case SWEEP_UNIFORM:
    return axis->a + (axis->b - axis->a) * philox_uniform(spec->seed, index, axis->stream);
  case SWEEP_NORMAL:
    return axis->a + axis->b * philox_normal(spec->seed, index, axis->stream);
  }
  return 0;
}

void sweep_values_at(double out[SWEEP_MOST_AXES], const sweep_spec *spec, long index) {
  long place = index / spec->draws;
  for (int i = spec->axis_count - 1; i >= 0; i--) {
    const sweep_axis *axis = &spec->axes[i];
    out[i] = value_of(axis, spec, place % axis->count, index);
    place /= axis->count;
  }
}

static void refuse(sweep_point *out, int code, const char *subject, const char *why) {
  out->code = code;
  snprintf(out->error, sizeof out->error, "%s%s%.*s", subject, *subject ? ": " : "",
           SWEEP_REASON_SIZE - 100, why);
}

// The bicycle of the file with its numbers changed, then its properties in the order of the spec.
static bool make_bicycle(bike_bicycle *out, sweep_point *point, const sweep_spec *spec) {
  int index[SWEEP_MOST_AXES], count = 0;
  double value[SWEEP_MOST_AXES];
  bike_file_error error = {""};
  for (int i = 0; i < spec->axis_count; i++) {
    if (spec->axes[i].target != SWEEP_FILE_NUMBER) continue;
    index[count] = spec->axes[i].index;
    value[count++] = point->values[i];
  }
  int code = bike_parameters_apply(out, spec->parameters, index, value, count, &error);
  if (code) refuse(point, code, "", error.text[0] ? error.text : bike_error_string(code));
  for (int i = 0; !code && i < spec->axis_count; i++) {
    const sweep_axis *axis = &spec->axes[i];
    if (axis->target != SWEEP_PROPERTY) continue;
    code = bike_vary(out, out, (bike_variation)axis->index, point->values[i], spec->front);
    if (code) refuse(point, code, axis->name, bike_error_string(code));
  }
  return !code;
}

static void set_start(sweep_point *out, const sweep_spec *spec) {
  for (int i = 0; i < spec->axis_count; i++) {
    const double value = out->values[i];
    switch (spec->axes[i].target) {
    case SWEEP_SPEED:
      out->start.speed = value;
      break;
    case SWEEP_LEAN:
      out->start.lean = value;
      break;
    case SWEEP_STEER:
      out->start.steer = value;
      break;
    case SWEEP_LEAN_RATE:
      out->start.lean_rate = value;
      break;
    case SWEEP_STEER_RATE:
      out->start.steer_rate = value;
      break;
    case SWEEP_RIDER_OFFSET:
      out->rider_offset = value;
      break;
    case SWEEP_FILE_NUMBER:
    case SWEEP_PROPERTY:
      break;
    }
  }
}

void sweep_point_at(sweep_point *out, const sweep_spec *spec, long index) {
  bike_bicycle bicycle;
  memset(out, 0, sizeof *out);
  sweep_values_at(out->values, spec, index);
  set_start(out, spec);
  if (!make_bicycle(&bicycle, out, spec)) return;
  const int code = bike_model_init(&out->model, &bicycle);
  if (code) refuse(out, code, "", bike_error_string(code));
}
