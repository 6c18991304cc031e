// SPDX-License-Identifier: Apache-2.0
// Whether a peer solves the same problem, before its time is taken.
#ifndef BICYCLE_BENCH_AGREEMENT_H
#define BICYCLE_BENCH_AGREEMENT_H

#include "../list.h"
#include "sympy_bicycle.h"

// The largest difference, relative to the largest expected acceleration or 1, whichever is larger.
double acceleration_difference(const bike_acceleration *actual, const bike_acceleration *expected);

// Notes the worst disagreement of sympy's accelerations with ours (native.h, which is what is
// timed) over random states as a check. False with a reason where either has no answer at most of
// them.
bool sympy_agreement(bench_notes *notes, sympy_accelerator *accelerate, const sympy_bicycle *p,
                     const bench_subject *subject);

#endif
