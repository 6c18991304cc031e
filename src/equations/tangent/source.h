// SPDX-License-Identifier: Apache-2.0
// What lower.py reads, preprocessed: the kernel with `real` as an opaque type. Never compiled.
typedef struct real real;

real real_of(double x);
real real_sqrt(real x);
void real_sincos(real x, real *s, real *c);
real real_anew(real x);

#include "equations/kernel/generic_model.h"

#include "equations/kernel/kernel.h"

#include "equations/kernel/forces.h"
