// SPDX-License-Identifier: Apache-2.0
// A bicycle as builders describe it, over complex numbers: an imaginary part of a parameter carries
// the exact derivative with respect to it (complex step) through variations and upright equations.
#ifndef BICYCLE_MOTION_VARIANT_COMPLEX_H
#define BICYCLE_MOTION_VARIANT_COMPLEX_H

#include <bicycle/variant.h>
#include <complex.h>
#include <stdbool.h>

typedef double complex number;

// As bike_part. A wheel's place is its hub and follows the lengths.
typedef struct vary_part {
  bike_assembly assembly;
  bool rider;
  number mass, x, up;
  number inertia[6]; // xx yy zz xy xz yz
} vary_part;

typedef struct vary_bicycle {
  number wheelbase, trail, tilt, R_r, R_f, gravity, steer_damping;
  int part_count;
  vary_part parts[BIKE_MAX_PARTS];
} vary_bicycle;

// From a bicycle; errors of bike_upright_position.
int vary_read(vary_bicycle *out, const bike_bicycle *bicycle);

// The real parts into a bicycle that has the same parts.
void vary_write(bike_bicycle *inout, const vary_bicycle *from);

// As bike_variation_value and bike_vary, without the check of what comes out.
int vary_value(number *out, const vary_bicycle *b, bike_variation variation);
int vary_apply(vary_bicycle *inout, bike_variation variation, number value, bike_front_hold hold);

#endif
