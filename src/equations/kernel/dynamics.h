// SPDX-License-Identifier: Apache-2.0
// Kane's equations for the speeds u = (phi', kappa', v) over the two lumped bodies: the ground's
// forces do no work on them and drop out, which leaves M u' = f with M symmetric and positive
// definite. Equivalent to (18)-(22) of the paper.
//
// Rear vectors are in frame axes (N, p, S), front vectors in the same axes turned by the steer
// about S; the front hub then lies on +p.
#ifndef BICYCLE_KERNEL_DYNAMICS_H
#define BICYCLE_KERNEL_DYNAMICS_H

// What acts from outside, and the rider's prescribed motion.
typedef struct load {
  real steer_torque, roll_torque;
  real w, w1, w2; // rider's offset and its derivatives
} load;

// A body at an instant, as needed by every quadratic form of its motion.
typedef struct body {
  real mass, spin_inertia;
  vec centre;       // from the rear hub, or from the steering axis' foot point
  real inertia[6];  // about `centre`
  vec drift;        // velocity of `centre` relative to the frame (the rider's sway)
  vec sway;         // angular momentum about `centre` of that relative motion
} body;

// Motion per unit of each speed: V of the centre of mass, W of the frame, s of the wheel's spin.
typedef struct partials {
  vec V[3], W[3];
  real s[3];
} partials;

// Velocity of the rear hub and angular velocity of the rear frame, per column.
typedef struct column {
  vec hub, omega;
} column;

typedef struct kane {
  body rear, front;
  partials rear_partials, front_partials;
  vec up_rear, up_front;            // e_z in the bodies' axes
  vec omega_r, omega_f;             // angular velocities
  vec hub_velocity;                 // of the rear hub
  vec alpha_r0, alpha_f0;           // angular accelerations at u' = 0
  vec hub_acceleration0;            // at u' = 0
  vec centre_r0, centre_f0;         // accelerations of the centres of mass at u' = 0
  real M[6];                        // phi phi, kap kap, v v, phi kap, phi v, kap v
  real f[3];                        // phi, kap, v
  real pivot[3];                    // of the elimination of v, kap, phi
} kane;

// Rear body with the rider moved by w to the right: its mass times w moves the centre, and the
// tensor gains what the parallel axis theorem says of the rider's share.
static inline void rear_body(body *b, const kernel_model *m, const load *in) {
  real share = m->rider_mass / m->rear.mass;
  const real *rho = m->rider_arm;
  real w = in->w, mw = m->rider_mass * w;
  real along = mw * (2.0 * rho[0] + w * (1.0 - share));
  const real *J = m->rear.inertia;
  b->mass = m->rear.mass;
  b->spin_inertia = m->rear.spin_inertia;
  b->centre = (vec){m->rear.centre[0] + share * w, m->rear.centre[1], m->rear.centre[2]};
  b->inertia[0] = J[0];
  b->inertia[1] = J[1] + along;
  b->inertia[2] = J[2] + along;
  b->inertia[3] = J[3] - mw * rho[1];
  b->inertia[4] = J[4] - mw * rho[2];
  b->inertia[5] = J[5];
  real nought = w - w;
  b->drift = (vec){share * in->w1, nought, nought};
  // rho x e_N m w'
  real mw1 = m->rider_mass * in->w1;
  b->sway = (vec){nought, mw1 * rho[2], -mw1 * rho[1]};
}

static inline void front_body(body *b, const kernel_model *m) {
  real nought = m->front.mass - m->front.mass;
  b->mass = m->front.mass;
  b->spin_inertia = m->front.spin_inertia;
  b->centre = vec_of(m->front.centre);
  for (int i = 0; i < 6; i++) b->inertia[i] = m->front.inertia[i];
  b->drift = b->sway = (vec){nought, nought, nought};
}

// For beta_r', Omega, kappa', v of a column:
//   hub   = R_r kappa' e_N + (v + R_r Omega sin kappa) e_R
//   omega = beta_r' e_N + kappa' e_R + Omega e_z
static inline column column_of(const position *g, real R_r, real br, real yaw, real kap, real v) {
  real h = v + R_r * yaw * g->s_kap;
  column c;
  c.hub = (vec){R_r * kap, h * g->c_br, -h * g->s_br};
  c.omega = (vec){br - yaw * g->s_kap, kap * g->c_br + yaw * g->c_kap * g->s_br,
                  yaw * g->a - kap * g->s_br};
  return c;
}

// From the rear hub to the steering axis' foot point.
static inline vec foot_arm(const kernel_geometry *L) {
  return (vec){L->L_r - L->L_r, L->L_r, -L->L_s};
}

static inline void partials_of(kane *k, const position *g, const kernel_geometry *L,
                               const rate_forms *f) {
  real one = g->c_phi / g->c_phi, nought = one - one;
  column c[3] = {column_of(g, L->R_r, f->br.phi, f->yaw.phi, nought, nought),
                 column_of(g, L->R_r, f->br.kap, f->yaw.kap, one, nought),
                 column_of(g, L->R_r, nought, f->yaw.v, nought, one)};
  real spin_r[3] = {f->spin_r.phi, f->spin_r.kap, f->spin_r.v};
  real spin_f[3] = {f->spin_f.phi, f->spin_f.kap, f->spin_f.v};
  vec foot = foot_arm(L);
  for (int i = 0; i < 3; i++) {
    k->rear_partials.W[i] = c[i].omega;
    k->rear_partials.V[i] = add(c[i].hub, cross(c[i].omega, k->rear.centre));
    k->rear_partials.s[i] = spin_r[i];
    vec at_foot = add(c[i].hub, cross(c[i].omega, foot));
    vec turning = into_turned(g->s_phi, g->c_phi, c[i].omega);
    if (i == 0) turning.z = turning.z + 1.0; // the steering rate itself
    k->front_partials.W[i] = turning;
    k->front_partials.V[i] = add(into_turned(g->s_phi, g->c_phi, at_foot),
                                 cross(turning, k->front.centre));
    k->front_partials.s[i] = spin_f[i];
  }
}

// Rear hub and frame at u' = 0: the column's time derivative in turning axes.
static inline void hub_bias(kane *k, const position *g, real R_r, const rates *q, const bias *b) {
  real h = q->u.v + R_r * q->yaw * g->s_kap;
  real h_ = R_r * (b->yaw * g->s_kap + q->yaw * g->c_kap * q->u.kap);
  vec relative = {h - h, h_ * g->c_br - h * g->s_br * q->br, -h_ * g->s_br - h * g->c_br * q->br};
  k->hub_acceleration0 = add(relative, cross(k->omega_r, k->hub_velocity));
  real z_p = g->c_kap * g->s_br; // e_z . e_p
  real z_p_ = g->a * q->br - g->s_kap * g->s_br * q->u.kap;
  real a_ = -g->s_kap * g->c_br * q->u.kap - z_p * q->br;
  k->alpha_r0 = (vec){b->br - b->yaw * g->s_kap - q->yaw * g->c_kap * q->u.kap,
                      b->yaw * z_p + q->yaw * z_p_ - q->u.kap * g->s_br * q->br,
                      b->yaw * g->a + q->yaw * a_ - q->u.kap * g->c_br * q->br};
}

static inline void accelerations_at_rest(kane *k, const position *g, const kernel_geometry *L,
                                         const rates *q, const bias *b, const load *in,
                                         real share) {
  column c = column_of(g, L->R_r, q->br, q->yaw, q->u.kap, q->u.v);
  k->hub_velocity = c.hub;
  k->omega_r = c.omega;
  hub_bias(k, g, L->R_r, q, b);
  // rear centre: hub + alpha x c + omega x (omega x c) + 2 omega x drift + drift'
  k->centre_r0 = add(k->hub_acceleration0, carried(k->alpha_r0, k->omega_r, k->rear.centre));
  vec swept = cross(k->omega_r, k->rear.drift);
  k->centre_r0 = add(k->centre_r0, add(swept, swept));
  k->centre_r0.x = k->centre_r0.x + share * in->w2;
  // front: the same about the foot point, in the turned axes, which themselves turn with phi'
  vec foot = add(k->hub_acceleration0, carried(k->alpha_r0, k->omega_r, foot_arm(L)));
  k->omega_f = into_turned(g->s_phi, g->c_phi, k->omega_r);
  k->alpha_f0 = into_turned(g->s_phi, g->c_phi, k->alpha_r0);
  k->alpha_f0.x = k->alpha_f0.x + q->u.phi * k->omega_f.y;
  k->alpha_f0.y = k->alpha_f0.y - q->u.phi * k->omega_f.x;
  k->omega_f.z = k->omega_f.z + q->u.phi;
  k->centre_f0 = add(into_turned(g->s_phi, g->c_phi, foot),
                     carried(k->alpha_f0, k->omega_f, k->front.centre));
}

// Whole angular momentum of a body about its centre of mass, in its axes; spin along `hub`.
static inline vec angular_momentum(const body *b, vec omega, real spin) {
  vec H = add(times(b->inertia, omega), b->sway);
  H.x = H.x + b->spin_inertia * spin;
  return H;
}

static inline void add_mass(real M[6], const body *b, const partials *p) {
  vec JW[3];
  for (int i = 0; i < 3; i++) JW[i] = times(b->inertia, p->W[i]);
  for (int i = 0, k = 3; i < 3; i++) {
    M[i] += b->mass * dot(p->V[i], p->V[i]) + dot(JW[i], p->W[i]) +
            b->spin_inertia * p->s[i] * p->s[i];
    for (int j = i + 1; j < 3; j++, k++)
      M[k] += b->mass * dot(p->V[i], p->V[j]) + dot(JW[i], p->W[j]) +
              b->spin_inertia * p->s[i] * p->s[j];
  }
}

// f_i -= m a_0.V_i + T_0.W_i + Theta spin'_0 s_i, T_0 the rate of angular momentum less the spin-up
// of the wheel; and the weight m g e_z.V_i where heights change, which is with phi' and kappa' only:
// so straight riding feels no rounding of a force that is not there.
static inline void subtract_inertia(real f[3], const body *b, const partials *p, vec centre0,
                                    vec weight, vec torque, real spin_up) {
  vec force = scaled(b->mass, centre0);
  for (int i = 0; i < 3; i++)
    f[i] -= dot(force, p->V[i]) + dot(torque, p->W[i]) + b->spin_inertia * spin_up * p->s[i];
  for (int i = 0; i < 2; i++) f[i] -= dot(weight, p->V[i]);
}

// Rate of angular momentum at u' = 0, the rear one with the change of its tensor and its sway:
//   J alpha + omega x H + J' omega + sway'
static inline vec rear_torque0(const kane *k, const kernel_model *m, const load *in, real spin) {
  vec H = angular_momentum(&k->rear, k->omega_r, spin);
  vec T = add(times(k->rear.inertia, k->alpha_r0), cross(k->omega_r, H));
  const real *rho = m->rider_arm;
  real share = m->rider_mass / m->rear.mass;
  real mw1 = m->rider_mass * in->w1, mw2 = m->rider_mass * in->w2;
  real along_ = 2.0 * mw1 * (rho[0] + in->w * (1.0 - share));
  vec o = k->omega_r;
  T.x += -mw1 * (rho[1] * o.y + rho[2] * o.z);
  T.y += along_ * o.y - mw1 * rho[1] * o.x + mw2 * rho[2];
  T.z += along_ * o.z - mw1 * rho[2] * o.x - mw2 * rho[1];
  return T;
}

static inline vec front_torque0(const kane *k, real spin) {
  vec H = angular_momentum(&k->front, k->omega_f, spin);
  return add(times(k->front.inertia, k->alpha_f0), cross(k->omega_f, H));
}

static inline void equations_of_motion(kane *k, const kernel_model *m, const rates *q,
                                       const bias *b, const load *in) {
  real nought = k->rear.mass - k->rear.mass;
  for (int i = 0; i < 6; i++) k->M[i] = nought;
  add_mass(k->M, &k->rear, &k->rear_partials);
  add_mass(k->M, &k->front, &k->front_partials);
  k->f[0] = in->steer_torque - m->steer_damping * q->u.phi;
  k->f[1] = in->roll_torque;
  k->f[2] = nought;
  subtract_inertia(k->f, &k->rear, &k->rear_partials, k->centre_r0,
                   scaled(m->gravity * k->rear.mass, k->up_rear),
                   rear_torque0(k, m, in, q->spin_r), b->spin_r);
  subtract_inertia(k->f, &k->front, &k->front_partials, k->centre_f0,
                   scaled(m->gravity * k->front.mass, k->up_front), front_torque0(k, q->spin_f),
                   b->spin_f);
}

// u' = M^-1 f by L D L^T without pivoting, v first: the heaviest entry.
static inline form solved(kane *k) {
  const real *M = k->M;
  real over_v = 1.0 / M[2];
  real l_kap = M[5] * over_v, l_phi = M[4] * over_v;
  real kk = M[1] - l_kap * M[5], pk = M[3] - l_phi * M[5], pp = M[0] - l_phi * M[4];
  real l = pk / kk;
  real d = pp - l * pk;
  real r_kap = k->f[1] - l_kap * k->f[2];
  real r_phi = k->f[0] - l_phi * k->f[2] - l * r_kap;
  form a;
  a.phi = r_phi / d;
  a.kap = r_kap / kk - l * a.phi;
  a.v = k->f[2] * over_v - l_kap * a.kap - l_phi * a.phi;
  k->pivot[0] = M[2];
  k->pivot[1] = kk;
  k->pivot[2] = d;
  return a;
}

#endif
