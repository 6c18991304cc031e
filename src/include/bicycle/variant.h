// SPDX-License-Identifier: Apache-2.0
// One property of a bicycle changed, the rest held: what a builder means by "more trail".
//
// Source: section 4, figures 3 and 4 and the list of effects of Franke, Suhr, Riess (1990), which
// do not always say what is held fixed; here every variation does (bike_variation_held).
#ifndef BICYCLE_VARIANT_H
#define BICYCLE_VARIANT_H

#include <bicycle/bicycle.h>

typedef enum bike_variation {
  BIKE_VARY_TRAIL,               // m          of the front contact behind the steering axis
  BIKE_VARY_HEAD_ANGLE,          // rad        of the steering axis from the horizontal
  BIKE_VARY_WHEEL_INERTIA,       // kg m^2     front wheel about its hub, the rear one in proportion
  BIKE_VARY_FRONT_WHEEL_INERTIA, // kg m^2     front wheel alone; zero: its spin is compensated,
                                 //            which for upright riding is the same as no spin
  BIKE_VARY_STEERING_INERTIA,    // kg m^2     Theta_S of the front frame about the steering axis
  BIKE_VARY_RIDER_FORWARD,       // m          rider moved forward from the place in the file
  BIKE_VARY_STEER_DAMPING,       // N m s/rad
  BIKE_VARIATIONS
} bike_variation;

// Where handlebar and fork stay when trail or head angle changes; no difference to the others.
typedef enum bike_front_hold {
  BIKE_FRONT_IN_SPACE, // their mass and tensor keep place and direction in space
  BIKE_FRONT_ON_AXIS   // both keep their place relative to the steering axis and to the foot of the
                       // perpendicular from the front hub: the paper's x0 is constant
} bike_front_hold;

BIKE_API const char *bike_variation_name(bike_variation variation); // "trail", ...
BIKE_API const char *bike_variation_unit(bike_variation variation); // "m", ...

// What does not change, in words.
BIKE_API const char *bike_variation_held(bike_variation variation, bike_front_hold hold);

// The present value. BIKE_ERROR_NO_RIDER for the rider of a bicycle without one,
// BIKE_ERROR_PARAMETER where there is nothing to vary (no front frame, a front wheel without
// inertia for both wheels'); errors of bike_upright_position.
BIKE_API int bike_variation_value(double *out, const bike_bicycle *bicycle,
                                  bike_variation variation);

// The bicycle with the property at `value`. Same errors, and those of bike_check for what comes
// out; PARAMETER also for a head angle that is not between 0 and pi; `out` is then untouched.
BIKE_API int bike_vary(bike_bicycle *out, const bike_bicycle *bicycle, bike_variation variation,
                       double value, bike_front_hold hold);

#endif
