// SPDX-License-Identifier: Apache-2.0
// The kernel: one source for every number type. The including file defines
//   real                          double, double complex, or a GCC vector of doubles
//   real_sqrt, real_sincos        on it
//   kernel_model, kernel_geometry bike_model and bike_geometry with members of type real
// and gets `solve_instant`. No function here compares, branches on a value, or assigns a plain
// number to a `real`, so that derivatives by complex step are exact and lanes stay independent.
#ifndef BICYCLE_KERNEL_H
#define BICYCLE_KERNEL_H

#include "vector.h"

#include "geometry.h"

#include "kinematics.h"

#include "dynamics.h"

// An instant: everything between a state and its accelerations.
typedef struct instant {
  position at;
  rate_forms forms;
  rates rate;
  bias rest;
  kane k;
  form acceleration; // phi'', kappa'', v'
} instant;

// What follows from a position, which `locate` has put into out->at.
static inline void solve_located(instant *out, const kernel_model *m, form u, const load *in) {
  const kernel_geometry *L = &m->geometry;
  rate_forms_of(&out->forms, &out->at, m);
  rates_at(&out->rate, &out->forms, &out->at, L, u);
  bias_of(&out->rest, &out->at, m, &out->rate);
  kane *k = &out->k;
  inertia G;
  place_masses(&k->body, m, &out->at, in->w);
  inertia_of(&G, &k->body, &out->at, L->R_r);
  mass_matrix(k, &G, &out->forms, m->rear.spin_inertia, m->front.spin_inertia);
  move_frame(k, m, &out->at, &out->rate);
  need_at_rest(k, m, &out->rate, in);
  forces_along(k, m, &out->at, &out->forms, &out->rate, &out->rest, in);
  out->acceleration = solved(k);
}

static inline void solve_instant(instant *out, const kernel_model *m, start from, real phi,
                                 real kappa, form u, const load *in) {
  locate(&out->at, &m->geometry, from, phi, kappa);
  solve_located(out, m, u, in);
}

#endif
