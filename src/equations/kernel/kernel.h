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

static inline void build_bodies(kane *k, const kernel_model *m, const position *g,
                                const load *in) {
  rear_body(&k->rear, m, in);
  front_body(&k->front, m);
  k->up_rear = (vec){-g->s_kap, g->c_kap * g->s_br, g->a};
  k->up_front = (vec){-g->s_psi, g->tau, g->a};
}

static inline void solve_instant(instant *out, const kernel_model *m, start from, real phi,
                                 real kappa, form u, const load *in) {
  const kernel_geometry *L = &m->geometry;
  locate(&out->at, L, from, phi, kappa);
  rate_forms_of(&out->forms, &out->at, L);
  rates_at(&out->rate, &out->forms, &out->at, L, u);
  bias_of(&out->rest, &out->at, L, &out->rate);
  build_bodies(&out->k, m, &out->at, in);
  partials_of(&out->k, &out->at, L, &out->forms);
  accelerations_at_rest(&out->k, &out->at, L, &out->rate, &out->rest, in,
                        m->rider_mass / m->rear.mass);
  equations_of_motion(&out->k, m, &out->rate, &out->rest, in);
  out->acceleration = solved(&out->k);
}

#endif
