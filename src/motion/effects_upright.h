// SPDX-License-Identifier: Apache-2.0
// The published equations of upright riding over complex numbers.
#ifndef BICYCLE_MOTION_EFFECTS_UPRIGHT_H
#define BICYCLE_MOTION_EFFECTS_UPRIGHT_H

#include "motion/variant_complex.h"

// As bike_upright_matrices, in the literature's signs: steer to the RIGHT.
typedef struct upright_equations {
  number M[4], C1[4], K0[4], K2[4];
} upright_equations;

// Meijaard et al. (2007), appendix A, for parts in any number. Mirror-symmetric bicycles only.
upright_equations upright_equations_of(const vary_bicycle *b);

// The functions of the speed that vanish where a real eigenvalue is zero (capsize) and where two
// are opposite, an imaginary pair among them (weave).
typedef struct critical_functions {
  number capsize, weave;
} critical_functions;

critical_functions critical_functions_at(const vary_bicycle *b, number speed);

#endif
