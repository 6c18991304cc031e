// SPDX-License-Identifier: Apache-2.0
// The kernel: one source for every number type. The including file defines
//   real                          double, double complex, or a GCC vector of doubles
//   real_sqrt, real_sincos        on it
//   real_anew                     the same number, of unknown origin
//   kernel_model, kernel_geometry bike_model and bike_geometry with members of type real
// and gets `solve_instant`. No function here compares or branches on a `real`, or assigns a plain
// number to one, so that derivatives by complex step are exact and lanes stay independent.
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

// What tells whether the equations hold at an instant.
typedef struct checks {
  root_checks root;
  real D;                             // as in `position`
  real pivot_v, pivot_kap, pivot_phi; // as in `kane`
  real diagonal_kap, diagonal_phi;    // of M
} checks;

static inline checks checks_of(const instant *now) {
  const kane *k = &now->k;
  return (checks){
      root_checks_of(&now->at), now->at.D, k->pivot[0], k->pivot[1], k->pivot[2], k->M[1], k->M[0]};
}

// What follows from a position, which out->at holds. Without a load, NULL, the bicycle rides hands
// off and the rider sits still in the middle; whether there is one is known when compiling.
static inline void solve_located(instant *out, const kernel_model *m, form u, const load *in) {
  rate_forms_of(&out->forms, &out->at, m);
  rates_at(&out->rate, &out->forms, &out->at, m, u);
  bias_of(&out->rest, &out->at, m, &out->forms, &out->rate);
  kane *k = &out->k;
  inertia G;
  place_masses(&k->body, m, &out->at);
  if (in) move_rider(&k->body, m, in->w);
  inertia_of(&G, &k->body, &out->at, m);
  mass_matrix(k, &G, &out->forms, m->front.spin_inertia);
  move_frame(k, m, &out->at, &out->rate);
  need_at_rest(k, m, &out->at, &out->rate);
  if (in) sway_rider(k, m, in);
  forces_along(k, m, &out->at, &out->forms, &out->rate, &out->rest);
  if (in) add_torques(k, in);
  out->acceleration = solved(k);
}

// As solve_instant where beta_r is known, for derivatives.
static inline void solve_known(instant *out, const kernel_model *m, real s_br, real c_br, real phi,
                               real kappa, form u, const load *in) {
  locate_known(&out->at, &m->geometry, s_br, c_br, phi, kappa);
  solve_located(out, m, u, in);
}

static inline void solve_instant(instant *out, const kernel_model *m, start from, real phi,
                                 real kappa, form u, const load *in) {
  locate(&out->at, &m->geometry, from, phi, kappa);
  solve_located(out, m, u, in);
}

#endif
