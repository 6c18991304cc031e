// SPDX-License-Identifier: Apache-2.0
// The size of the terms that add up to zero at a turn: what the rounding of its equations is
// measured by. A heavy rider on a light fork leaves more rad/s^2 than a light one, and is as well
// balanced.
#ifndef BICYCLE_MOTION_TURN_TERMS_H
#define BICYCLE_MOTION_TURN_TERMS_H

#include "motion/turn_forces.h"

#include <bicycle/state.h>

// Moments, N m: of the weight and of the torque, and what the circle of v^2 sin(steer) = `swept`
// asks.
double turn_moments(const turn_bicycle *bicycle, const turn_forces *at, double swept,
                    double offset);

// The larger of both rows' terms, rad/s^2 of upright riding.
double turn_row_terms(const turn_bicycle *bicycle, double moments);

// The terms of the accelerations of a state: rad/s^2, rad/s^2, m/s^2. Errors of bike_mass_matrix.
int turn_acceleration_terms(bike_acceleration *out, const turn_bicycle *bicycle,
                            const bike_state *state, double offset, double moments);

#endif
