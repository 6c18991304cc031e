// SPDX-License-Identifier: Apache-2.0
// One axis of a sweep: what it changes, and its values.
#ifndef SWEEP_SPEC_AXIS_H
#define SWEEP_SPEC_AXIS_H

#include "files/yaml.h"
#include "spec.h"

// Appends the axis that a `name: values` pair describes; the bicycle has been read.
int sweep_read_axis(sweep_spec *spec, const bike_yaml *yaml, const bike_field *field);

// A whole number from `low` to `high`.
int sweep_read_whole(double *out, const bike_yaml *yaml, const bike_field *field, double low,
                     double high);

#endif
