// SPDX-License-Identifier: Apache-2.0
// The kernel over complex numbers: the imaginary part carries an exact derivative (complex step).
#ifndef BICYCLE_NUMBER_COMPLEX_H
#define BICYCLE_NUMBER_COMPLEX_H

#include <bicycle/model.h>
#include <complex.h>

typedef double complex real;

typedef struct kernel_geometry {
  real L_r, L_f, L_s, R_r, R_f;
} kernel_geometry;

typedef struct kernel_body {
  real mass;
  real centre[3];
  real inertia[6];
  real spin_inertia;
} kernel_body;

// bike_model with complex members.
typedef struct kernel_model {
  kernel_geometry geometry;
  real gravity, steer_damping;
  kernel_body rear, front;
  real rider_mass;
  real rider_arm[3];
} kernel_model;

static inline real real_sqrt(real z) {
  return csqrt(z);
}

static inline void real_sincos(real z, real *s, real *c) {
  *s = csin(z);
  *c = ccos(z);
}

#include "kernel/kernel.h"

#include "kernel/forces.h"

static inline kernel_body complex_body(const bike_body *b) {
  kernel_body c = {.mass = b->mass, .spin_inertia = b->spin_inertia};
  for (int i = 0; i < 3; i++) c.centre[i] = b->centre[i];
  for (int i = 0; i < 6; i++) c.inertia[i] = b->inertia[i];
  return c;
}

static inline kernel_model complex_model(const bike_model *m) {
  const bike_geometry *g = &m->geometry;
  kernel_model c = {.geometry = {g->L_r, g->L_f, g->L_s, g->R_r, g->R_f},
                    .gravity = m->gravity,
                    .steer_damping = m->steer_damping,
                    .rear = complex_body(&m->rear),
                    .front = complex_body(&m->front),
                    .rider_mass = m->rider_mass};
  for (int i = 0; i < 3; i++) c.rider_arm[i] = m->rider_arm[i];
  return c;
}

#endif
