// SPDX-License-Identifier: Apache-2.0
#include <bicycle/variant.h>

#include <bicycle/error.h>
#include <math.h>
#include <stddef.h>

#include "motion/variant_complex.h"

static const double PI = 3.14159265358979323846;

typedef struct words {
  const char *name, *unit;
  const char *held[2]; // front in space, front on the axis
} words;

#define ALIKE(text)                                                                                \
  { text, text }

static const words all[BIKE_VARIATIONS] = {
    [BIKE_VARY_TRAIL] = {"trail",
                         "m",
                         {"head angle, wheelbase, radii; handlebar and fork fixed in space",
                          "head angle, wheelbase, radii; handlebar and fork fixed to the steering "
                          "axis"}},
    [BIKE_VARY_HEAD_ANGLE] = {"head angle",
                              "rad",
                              {"trail, wheelbase, radii; handlebar and fork fixed in space",
                               "trail, wheelbase, radii; handlebar and fork fixed to the steering "
                               "axis"}},
    [BIKE_VARY_WHEEL_INERTIA] =
        {"wheel inertia, both", "kg m^2",
         ALIKE("ratio of the wheels' inertias; masses, diametral inertias, lengths")},
    [BIKE_VARY_FRONT_WHEEL_INERTIA] =
        {"wheel inertia, front", "kg m^2",
         ALIKE("rear wheel's inertia; masses, diametral inertias, lengths")},
    [BIKE_VARY_STEERING_INERTIA] = {"steering inertia", "kg m^2",
                                    ALIKE("masses and their places, lengths")},
    [BIKE_VARY_RIDER_FORWARD] = {"rider forward", "m",
                                 ALIKE("rider's height and inertia, bicycle")},
    [BIKE_VARY_STEER_DAMPING] = {"steer damping", "N m s/rad", ALIKE("everything else")},
};

static bool known(bike_variation variation) {
  return variation >= 0 && variation < BIKE_VARIATIONS;
}

const char *bike_variation_name(bike_variation variation) {
  return known(variation) ? all[variation].name : "unknown";
}

const char *bike_variation_unit(bike_variation variation) {
  return known(variation) ? all[variation].unit : "";
}

const char *bike_variation_held(bike_variation variation, bike_front_hold hold) {
  return known(variation) ? all[variation].held[hold == BIKE_FRONT_ON_AXIS] : "";
}

int bike_variation_value(double *out, const bike_bicycle *bicycle, bike_variation variation) {
  if (!out || !bicycle || !known(variation)) return BIKE_ERROR_ARGUMENT;
  vary_bicycle b;
  number value;
  int code = vary_read(&b, bicycle);
  if (!code) code = vary_value(&value, &b, variation);
  if (!code) *out = creal(value);
  return code;
}

int bike_vary(bike_bicycle *out, const bike_bicycle *bicycle, bike_variation variation,
              double value, bike_front_hold hold) {
  if (!out || !bicycle || !known(variation)) return BIKE_ERROR_ARGUMENT;
  if (!(fabs(value) <= BIKE_LARGEST)) return BIKE_ERROR_NOT_FINITE;
  bool angle = variation == BIKE_VARY_HEAD_ANGLE; // the axis turned by half a turn is another one
  if (angle && !(value > 0 && value < PI)) return BIKE_ERROR_PARAMETER;
  vary_bicycle b;
  int code = vary_read(&b, bicycle);
  if (!code) code = vary_apply(&b, variation, value, hold);
  if (code) return code;
  bike_bicycle changed = *bicycle;
  vary_write(&changed, &b);
  code = bike_check(&changed, NULL, NULL);
  if (!code) *out = changed;
  return code;
}
