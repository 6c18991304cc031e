// SPDX-License-Identifier: Apache-2.0
// From the upright bicycle's (forward, left, up) to the reference axes (N right, p, S up along the
// steering axis) of figure 1.
#ifndef BICYCLE_EQUATIONS_UPRIGHT_AXES_H
#define BICYCLE_EQUATIONS_UPRIGHT_AXES_H

#include <bicycle/bicycle.h>

typedef struct upright_axes {
  double s, c;        // of the tilt: e_p = c f + s u, e_S = -s f + c u, e_N = -left
  double axis_ground; // m  the steering axis meets the ground before the rear contact
  double foot_height; // m  Z_0
  double L_r, L_s;    // m  rear hub at (0, -L_r, L_s)
} upright_axes;

// m  |L_r| + |L_f| + |L_s| + R_r + R_f: size of the terms of (4).
double geometry_reach(const bike_geometry *geometry);

upright_axes upright_axes_of(const bike_geometry *geometry, const bike_upright *upright);

// Place in (N, p, S) from the rear hub, or, of a front part, from the steering axis' foot point.
void upright_place(double out[3], const upright_axes *axes, const double position[3], bool front);

// Tensor (Ixx, Iyy, Izz, Ixy, Ixz, Iyz) in (forward, left, up) to (NN, pp, SS, Np, NS, pS).
void upright_tensor(double out[6], const upright_axes *axes, const double inertia[6]);

#endif
