// SPDX-License-Identifier: Apache-2.0
// The peer: sympy's nonlinear Kane model of the same bicycle (derive.py), ready to be called.
//
// Both sides of a contest are given lean, steer, their rates and the speed, and answer with three
// accelerations. What depends on these alone is found by both: here the tilt of the steering axis
// by Newton's method on sympy's own height of the front contact, from the start that our kernel
// takes, and the dependent speeds and accelerations by the elimination that sympy derived. Our side
// finds beta_r by its three Newton steps.
#ifndef BICYCLE_BENCH_SYMPY_BICYCLE_H
#define BICYCLE_BENCH_SYMPY_BICYCLE_H

#include <bicycle/state.h>

// Lengths as in bike_geometry. Four rigid bodies: r rear frame, w rear wheel, f fork, v front
// wheel. Centres are (x forward of, z up along) the steering axis' frame, from the rear hub and
// from the foot point; tensors about the centres. Laterally symmetric.
typedef struct sympy_bicycle {
  double R_r, R_f, L_r, L_f, L_s, gravity, damping;
  double m_r, x_r, z_r, r_xx, r_yy, r_zz, r_xz;
  double m_w, w_xx, w_yy;
  double m_f, x_f, z_f, f_xx, f_yy, f_zz, f_xz;
  double m_v, v_xx, v_yy;
  double tilt, tilt_gain; // where Newton's method starts: of bike_model
} sympy_bicycle;

// False where the bicycle is not laterally symmetric: the peer knows no such bicycles.
bool sympy_bicycle_init(sympy_bicycle *out, const bike_bicycle *bicycle, const bike_model *model);

// Accelerations from KanesMethod's mass matrix and forcing, 6 x 6, solved numerically: what its
// users call. False where Newton's method does not settle.
bool sympy_accelerate(bike_acceleration *out, const sympy_bicycle *p, const bike_state *state);

// The same from a 3 x 3 system, the dependent speeds eliminated symbolically before C is written:
// as good as sympy's C gets.
bool sympy_accelerate_reduced(bike_acceleration *out, const sympy_bicycle *p,
                              const bike_state *state);

// Either of the two.
typedef bool sympy_accelerator(bike_acceleration *out, const sympy_bicycle *p,
                               const bike_state *state);

// The first, compiled with -ftree-slp-vectorize.
sympy_accelerator sympy_accelerate_paired;

#endif
