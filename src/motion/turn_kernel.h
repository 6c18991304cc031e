// SPDX-License-Identifier: Apache-2.0
// Forces of stationary motion over the kernel's number type: included after number_double.h or
// number_complex.h.
#ifndef BICYCLE_MOTION_TURN_KERNEL_H
#define BICYCLE_MOTION_TURN_KERNEL_H

// Kane's generalised forces at rest in lean and steer, (steer, lean); what they need to vanish.
// `rear`: sin, cos of beta_r.
static inline void forces_at_rest(real out[2], const kernel_model *model, const double rear[2],
                                  real phi, real kappa, real w, real v) {
  real nought = w - w;
  load in = {nought, nought, w, nought, nought};
  form u = {nought, nought, v};
  instant now;
  solve_known(&now, model, rear[0], rear[1], phi, kappa, u, &in);
  out[0] = now.k.f[0];
  out[1] = now.k.f[1];
}

#endif
