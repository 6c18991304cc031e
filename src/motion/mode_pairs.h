// SPDX-License-Identifier: Apache-2.0
// Eigenvalues beside a collision, and two oscillations followed from one on.
#ifndef BICYCLE_MOTION_MODE_PAIRS_H
#define BICYCLE_MOTION_MODE_PAIRS_H

#include <bicycle/stability.h>
#include <complex.h>

// The two of four eigenvalues that are closest, at a collision one double eigenvalue.
typedef struct mode_cluster {
  double complex centre;
  double complex others[2]; // in falling order
} mode_cluster;

mode_cluster mode_cluster_of(const bike_eigenvalues *eigenvalues);

// Of two oscillations the one that came off the real axis at the speed `entry`: its eigenvalue at
// `speed`. No collision lies between. BIKE_ERROR_NO_CONVERGENCE where they come so close to each
// other that they cannot be told apart; errors of bike_upright_eigenvalues.
int mode_pair_follow(double complex *out, const bike_model *model, double entry, double speed);

#endif
