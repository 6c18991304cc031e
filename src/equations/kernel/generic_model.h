// SPDX-License-Identifier: Apache-2.0
// bike_model with members of type `real`, for number types other than double. The including file
// also defines real real_of(double).
#ifndef BICYCLE_KERNEL_GENERIC_MODEL_H
#define BICYCLE_KERNEL_GENERIC_MODEL_H

#include <bicycle/model.h>

typedef struct kernel_geometry {
  real L_r, L_f, L_s, R_r, R_f;
} kernel_geometry;

typedef struct kernel_body {
  real mass;
  real moment[3];
  real inertia[6];
  real spin_inertia;
} kernel_body;

typedef struct kernel_model {
  kernel_geometry geometry;
  real gravity, steer_damping;
  real s_tilt, c_tilt, tilt_gain;
  real newton_scale;
  real over_R_r, over_R_f;
  kernel_body rear, front;
  real rider_mass;
  real rider_place[3];
} kernel_model;

static inline void kernel_body_of(kernel_body *out, const bike_body *b) {
  out->mass = real_of(b->mass);
  for (int i = 0; i < 3; i++) out->moment[i] = real_of(b->moment[i]);
  for (int i = 0; i < 6; i++) out->inertia[i] = real_of(b->inertia[i]);
  out->spin_inertia = real_of(b->spin_inertia);
}

static inline void kernel_model_of(kernel_model *out, const bike_model *m) {
  const bike_geometry *g = &m->geometry;
  out->geometry = (kernel_geometry){real_of(g->L_r), real_of(g->L_f), real_of(g->L_s),
                                    real_of(g->R_r), real_of(g->R_f)};
  out->gravity = real_of(m->gravity);
  out->steer_damping = real_of(m->steer_damping);
  out->s_tilt = real_of(m->s_tilt);
  out->c_tilt = real_of(m->c_tilt);
  out->tilt_gain = real_of(m->tilt_gain);
  out->newton_scale = real_of(m->newton_scale);
  out->over_R_r = real_of(m->over_R_r);
  out->over_R_f = real_of(m->over_R_f);
  kernel_body_of(&out->rear, &m->rear);
  kernel_body_of(&out->front, &m->front);
  out->rider_mass = real_of(m->rider_mass);
  for (int i = 0; i < 3; i++) out->rider_place[i] = real_of(m->rider_place[i]);
}

#endif
