// SPDX-License-Identifier: Apache-2.0
// SUNDIALS' serial vectors for the state of a ride. With its size known to the compiler, and sums
// over all stages in one call, the integrator adds a third of what it did.
#ifndef BICYCLE_MOTION_RIDE_VECTOR_H
#define BICYCLE_MOTION_RIDE_VECTOR_H

#include <nvector/nvector_serial.h>

// Over RIDE_SIZE numbers of the caller; clones have the same operations. NULL: out of memory.
N_Vector ride_vector_over(realtype *data, SUNContext context);

#endif
