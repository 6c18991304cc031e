// SPDX-License-Identifier: Apache-2.0
// scipy's rides over sympy's C (scipy_peer.py), as pieces of work.
#ifndef BICYCLE_BENCH_SCIPY_H
#define BICYCLE_BENCH_SCIPY_H

#include "../list.h"
#include "python.h"

typedef struct scipy_ride {
  python_peer *peer;
  const char *method; // of scipy_peer.py
  double tolerance;   // rtol and atol
} scipy_ride;

// Gives the child the bicycle, its start, and the states at the end of the ride. False with a
// reason.
bool scipy_load(python_peer *peer, const bench_subject *subject, const double *end,
                bench_notes *notes);

// Finds the tolerance for an end error, and notes what that costs. False with a reason.
bool scipy_tune(scipy_ride *ride, double error, bench_notes *notes);

// `ride` is a scipy_ride.
double scipy_rides(void *ride, long repeats);

#endif
