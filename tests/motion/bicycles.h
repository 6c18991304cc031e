// SPDX-License-Identifier: Apache-2.0
// The shipped bicycles as the tests of motion ride them.
#ifndef BICYCLE_TESTS_MOTION_BICYCLES_H
#define BICYCLE_TESTS_MOTION_BICYCLES_H

#include <bicycle/model.h>

bike_model roadster(void);

// With its rider moved to the right for good: a ride's own rider offset would need an input.
bike_model roadster_with_rider_at(double offset);

// With a viscous steering damper, N m s/rad.
bike_model damped_roadster(double damping);

// Its geometry has no solution at large lean and steer.
bike_model penny_farthing(void);

// Meijaard et al. (2007): no rider that could sway.
bike_model benchmark(void);

// Any of the shipped ones, by name.
bike_model shipped(const char *name);

#endif
