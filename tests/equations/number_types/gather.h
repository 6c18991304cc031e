// SPDX-License-Identifier: Apache-2.0
// The results of an instant in the order of instance_result, for any `real`.
#ifndef BICYCLE_TESTS_GATHER_H
#define BICYCLE_TESTS_GATHER_H

#include "instances.h"

static inline void gather(real out[INSTANCE_RESULTS], const instant *now, const kernel_model *m,
                          const load *in) {
  energy e = energy_of(now, m, in);
  ground g = ground_forces(now, m, in);
  form a = now->acceleration;
  real all[INSTANCE_RESULTS] = {a.phi,    a.kap,    a.v,       e.kinetic, e.potential, g.rear.x,
                                g.rear.y, g.rear.z, g.front.x, g.front.y, g.front.z};
  for (int i = 0; i < INSTANCE_RESULTS; i++) out[i] = all[i];
}

#endif
