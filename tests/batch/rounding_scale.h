// SPDX-License-Identifier: Apache-2.0
// How much rounding may change accelerations.
#ifndef BICYCLE_TESTS_BATCH_ROUNDING_SCALE_H
#define BICYCLE_TESTS_BATCH_ROUNDING_SCALE_H

#include <bicycle/state.h>

// The size of what cancels in the accelerations a = M^-1 f, hands off: with f a sum of gravity,
// damping and products of two speeds, f = sum_n f_n,
//   scale_i = sum_j |M^-1_ij| (sum_n |f_n,j| + sum_k |M_jk| |a_k|).
// M^-1 and f_n come from bike_mass_matrix and from bike_accelerate with some of the speeds zero. A
// relative rounding u of each term and of each entry of M changes a_i by u scale_i at most.
bike_acceleration rounding_scale(const bike_model *model, const bike_state *state);

#endif
