// SPDX-License-Identifier: Apache-2.0
// SUNDIALS' serial vectors, of which clones can always be had. N_VClone (SUNDIALS 6.4) reads the
// clone before anybody has looked whether there is one; here it gets a vector in reserve then, and
// the family of vectors remembers that one was missing.
#ifndef BICYCLE_MOTION_VECTOR_H
#define BICYCLE_MOTION_VECTOR_H

#include <nvector/nvector_serial.h>
#include <stdbool.h>

// The first of a family; the others are its clones and theirs. NULL: out of memory.
N_Vector vector_create(sunindextype length, SUNContext context);

// Whether a clone was missing. What was computed since then means nothing.
bool vector_ran_out(N_Vector any);

#endif
