// SPDX-License-Identifier: Apache-2.0
// Oracle: the nine equations (18)-(22) of the paper, solved for phi'', kappa'', v', F_r and F_f,
// and its corrected equation of motion (23).
#ifndef BICYCLE_TESTS_NINE_EQUATIONS_H
#define BICYCLE_TESTS_NINE_EQUATIONS_H

#include "paper_motion.h"

typedef struct nine_solution {
  paper_acceleration acceleration;
  vec F_r, F_f;        // N  of the ground on the wheels, in the moving basis
  paper_motion motion; //    at these accelerations
} nine_solution;

// False where there is no geometry or the nine equations are singular.
bool nine_solve(nine_solution *out, const bike_bicycle *bicycle, const bike_state *state,
                const bike_input *input);

// A force in the moving basis along (e_R, horizontal left, up), as bike_snapshot gives it.
void nine_level(double out[3], const paper_motion *motion, vec force);

// Corrected (23), with `weight_sign` -1 as corrected (p' - G) or +1 as printed (p' + G): the
// residual's length over the sum of the lengths of its terms. It is zero at the true accelerations;
// its three components have rank 1 where kappa or phi vanish.
real equation_23(const bike_bicycle *bicycle, const bike_state *state, const bike_input *input,
                 const paper_motion *motion, int weight_sign);

#endif
