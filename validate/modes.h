// SPDX-License-Identifier: Apache-2.0
// Modes of any engine that can be linearised: eigenvalues, and the speeds at which they change
// sides.
#ifndef VALIDATE_MODES_H
#define VALIDATE_MODES_H

#include "engine.h"

#include <bicycle/stability.h>

term_exit modes_at(bike_eigenvalues *out, const engine *e, void *instance, double speed,
                   problem *p);

// Largest |difference|/max(1, |eigenvalue|) of two sets of four, matched so that it is smallest.
double modes_difference(const bike_eigenvalues *a, const bike_eigenvalues *b);

// Weave and capsize speeds between the speeds of a grid on which `modes` has been evaluated; no
// stable ranges. Found from eigenvalues alone, independently of the library's own search.
term_exit modes_critical_speeds(bike_critical_speeds *out, const engine *e, void *instance,
                                const double *speed, const bike_eigenvalues *modes, int count,
                                problem *p);

#endif
