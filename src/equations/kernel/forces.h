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

// Accelerations of a body: of its centre of mass less gravity, and its rate of angular momentum.
typedef struct effort {
  vec force;  // p' - G, N
  vec torque; // L' about the centre of mass, N m
} effort;

static inline real spin_up(const partials *p, real rest, form a) {
  return rest + p->s[0] * a.phi + p->s[1] * a.kap + p->s[2] * a.v;
}

static inline vec combined(const vec per_speed[3], form a) {
  return add(add(scaled(a.phi, per_speed[0]), scaled(a.kap, per_speed[1])),
             scaled(a.v, per_speed[2]));
}

static inline effort effort_of(const body *b, const partials *p, vec centre0, vec up, real gravity,
                               vec torque0, real spin0, form a) {
  effort e;
  e.force = scaled(b->mass, add(add(centre0, combined(p->V, a)), scaled(gravity, up)));
  e.torque = add(torque0, times(b->inertia, combined(p->W, a)));
  e.torque.x = e.torque.x + b->spin_inertia * spin_up(p, spin0, a);
  return e;
}

// (N, p, S) components to ground axes (e_R, left, up).
static inline vec to_ground(const position *g, vec a) {
  real R = a.y * g->c_br - a.z * g->s_br, A = a.y * g->s_br + a.z * g->c_br;
  return (vec){R, -g->c_kap * a.x - g->s_kap * A, g->c_kap * A - g->s_kap * a.x};
}

static inline vec front_to_ground(const position *g, vec a) {
  return to_ground(g, out_of_turned(g->s_phi, g->c_phi, a));
}

typedef struct ground {
  vec rear, front; // forces of the ground on the wheels in (e_R, left, up), N
} ground;

static inline ground ground_forces(const instant *now, const kernel_model *m, const load *in) {
  const position *g = &now->at;
  const kane *k = &now->k;
  form a = now->acceleration;
  effort r = effort_of(&k->rear, &k->rear_partials, k->centre_r0, k->up_rear, m->gravity,
                       rear_torque0(k, m, in, now->rate.spin_r), now->rest.spin_r, a);
  effort f = effort_of(&k->front, &k->front_partials, k->centre_f0, k->up_front, m->gravity,
                       front_torque0(k, now->rate.spin_f), now->rest.spin_f, a);
  vec F_r_total = to_ground(g, r.force), F_f_total = front_to_ground(g, f.force);

  // Places from the origin, where the steering axis meets the ground: foot Z_0 e_S, rear hub
  // before it by -foot_arm; front contact -T_f e_R^f.
  real nought = g->Z_0 - g->Z_0;
  vec foot = {nought, nought, g->Z_0};
  vec x_r = to_ground(g, add(add(foot, scaled(nought - 1.0, foot_arm(&m->geometry))),
                             k->rear.centre));
  vec x_f = add(to_ground(g, foot), front_to_ground(g, k->front.centre));
  vec T_f = {-g->T_f * g->c_phit, -g->T_f * g->s_phit, nought};
  vec back = scaled(nought - 1.0, T_f);
  vec N = add(add(to_ground(g, r.torque), cross(add(x_r, back), F_r_total)),
              add(front_to_ground(g, f.torque), cross(add(x_f, back), F_f_total)));
  N.x = N.x - in->roll_torque;

  real K1 = g->Q, K2 = -g->T_f * g->s_phit;
  // e_N . L_r' of the wheel: its spin-up alone, its other angular momentum turns about e_N
  real L_r = k->rear.spin_inertia * spin_up(&k->rear_partials, now->rest.spin_r, a);
  ground out;
  out.rear.x = L_r / m->geometry.R_r;
  out.rear.y = (K2 * out.rear.x - N.z) / K1;
  out.rear.z = (K1 * N.y - K2 * N.x) / (K1 * K1 + K2 * K2);
  out.front = add(add(F_r_total, F_f_total), scaled(nought - 1.0, out.rear));
  return out;
}

typedef struct energy {
  real kinetic, potential; // J
} energy;

static inline real body_kinetic(const body *b, vec velocity, vec omega, real spin) {
  return 0.5 * (b->mass * dot(velocity, velocity) + dot(times(b->inertia, omega), omega) +
                b->spin_inertia * spin * spin) +
         dot(b->sway, omega);
}

static inline energy energy_of(const instant *now, const kernel_model *m, const load *in) {
  const position *g = &now->at;
  const kane *k = &now->k;
  vec v_r = add(add(k->hub_velocity, cross(k->omega_r, k->rear.centre)), k->rear.drift);
  vec v_foot = add(k->hub_velocity, cross(k->omega_r, foot_arm(&m->geometry)));
  vec v_f = add(into_turned(g->s_phi, g->c_phi, v_foot), cross(k->omega_f, k->front.centre));
  // the rider against the rest of the rear body: reduced mass times w'^2
  real rider = 0.5 * m->rider_mass * (1.0 - m->rider_mass / m->rear.mass) * in->w1 * in->w1;
  energy e;
  e.kinetic = body_kinetic(&k->rear, v_r, k->omega_r, now->rate.spin_r) +
              body_kinetic(&k->front, v_f, k->omega_f, now->rate.spin_f) + rider;
  real hub = m->geometry.R_r * g->c_kap;
  real foot = hub + dot(k->up_rear, foot_arm(&m->geometry));
  e.potential = m->gravity * (k->rear.mass * (hub + dot(k->up_rear, k->rear.centre)) +
                              k->front.mass * (foot + dot(k->up_front, k->front.centre)));
  return e;
}

// Force along e_N on the rider that makes the prescribed motion: m (a + g e_z) . e_N.
static inline real rider_force(const instant *now, const kernel_model *m, const load *in) {
  const kane *k = &now->k;
  form a = now->acceleration;
  real share = m->rider_mass / m->rear.mass;
  // the rider's place from the rear body's centre of mass, and how that place accelerates
  vec arm = vec_of(m->rider_arm);
  arm.x = arm.x + in->w * (1.0 - share);
  vec alpha = add(k->alpha_r0, combined(k->rear_partials.W, a));
  vec centre = add(k->centre_r0, combined(k->rear_partials.V, a));
  real acceleration = centre.x + carried(alpha, k->omega_r, arm).x + (1.0 - share) * in->w2;
  return m->rider_mass * (acceleration + m->gravity * k->up_rear.x);
}

#endif
