// SPDX-License-Identifier: Apache-2.0
// Linearisation of the corrected model: exact derivatives of the one nonlinear kernel.
#ifndef BICYCLE_LINEAR_H
#define BICYCLE_LINEAR_H

#include <bicycle/state.h>

// M q'' + v C1 q' + (g K0 + v^2 K2) q = f with q = (lean, steer), f = (roll torque, steer torque),
// row-major: the form of Meijaard et al. (2007), equation (5.3); steer is LEFT positive here, so
// the off-diagonal entries have the opposite sign of the literature's. Rigid rider at offset zero,
// no steer damping.
typedef struct bike_upright_matrices {
  double M[4];  // kg m^2
  double C1[4]; // kg m
  double K0[4]; // kg m
  double K2[4]; // kg
} bike_upright_matrices;

// x' = A x + B u about a state, at constant energy: x = (steer, lean, steer_rate, lean_rate),
// u = (steer torque, roll torque, rider offset's acceleration). Row-major.
typedef struct bike_linear {
  double A[16]; // 1/s and products
  double B[12]; //
} bike_linear;

// Matrices of upright straight riding. BIKE_ERROR_NOT_STATIONARY for a bicycle that is not
// mirror-symmetric; errors of bike_mass_matrix. Results are finite where the code is 0.
BIKE_API int bike_linearize_upright(bike_upright_matrices *out, const bike_model *model);

// A and B at a state, which need not be stationary (the derivative is of the accelerations with
// the speed slaved to the energy, as in the paper's section 4; steer damping included). Errors:
// those of bike_evaluate; SINGULAR where no speed keeps the energy (standing, but for upright);
// NOT_FINITE where an entry would not be finite. Results are finite where the code is 0.
BIKE_API int bike_linearize(bike_linear *out, const bike_model *model, const bike_state *state,
                            const bike_input *input);

#endif
