// SPDX-License-Identifier: Apache-2.0
// A block of bicycles in lanes, and the kernel on it; included by what is compiled per set.
#ifndef BICYCLE_BATCH_LANES_BLOCK_H
#define BICYCLE_BATCH_LANES_BLOCK_H

#include "batch/lanes.h"
#include "equations/instruction_set.h"
#include "equations/number_lanes.h"

#include <string.h>

struct lanes_models {
  kernel_model model;
  real reach;
};

// Arrays of users need not be aligned as vectors are.
static inline real loaded(const double *from) {
  real x;
  memcpy(&x, from, sizeof x);
  return x;
}

// As rear_angle_found.
static inline lanes_mask lanes_found(root_checks g, real reach) {
  const double tolerance = 4 * 2.220446049250313e-16, flat = 1e-9;
  real nought = reach - reach;
  return (lanes_abs(g.residual) <= tolerance * reach) & (g.Q > nought) & (g.c_br > flat + nought) &
         (g.c_kap > flat + nought) & (g.c_psi > flat + nought);
}

#endif
