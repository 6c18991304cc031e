// SPDX-License-Identifier: Apache-2.0
// Ground forces from (18)-(20) and the energy (24), at an instant already solved.
//
// With the torque balance about the front contact point, N = (T_r - T_f) x F_r, and K = T_f - T_r:
//   (20)        F_r . e_R  = e_N . L_r'/R_r
//   N . e_z     F_r . left = (K_2 F_r . e_R - N_z)/K_1
//   N x e_z     F_r . up   = (K_1 N_2 - K_2 N_1)/K^2
//   (18)        F_f = sum(p' - G) - F_r
// in ground axes (e_R, left, up). K_1 = Q is not zero where the geometry is regular, so this holds
// at kappa = 0 and phi = 0 too, where the paper's (23) cannot be used.
#ifndef BICYCLE_KERNEL_FORCES_H
#define BICYCLE_KERNEL_FORCES_H

// Accelerations of hub and frame, gravity as an upward one included.
static inline twist accelerated(const instant *now, const kernel_model *m) {
  const position *g = &now->at;
  form a = now->acceleration;
  real br = now->rest.br + applied(now->forms.br, a);
  real yaw = now->rest.yaw + applied(now->forms.yaw, a);
  twist t = now->k.rest;
  t.hub.x += m->geometry.R_r * a.kap;
  t.hub.y += a.v + m->geometry.R_r * g->s_kap * yaw;
  t.turn.x += br - g->s_kap * yaw;
  t.turn.y += a.kap;
  t.turn.z += g->c_kap * yaw;
  return t;
}

// (16)'
static inline real spin_up_rear(const instant *now, const kernel_model *m) {
  real yaw = now->rest.yaw + applied(now->forms.yaw, now->acceleration);
  return -now->acceleration.v * m->over_R_r - yaw * now->at.s_kap -
         now->rate.yaw * now->at.c_kap * now->rate.u.kap;
}

static inline real spin_up_front(const instant *now) {
  return now->rest.spin_f + applied(now->forms.spin_f, now->acceleration);
}

// Force and torque about the rear hub that the motion needs: sum(p' - G), sum(L' + x x (p' - G)).
static inline wrench needed(const instant *now, const kernel_model *m) {
  const masses *b = &now->k.body;
  twist all = accelerated(now, m), rest = now->k.rest;
  vec hub = {all.hub.x - rest.hub.x, all.hub.y - rest.hub.y, all.hub.z - rest.hub.z};
  vec turn = {all.turn.x - rest.turn.x, all.turn.y - rest.turn.y, all.turn.z - rest.turn.z};
  real phi = now->acceleration.phi;
  wrench n = now->k.need;
  n.force =
      add(n.force, add(add(scaled(b->mass, hub), cross(turn, b->moment)), scaled(phi, b->p_S)));
  vec steering = add(b->h_S, cross(b->foot, b->p_S));
  n.torque =
      add(n.torque, add(add(cross(b->moment, hub), times(&b->J, turn)), scaled(phi, steering)));
  n.torque.x += m->rear.spin_inertia * spin_up_rear(now, m);
  n.torque = add(n.torque, scaled(m->front.spin_inertia * spin_up_front(now), b->axle_f));
  return n;
}

// (e_N, e_R, e_A) to ground axes (e_R, left, up).
static inline vec to_ground(const position *g, vec a) {
  return (vec){a.y, -g->c_kap * a.x - g->s_kap * a.z, g->c_kap * a.z - g->s_kap * a.x};
}

typedef struct ground {
  vec rear, front; // forces of the ground on the wheels in (e_R, left, up), N
} ground;

static inline ground ground_forces(const instant *now, const kernel_model *m, const load *in) {
  const position *g = &now->at;
  real R = m->geometry.R_r;
  wrench n = needed(now, m);
  vec force = to_ground(g, n.force);
  // the rear hub is R e_A above the rear contact, the front contact lies at K from there
  real K1 = g->Q, K2 = -g->T_f * g->s_phit;
  vec arm = {-K1, -K2 - R * g->s_kap, R * g->c_kap};
  vec N = add(to_ground(g, n.torque), cross(arm, force));
  N.x -= in->roll_torque;
  ground out;
  out.rear.x = m->rear.spin_inertia * spin_up_rear(now, m) / R;
  out.rear.y = (K2 * out.rear.x - N.z) / K1;
  out.rear.z = (K1 * N.y - K2 * N.x) / (K1 * K1 + K2 * K2);
  out.front = (vec){force.x - out.rear.x, force.y - out.rear.y, force.z - out.rear.z};
  return out;
}

typedef struct energy {
  real kinetic, potential; // J
} energy;

// u.M u/2, with the rider's own motion m w' (w'/2 + e_N . velocity of his place).
static inline energy energy_of(const instant *now, const kernel_model *m, const load *in) {
  const position *g = &now->at;
  const kane *k = &now->k;
  const real *M = k->M;
  form u = now->rate.u;
  real carried_along = k->velocity.hub.x + cross(k->velocity.turn, k->body.rider).x;
  energy e;
  e.kinetic = 0.5 * (M[0] * u.phi * u.phi + M[1] * u.kap * u.kap + M[2] * u.v * u.v) +
              M[3] * u.phi * u.kap + M[4] * u.phi * u.v + M[5] * u.kap * u.v +
              m->rider_mass * in->w1 * (0.5 * in->w1 + carried_along);
  vec c = k->body.moment;
  real height = k->body.mass * m->geometry.R_r * g->c_kap + g->c_kap * c.z - g->s_kap * c.x;
  e.potential = m->gravity * height;
  return e;
}

// Force along e_N on the rider that makes the prescribed motion: m (a + g e_z) . e_N.
static inline real rider_force(const instant *now, const kernel_model *m) {
  twist all = accelerated(now, m);
  vec relative = carried(all.turn, now->k.velocity.turn, now->k.body.rider);
  return m->rider_mass * (all.hub.x + relative.x + now->k.rider_rest.x);
}

#endif
