// SPDX-License-Identifier: Apache-2.0
// Oracle: the geometry (1)-(7) of Franke, Suhr, Riess, Eur. J. Phys. 11 (1990) 116-121, in jets.
//
// Written from the paper, apart from the library: its root comes from continuation, its time
// derivatives from jet arithmetic.
#ifndef BICYCLE_TESTS_PAPER_GEOMETRY_H
#define BICYCLE_TESTS_PAPER_GEOMETRY_H

#include "jet.h"
#include <bicycle/bicycle.h>
#include <stdbool.h>

// Angles and lengths of the paper's figure 1 with their time derivatives.
typedef struct paper_pose {
  jet phi, kappa;     // rad  steer, lean
  jet beta_r, beta_f; // rad  (4), (1)
  jet psi, phi_tilde; // rad  (2), (3)
  jet T_f, T_r, Z_0;  // m    (5), (6), (7)
} paper_pose;

// Follows the root of (4) from the upright position along the straight line to (phi, kappa); false
// where it ends on the way. `margin` (may be NULL): the smallest value on the way of all that the
// equations divide by, as a number near 1 at small angles (lengths over the wheelbase).
bool paper_root(real *beta_r, real *margin, const bike_geometry *geometry, real phi, real kappa);

// Pose for jets of the two variables, given the root beta_r of (4) at their values.
paper_pose paper_pose_of(const bike_geometry *geometry, jet phi, jet kappa, real root);

#endif
