// SPDX-License-Identifier: Apache-2.0
// Kane's equations for the speeds u = (phi', kappa', v): the ground's forces do no work on them and
// drop out, which leaves M u' = f with M symmetric and positive definite. Equivalent to (18)-(22).
//
// All vectors are in the moving basis (e_N, e_R, e_A): right, forward, up in the rear wheel plane.
// Every motion that the wheels allow is a combination of five plain ones, each written as velocity
// of the rear hub and angular velocity of the frame:
//   pitch B: 0,               e_N     lean K: R_r e_N, e_R     forward X: e_R, 0
//   yaw   Y: R_r sin kap e_R, e_z     steer S: the front frame alone turns about e_S
// namely  phi': br.phi B + yaw.phi Y + S,  kappa': br.kap B + yaw.kap Y + K,  v: yaw.v Y + X.
// These five have vectors so sparse that inertia costs little.
#ifndef BICYCLE_KERNEL_DYNAMICS_H
#define BICYCLE_KERNEL_DYNAMICS_H

// What acts from outside, and the rider's prescribed sideways motion.
typedef struct load {
  real steer_torque, roll_torque;
  real w, w1, w2; // rider's offset and its derivatives
} load;

// How the mass lies, wheels' spin left out.
typedef struct masses {
  real mass;    // of the whole bicycle
  vec moment;   // its first moment from the rear hub
  tensor J;     // its inertia about the rear hub
  tensor J_f;   // in frame axes: of the front body about the foot point of the steering axis
  vec p_f;      // in frame axes: momentum of unit steering
  vec foot;     // that point, from the rear hub
  vec axis;     // e_S
  vec axle_f;   // e_N^f, the front wheel's hub axis
  vec p_S, h_S; // momentum and angular momentum about the foot of unit steering
  real J_S;     // e_S . h_S
  vec rider;    // the rider from the rear hub
} masses;

// Motion of the frame, and what the bicycle would need to be accelerated so.
typedef struct twist {
  vec hub, turn; // velocity of the rear hub and angular velocity, or accelerations
} twist;

// Force and torque about the rear hub, and the part of the torque that steers the front body.
typedef struct wrench {
  vec force, torque;
  real steer;
} wrench;

typedef struct kane {
  masses body;
  twist velocity;
  twist rest;     // accelerations with u', beta_r'' and Omega' zero, gravity as an upward one
  wrench need;    // for `rest`
  vec rider_rest; // acceleration of the rider relative to the frame; with a load alone
  // momenta of the speeds' motions along pitch, along yaw, and of the front wheel's spin
  form along_B, along_Y, along_F;
  real M[6];     // phi phi, kap kap, v v, phi kap, phi v, kap v
  real f[3];     // phi, kap, v
  real pivot[3]; // of the elimination of v, kap, phi
} kane;

// The rider at rider offset zero. The front body is put to the rear one in frame axes (N, p, S),
// where the foot of the steering axis and e_S are constant.
static inline void place_masses(masses *b, const kernel_model *m, const position *g) {
  real s = g->s_br, c = g->c_br, nought = c - c;
  vec foot = {nought, m->geometry.L_r, -m->geometry.L_s};
  tensor J = tensor_of(m->rear.inertia);
  tensor J_f = tensor_about_z(tensor_of(m->front.inertia), g->s_phi, g->c_phi);
  vec d = turned_about_z(vec_of(m->front.moment), g->s_phi, g->c_phi);
  vec h_S = {J_f.xz, J_f.yz, J_f.zz}, p_S = {-d.y, d.x, nought};
  add_shifted(&J, J_f, m->front.mass, d, foot);
  vec moment = add(add(vec_of(m->rear.moment), d), scaled(m->front.mass, foot));

  b->mass = m->rear.mass + m->front.mass;
  b->moment = turned_about_x(moment, s, c);
  b->J = tensor_about_x(J, s, c);
  b->J_f = J_f;
  b->p_f = p_S;
  b->foot = turned_about_x(foot, s, c);
  b->axis = (vec){nought, -s, c};
  b->axle_f = (vec){g->c_phi, g->s_phi * c, g->s_phi * s};
  b->p_S = turned_about_x(p_S, s, c);
  b->h_S = turned_about_x(h_S, s, c);
  b->J_S = J_f.zz;
  b->rider = turned_about_x(vec_of(m->rider_place), s, c);
}

// Moves the rider by w to the right.
static inline void move_rider(masses *b, const kernel_model *m, real w) {
  real mw = m->rider_mass * w, along = mw * (2.0 * b->rider.x + w);
  b->J.yy += along;
  b->J.zz += along;
  b->J.xy -= mw * b->rider.y;
  b->J.xz -= mw * b->rider.z;
  b->moment.x += mw;
  b->rider.x += w;
}

// Inertia between the five plain motions. The rear wheel spins with yaw, -sin kap, and forward,
// -1/R_r, alone (16).
typedef struct inertia {
  real BB, BY, BS, BK, BX, YY, YS, YK, YX, SS, SK, SX, KK, XX; // K and X are orthogonal
} inertia;

static inline void inertia_of(inertia *G, const masses *b, const position *g,
                              const kernel_model *m) {
  const tensor *J = &b->J;
  vec c = b->moment;
  real R = m->geometry.R_r, Rs = R * g->s_kap;
  real spin_Y = m->rear.spin_inertia * g->s_kap, spin_X = m->rear.spin_inertia * m->over_R_r;
  // e_z x moment along e_R; e_z . J
  real forward = g->c_kap * c.x + g->s_kap * c.z;
  vec Jz = {g->c_kap * J->xz - g->s_kap * J->xx, g->c_kap * J->yz - g->s_kap * J->xy,
            g->c_kap * J->zz - g->s_kap * J->xz};
  vec h = add(b->h_S, cross(b->foot, b->p_S)); // of unit steering, about the rear hub
  G->BB = J->xx;
  G->BK = J->xy;
  G->BX = -c.z;
  G->BY = Jz.x - Rs * c.z;
  G->XX = b->mass + spin_X * m->over_R_r;
  G->KK = R * (R * b->mass + 2.0 * c.z) + J->yy;
  G->YX = Rs * b->mass + forward + spin_X * g->s_kap;
  G->YK = Jz.y - R * g->c_kap * c.y;
  G->YY =
      Rs * (Rs * b->mass + 2.0 * forward) + g->c_kap * Jz.z - g->s_kap * Jz.x + spin_Y * g->s_kap;
  G->BS = h.x;
  G->SX = b->p_S.y;
  G->SK = R * b->p_S.x + h.y;
  G->YS = Rs * b->p_S.y + g->c_kap * h.z - g->s_kap * h.x;
  G->SS = b->J_S;
}

static inline void mass_matrix(kane *k, const inertia *G, const rate_forms *q,
                               real spin_inertia_f) {
  real *M = k->M;
  form b = q->br, o = q->yaw, f = q->spin_f;
  // momenta of the motions phi', kappa', v along the plain ones
  real phi_B = b.phi * G->BB + o.phi * G->BY + G->BS, phi_Y = b.phi * G->BY + o.phi * G->YY + G->YS;
  real phi_S = b.phi * G->BS + o.phi * G->YS + G->SS;
  real kap_B = b.kap * G->BB + o.kap * G->BY + G->BK, kap_Y = b.kap * G->BY + o.kap * G->YY + G->YK;
  real kap_S = b.kap * G->BS + o.kap * G->YS + G->SK;
  real kap_K = b.kap * G->BK + o.kap * G->YK + G->KK;
  real v_B = o.v * G->BY + G->BX, v_Y = o.v * G->YY + G->YX, v_S = o.v * G->YS + G->SX;
  real v_K = o.v * G->YK, v_X = o.v * G->YX + G->XX;
  form F = {spin_inertia_f * f.phi, spin_inertia_f * f.kap, spin_inertia_f * f.v};
  k->along_B = (form){phi_B, kap_B, v_B};
  k->along_Y = (form){phi_Y, kap_Y, v_Y};
  k->along_F = F;
  M[0] = b.phi * phi_B + o.phi * phi_Y + phi_S + F.phi * f.phi;
  M[1] = b.kap * kap_B + o.kap * kap_Y + kap_K + F.kap * f.kap;
  M[2] = o.v * v_Y + v_X + F.v * f.v;
  M[3] = b.phi * kap_B + o.phi * kap_Y + kap_S + F.phi * f.kap;
  M[4] = b.phi * v_B + o.phi * v_Y + v_S + F.phi * f.v;
  M[5] = b.kap * v_B + o.kap * v_Y + v_K + F.kap * f.v;
}

// Velocities, and the accelerations that the turning of the axes alone causes: the basis turns with
// (-Omega sin kap, kappa', Omega cos kap), the frame with beta_r' about e_N more.
static inline void move_frame(kane *k, const kernel_model *m, const position *g, const rates *q) {
  real R = m->geometry.R_r, kap = q->u.kap;
  real turn_N = -q->yaw * g->s_kap, turn_A = q->yaw * g->c_kap;
  real h = q->u.v - R * turn_N; // hub's speed along e_R
  real nought = h - h;
  k->velocity = (twist){{R * kap, h, nought}, {q->br + turn_N, kap, turn_A}};
  k->rest.hub = (vec){-turn_A * h, 2.0 * R * kap * turn_A, turn_N * h - kap * R * kap};
  k->rest.turn = (vec){-turn_A * kap, q->br * turn_A, (turn_N - q->br) * kap};
  // whatever stands on the ground is accelerated upwards
  k->rest.hub.x -= m->gravity * g->s_kap;
  k->rest.hub.z += m->gravity * g->c_kap;
}

// What the front body needs beyond what it does as part of the frame, which turns with w: it turns
// with w + phi' e_S, and its wheel spins. All in frame axes, where e_S = (0, 0, 1) and the foot of
// the steering axis f = (0, L_r, -L_s) are constant. Accelerations of steering
// 2 phi' w x (e_S x r) + phi'^2 e_S x (e_S x r) at r from the foot need the force
//   F = 2 phi' w x p_S + phi'^2 e_S x p_S
// at the foot and the torque about it, without part along e_S,
//   phi' e_S x (2 J_f w - tr J_f w + phi' h_S);
// the wheel's angular momentum H, which turns with its hub axis, the torque (w + phi' e_S) x H.
static inline void add_front(wrench *n, const masses *b, const kernel_model *m, const position *g,
                             vec turn, real phi, real H) {
  const tensor *J = &b->J_f;
  real L_r = m->geometry.L_r, L_s = m->geometry.L_s;
  vec w = turned_about_x(turn, -g->s_br, g->c_br), p = b->p_f;
  real J_w_x = J->xx * w.x + J->xy * w.y + J->xz * w.z;
  real J_w_y = J->xy * w.x + J->yy * w.y + J->yz * w.z;
  real H_x = H * g->c_phi, H_y = H * g->s_phi, spin = w.z + phi, trace = J->xx + J->yy + J->zz;
  real push = phi * (w.z + spin);
  vec F = {-push * p.y, push * p.x, 2.0 * phi * (w.x * p.y - w.y * p.x)};
  real along = w.x * H_y - w.y * H_x; // of the wheel's torque along e_S
  vec T = {-phi * (2.0 * J_w_y - trace * w.y + phi * J->yz) - spin * H_y + L_r * F.z + L_s * F.y,
           phi * (2.0 * J_w_x - trace * w.x + phi * J->xz) + spin * H_x - L_s * F.x,
           along - L_r * F.x};
  n->force = add(n->force, turned_about_x(F, g->s_br, g->c_br));
  n->torque = add(n->torque, turned_about_x(T, g->s_br, g->c_br));
  n->steer += w.x * J_w_y - w.y * J_w_x + along;
}

// Adds what an acceleration of the rider relative to the frame needs.
static inline void push_rider(wrench *n, const masses *b, const kernel_model *m, vec relative) {
  vec push = scaled(m->rider_mass, relative);
  n->force = add(n->force, push);
  n->torque = add(n->torque, cross(b->rider, push));
}

// Force and torque needed for `rest`, the wheels' spin-up and what moves the rider left out.
static inline void need_at_rest(kane *k, const kernel_model *m, const position *g, const rates *q) {
  const masses *b = &k->body;
  vec w = k->velocity.turn, a = k->rest.hub, al = k->rest.turn;
  wrench *n = &k->need;
  // the whole bicycle rigid: m a + al x c + w x (w x c);  c x a + J al + w x J w
  n->force = add(scaled(b->mass, a), carried(al, w, b->moment));
  n->torque = add(add(cross(b->moment, a), times(&b->J, al)), cross(w, times(&b->J, w)));
  // the front body about e_S: p_S . a_foot + h_S . al + e_S . (w x J_f w), the last in add_front
  n->steer = dot(b->p_S, add(a, carried(al, w, b->foot))) + dot(b->h_S, al);
  add_front(n, b, m, g, w, q->u.phi, m->front.spin_inertia * q->spin_f);
  // the rear wheel's angular momentum turns with its hub axis
  real H_r = m->rear.spin_inertia * q->spin_r;
  n->torque.y += w.z * H_r;
  n->torque.z -= w.y * H_r;
}

// The rider relative to the frame at u' = 0: 2 w' w x e_N + w'' e_N.
static inline void sway_rider(kane *k, const kernel_model *m, const load *in) {
  vec w = k->velocity.turn;
  k->rider_rest = (vec){in->w2, 2.0 * in->w1 * w.z, -2.0 * in->w1 * w.y};
  push_rider(&k->need, &k->body, m, k->rider_rest);
}

// A wrench along the motions of phi', kappa', v.
static inline form along_motions(const wrench *n, const position *g, const rate_forms *q, real R) {
  real B = n->torque.x, X = n->force.y, K = R * n->force.x + n->torque.y;
  real Y = R * g->s_kap * X + g->c_kap * n->torque.z - g->s_kap * B;
  return (form){q->br.phi * B + q->yaw.phi * Y + n->steer, q->br.kap * B + q->yaw.kap * Y + K,
                q->yaw.v * Y + X};
}

// f: the damper's torque less what the accelerations at u' = 0 need along each motion. beta_r'' and
// Omega' at u' = 0, which are known last, are motions along pitch and yaw: their momenta are at
// hand, the rear wheel's spin-up by Omega' in them. What else spins it up comes from a force at the
// hub, along all motions as (16) has it.
static inline void forces_along(kane *k, const kernel_model *m, const position *g,
                                const rate_forms *q, const rates *r, const bias *b) {
  wrench need = k->need;
  need.force.y += m->rear.spin_inertia * m->over_R_r * (r->yaw * g->c_kap * r->u.kap);
  form n = along_motions(&need, g, q, m->geometry.R_r);
  form P = k->along_B, S = k->along_Y, F = k->along_F;
  k->f[0] =
      -m->steer_damping * r->u.phi - n.phi - (P.phi * b->br + S.phi * b->yaw + F.phi * b->spin_f);
  k->f[1] = -n.kap - (P.kap * b->br + S.kap * b->yaw + F.kap * b->spin_f);
  k->f[2] = -n.v - (P.v * b->br + S.v * b->yaw + F.v * b->spin_f);
}

static inline void add_torques(kane *k, const load *in) {
  k->f[0] += in->steer_torque;
  k->f[1] += in->roll_torque;
}

// u' = M^-1 f by L D L^T without pivoting, v first: the heaviest entry. M is ready long before f.
static inline form solved(kane *k) {
  const real *M = k->M;
  real over_v = 1.0 / M[2];
  real l_kap = M[5] * over_v, l_phi = M[4] * over_v;
  real kk = M[1] - l_kap * M[5], pk = M[3] - l_phi * M[5], pp = M[0] - l_phi * M[4];
  real over_kk = 1.0 / kk;
  real l = pk * over_kk;
  real d = pp - l * pk;
  real over_d = 1.0 / d;
  real r_kap = k->f[1] - l_kap * k->f[2];
  real r_phi = k->f[0] - l_phi * k->f[2] - l * r_kap;
  form a;
  a.phi = r_phi * over_d;
  a.kap = r_kap * over_kk - l * a.phi;
  a.v = k->f[2] * over_v - l_kap * a.kap - l_phi * a.phi;
  k->pivot[0] = M[2];
  k->pivot[1] = kk;
  k->pivot[2] = d;
  return a;
}

#endif
