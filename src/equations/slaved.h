// SPDX-License-Identifier: Apache-2.0
// The speed at constant energy: dv = -E_x/E_v dx.
#ifndef BICYCLE_EQUATIONS_SLAVED_H
#define BICYCLE_EQUATIONS_SLAVED_H

#include <bicycle/error.h>
#include <math.h>

// `slaved`, dy/dv, becomes dy/dv / E_v. Straight riding does not feel dv, and there E_v,
// `by_speed`, may be zero; elsewhere that is BIKE_ERROR_SINGULAR.
static inline int slave_to_energy(double *slaved, double by_speed) {
  const double least = 1e-200; // what is smaller may be lost in a complex step
  if (*slaved == 0) return BIKE_OK;
  if (!(fabs(by_speed) > least)) return BIKE_ERROR_SINGULAR;
  *slaved /= by_speed;
  return BIKE_OK;
}

#endif
