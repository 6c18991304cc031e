// SPDX-License-Identifier: Apache-2.0
#include "equations/upright_axes.h"

#include <math.h>

double geometry_reach(const bike_geometry *g) {
  return fabs(g->L_r) + fabs(g->L_f) + fabs(g->L_s) + g->R_r + g->R_f;
}

upright_axes upright_axes_of(const bike_geometry *geometry, const bike_upright *upright) {
  return (upright_axes){.s = sin(upright->tilt),
                        .c = cos(upright->tilt),
                        .axis_ground = upright->axis_ground,
                        .foot_height = upright->foot_height,
                        .L_r = geometry->L_r,
                        .L_s = geometry->L_s};
}

void upright_place(double out[3], const upright_axes *axes, const double position[3], bool front) {
  double forward = position[0] - axes->axis_ground, up = position[2];
  out[0] = -position[1];
  out[1] = forward * axes->c + up * axes->s;
  out[2] = up * axes->c - forward * axes->s - axes->foot_height;
  if (front) return;
  out[1] += axes->L_r;
  out[2] -= axes->L_s;
}

void upright_tensor(double out[6], const upright_axes *axes, const double inertia[6]) {
  double s = axes->s, c = axes->c;
  double ff = inertia[0], ll = inertia[1], uu = inertia[2];
  double fl = inertia[3], fu = inertia[4], lu = inertia[5];
  out[0] = ll;
  out[1] = c * c * ff + s * s * uu + 2 * s * c * fu;
  out[2] = s * s * ff + c * c * uu - 2 * s * c * fu;
  out[3] = -(c * fl + s * lu);
  out[4] = s * fl - c * lu;
  out[5] = s * c * (uu - ff) + (c * c - s * s) * fu;
}
