// SPDX-License-Identifier: Apache-2.0
// The kernel in double: evaluations at a state, from a start of Newton's method. Compiled once for
// every instruction set, as state_baseline, state_v3, state_v4, and under -ffinite-math-only
// -fno-signed-zeros, where zeros of the geometry cost nothing: answers.h judges the results.
//
// Straight code, so that the compiler fuses the same products as in the lanes (lanes_accelerate.c)
// and the last digits are the same; all of the kernel inlined, so that what is not asked for is
// never stored, a sixth of the time.
#include "equations/state_instance.h"

#include <string.h>

#define EVALUATION __attribute__((flatten)) static

static form speeds_of(const bike_state *s) {
  return (form){s->steer_rate, s->lean_rate, s->speed};
}

static inline void solve(instant *now, const question *q, const start *from, const load *in) {
  const bike_state *s = q->state;
  start begin = from ? *from : guessed(q->model, s->steer, s->lean);
  solve_instant(now, q->model, begin, s->steer, s->lean, speeds_of(s), in);
}

static bike_acceleration named(form a) {
  return (bike_acceleration){.lean = a.kap, .steer = a.phi, .speed = a.v};
}

// Hinge rates relative to frame and fork, growing when rolling forward (about -e_N).
static double rear_hinge(const instant *now) {
  return now->rate.br - now->rate.spin_r - now->rate.yaw * now->at.s_kap;
}

static double front_hinge(const instant *now) {
  return dot(now->k.velocity.turn, now->k.body.axle_f) - now->rate.spin_f;
}

static double power_of(const instant *now, const bike_model *m, const load *in) {
  double phi = now->rate.u.phi, damped = -m->steer_damping * phi * phi;
  if (!in) return damped;
  return in->steer_torque * phi + damped + in->roll_torque * now->rate.u.kap +
         rider_force(now, m) * in->w1;
}

//---------------------------------- accelerations -------------------------------------------------

static inline checks acceleration_at(void *out, const question *q, const start *from,
                                     const load *in) {
  instant now;
  solve(&now, q, from, in);
  *(bike_acceleration *)out = named(now.acceleration);
  return checks_of(&now);
}

EVALUATION checks free_acceleration(void *out, const question *q, const start *from) {
  return acceleration_at(out, q, from, NULL);
}

EVALUATION checks loaded_acceleration(void *out, const question *q, const start *from) {
  return acceleration_at(out, q, from, &q->in);
}

//---------------------------------- rates ---------------------------------------------------------

static inline checks rates_at_state(void *out, const question *q, const start *from,
                                    const load *in) {
  instant now;
  solve(&now, q, from, in);
  *(bike_rates *)out = (bike_rates){.acceleration = named(now.acceleration),
                                    .yaw = now.rate.yaw,
                                    .rear_angle = rear_hinge(&now),
                                    .front_angle = front_hinge(&now),
                                    .power = power_of(&now, q->model, in)};
  return checks_of(&now);
}

EVALUATION checks free_rates(void *out, const question *q, const start *from) {
  return rates_at_state(out, q, from, NULL);
}

EVALUATION checks loaded_rates(void *out, const question *q, const start *from) {
  return rates_at_state(out, q, from, &q->in);
}

//---------------------------------- mass matrix ---------------------------------------------------

EVALUATION checks mass_matrix_at(void *out, const question *q, const start *from) {
  instant now;
  solve(&now, q, from, &q->in);
  const double *M = now.k.M; // phi phi, kap kap, v v, phi kap, phi v, kap v
  const double rows[9] = {M[1], M[3], M[5], M[3], M[0], M[4], M[5], M[4], M[2]};
  memcpy(out, rows, sizeof rows);
  return checks_of(&now);
}

//---------------------------------- everything ----------------------------------------------------

static void put_geometry(bike_snapshot *out, const instant *now, const bike_model *m) {
  const position *g = &now->at;
  out->beta_r = atan2(g->s_br, g->c_br);
  out->beta_f = atan2(g->s_bf, g->c_bf);
  out->psi = atan2(g->s_psi, g->c_psi);
  out->phi_tilde = atan2(g->s_phit, g->c_phit);
  out->pitch = m->tilt - out->beta_r;
  out->T_r = g->T_r;
  out->T_f = g->T_f;
  out->Z_0 = g->Z_0;
}

static void put_rates(bike_snapshot *out, const instant *now, const bike_model *m) {
  form a = now->acceleration;
  out->acceleration = named(a);
  out->yaw_rate = now->rate.yaw;
  out->pitch_rate = -now->rate.br;
  out->front_speed = now->rate.v_f;
  out->rear_wheel_rate = rear_hinge(now);
  out->front_wheel_rate = front_hinge(now);
  out->yaw_acceleration = now->rest.yaw + applied(now->forms.yaw, a);
  out->pitch_acceleration = -(now->rest.br + applied(now->forms.br, a));
  // derivatives of the hinge rates; e_N turns with the frame, e_N^f with the fork
  const masses *body = &now->k.body;
  vec w = now->k.velocity.turn, al = accelerated(now, m).turn;
  double fork = dot(al, body->axle_f) + now->rate.u.phi * dot(w, cross(body->axis, body->axle_f));
  out->rear_wheel_acceleration = al.x - spin_up_rear(now, m);
  out->front_wheel_acceleration = fork - spin_up_front(now);
}

static void put_force(double out[3], vec force) {
  out[0] = force.x;
  out[1] = force.y;
  out[2] = force.z;
}

EVALUATION checks snapshot_at(void *out, const question *q, const start *from) {
  instant now;
  solve(&now, q, from, &q->in);
  bike_snapshot *is = out;
  put_geometry(is, &now, q->model);
  put_rates(is, &now, q->model);
  energy e = energy_of(&now, q->model, &q->in);
  is->kinetic = e.kinetic;
  is->potential = e.potential;
  is->power = power_of(&now, q->model, &q->in);
  ground forces = ground_forces(&now, q->model, &q->in);
  put_force(is->rear_force, forces.rear);
  put_force(is->front_force, forces.front);
  return checks_of(&now);
}

const state_evaluations INSTANCE(state) = {.free_acceleration = free_acceleration,
                                           .loaded_acceleration = loaded_acceleration,
                                           .free_rates = free_rates,
                                           .loaded_rates = loaded_rates,
                                           .mass_matrix = mass_matrix_at,
                                           .snapshot = snapshot_at};
