// SPDX-License-Identifier: Apache-2.0
// Newton's method for two or three equations with an exact Jacobian: KINSOL.
#ifndef BICYCLE_MOTION_TURN_NEWTON_H
#define BICYCLE_MOTION_TURN_NEWTON_H

#include <stdbool.h>

enum { NEWTON_MAX = 3 };

// Values and Jacobian (J[i][j] = df_i/dx_j; NULL: not wanted) at x. Nonzero: no such place.
typedef int newton_function(double *f, double J[NEWTON_MAX][NEWTON_MAX], const double *x,
                            const void *user);

typedef struct newton newton;

// For `size` equations; NULL when out of memory.
newton *newton_create(int size);

// Whether the solver has been asked as often as one search may ask: it solves no more, so that
// every loop around it ends.
bool newton_spent(const newton *solver);
void newton_free(newton *solver);

// Improves x until neither residuals nor steps tell anything but rounding, or the iterations are
// used up. Unknowns and residuals should be of the order of one. Whether x solves the equations is
// for the caller to see from *residual, the largest |f_i| there: KINSOL's own verdict is not used.
// Nonzero only where the function failed or the solver is spent; x is then untouched.
int newton_solve(newton *solver, double *x, double *residual, newton_function *function,
                 const void *user);

#endif
