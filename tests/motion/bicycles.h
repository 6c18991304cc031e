// SPDX-License-Identifier: Apache-2.0
// Bicycles for tests of motion, made in code so that these tests stand on no file.
#ifndef BICYCLE_TESTS_MOTION_BICYCLES_H
#define BICYCLE_TESTS_MOTION_BICYCLES_H

#include <bicycle/model.h>

// This project's city bicycle with its rider: point masses, rank-1 inertias, trail 7 cm.
bike_model roadster(void);

// The same with a viscous steering damper, N m s/rad.
bike_model damped_roadster(double damping);

// Also this project's; its geometry has no solution at large lean and steer.
bike_model penny_farthing(void);

// Benchmark of Meijaard et al. (2007), table 1: full tensors, no rider.
bike_model benchmark(void);

#endif
