// SPDX-License-Identifier: Apache-2.0
// Equations (1)-(7): where both wheels touch the ground at a lean kappa and a steer phi.
#ifndef BICYCLE_KERNEL_GEOMETRY_H
#define BICYCLE_KERNEL_GEOMETRY_H

// Prefix s_, c_, t_: sine, cosine, tangent. phit is the paper's phi-tilde, bf and br its betas.
typedef struct position {
  real s_phi, c_phi, s_kap, c_kap;
  real s_br, c_br, t_br; // rear angle beta_r
  real s_psi, c_psi;     // lean of the front wheel
  real tau, a, over_a;   // cos psi sin beta_f, cos psi cos beta_f = cos kappa cos beta_r, 1/a
  real s_bf, c_bf, t_bf; // front angle beta_f
  real s_phit, c_phit;   // steer projected on the ground
  real T_r, T_f, Z_0;    // m
  real Q;                // T_r - T_f cos phit: dG/dbeta_r cos beta_r of equation (4)
  real D;                // T_r cos phit - T_f: denominator of equation (13)
  real over_c_kap, over_c_br, over_c_psi, over_c_bf, over_Q, over_D; // reciprocals
  real residual; // of (4) times cos kappa cos beta_r, m
} position;

// Sines and cosines that the rest of a position follows from, beta_r's found.
typedef struct posture {
  real s_phi, c_phi, s_kap, c_kap;
  real s_br, c_br;
  real over_a; // 1/(cos kappa cos beta_r)
} posture;

// Where Newton's method for beta_r starts.
typedef struct start {
  real s, c, r; // r sin beta_r, r cos beta_r, r
} start;

// Within 60 deg of steer and 45 deg of lean (penny-farthing 45, 35) three steps from the guess
// below bring the shipped bicycles to rounding; what has not converged shows in the residual and is
// the caller's to judge.
enum { NEWTON_STEPS = 3 };

// The start near upright, of second order: dbeta_r = (T_f cos br/Q) ((kap - phi sin br) dphi +
// phi dkap) there, as the rotation by 2 atan(dbeta_r/2).
static inline start guessed(const kernel_model *m, real phi, real kappa) {
  real half = 0.5 * m->tilt_gain * phi * (kappa - 0.5 * m->s_tilt * phi);
  real r = m->newton_scale, across = r * half, square = across * half;
  real along = r - square, turn = across + across;
  return (start){m->s_tilt * along + m->c_tilt * turn, m->c_tilt * along - m->s_tilt * turn,
                 r + square};
}

// The start at an angle near by.
static inline start begun(const kernel_model *m, real s_br, real c_br) {
  real r = m->newton_scale;
  return (start){r * s_br, r * c_br, r};
}

// Solves (4) with (1) put in, times cos kappa cos beta_r:
//   G = L_r cos kap sin br + R_r cos kap + L_f tau - L_s cos kap cos br - R_f cos psi = 0.
// cos kap (sin br, cos br) is carried as (cs, a)/r. A Newton step delta = -G/G' = -2p/q becomes the
// rotation by 2 atan(-p/q), the same to third order, without a division: r grows by q^2 + p^2. As q
// is 2 G' r^2, and G' the wheelbase upright, r stays near 1/sqrt(2 wheelbase) if it starts there.
static inline void newton_rear_angle(int steps, posture *g, const kernel_geometry *L, start from) {
  real cs = g->c_kap * from.s, a = g->c_kap * from.c, r = from.r;
  real across = g->s_kap * g->s_phi;
  real reach = L->L_r + L->L_f * g->c_phi, rise = L->R_r * g->c_kap + L->L_f * across;
  for (int step = 0; step < steps; step++) {
    real tau = cs * g->c_phi + across * r;
    real square = tau * tau + a * a, c_psi = real_sqrt(square);
    real part = reach * cs + rise * r - L->L_s * a, slope = reach * a + L->L_s * cs;
    real p = part * c_psi - L->R_f * square;
    real q = 2.0 * slope * c_psi - 2.0 * L->R_f * a * (tau * g->c_phi - cs);
    real along = q * q - p * p, turn = -2.0 * p * q;
    real cs_new = along * cs + turn * a;
    a = along * a - turn * cs;
    cs = cs_new;
    r = r * (q * q + p * p);
  }
  real norm = 1.0 / (g->c_kap * r), over_a = 1.0 / a; // side by side
  real s = cs * norm, c = a * norm;
  // the share that the roundings of the steps have taken from r
  real half = 0.5 * (1.0 - s * s - c * c);
  g->s_br = s + half * s;
  g->c_br = c + half * c;
  g->over_a = (r - half * r) * over_a;
}

static inline void solve_rear_angle(posture *g, const kernel_geometry *L, start from) {
  newton_rear_angle(NEWTON_STEPS, g, L, from);
}

static inline void find_posture(posture *out, const kernel_geometry *L, start from, real phi,
                                real kappa) {
  real_sincos(phi, &out->s_phi, &out->c_phi);
  real_sincos(kappa, &out->s_kap, &out->c_kap);
  solve_rear_angle(out, L, from);
}

static inline void place(position *g, const kernel_geometry *L, const posture *at) {
  // what follows shares no product with what has led here, so that the same products are fused
  // whether both are compiled together or apart
  g->s_phi = real_anew(at->s_phi);
  g->c_phi = real_anew(at->c_phi);
  g->s_kap = real_anew(at->s_kap);
  g->c_kap = real_anew(at->c_kap);
  g->s_br = real_anew(at->s_br);
  g->c_br = real_anew(at->c_br);
  g->over_a = real_anew(at->over_a);
  // (2), and (1) times cos kappa cos beta_r
  real cs = g->c_kap * g->s_br;
  g->s_psi = g->c_phi * g->s_kap - g->s_phi * cs;
  g->tau = g->c_phi * cs + g->s_phi * g->s_kap;
  g->a = g->c_kap * g->c_br;
  real square = g->tau * g->tau + g->a * g->a, over_square = 1.0 / square;
  g->c_psi = real_sqrt(square);
  g->over_c_psi = g->c_psi * over_square;
  real over_a = g->over_a;
  g->over_c_kap = g->c_br * over_a;
  g->over_c_br = g->c_kap * over_a;
  g->over_c_bf = g->c_psi * over_a;
  g->t_br = g->s_br * g->over_c_br;
  g->t_bf = g->tau * over_a;
  g->s_bf = g->tau * g->over_c_psi;
  g->c_bf = g->a * g->over_c_psi;
  // (3) in the form that is right in all four quadrants
  g->s_phit = g->s_phi * g->c_br * g->over_c_psi;
  g->c_phit = (g->c_phi * g->c_kap + g->s_phi * g->s_kap * g->s_br) * g->over_c_psi;
  // (5), (6), (7)
  g->T_f = L->R_f * g->t_bf - L->L_f * g->over_c_bf;
  g->T_r = L->R_r * g->t_br + L->L_r * g->over_c_br;
  g->Z_0 = L->L_r * g->t_br + L->R_r * g->over_c_br - L->L_s;
  g->Q = g->T_r - g->T_f * g->c_phit;
  g->D = g->T_r * g->c_phit - g->T_f;
  g->over_Q = 1.0 / g->Q;
  g->over_D = 1.0 / g->D;
  // (4) at the root found
  g->residual =
      L->L_r * cs + L->R_r * g->c_kap + L->L_f * g->tau - L->R_f * g->c_psi - L->L_s * g->a;
}

// What tells whether Newton's method has found a root of (4), and which.
typedef struct root_checks {
  real residual, Q, c_br, c_kap, c_psi; // members of `position`
} root_checks;

static inline root_checks root_checks_of(const position *g) {
  return (root_checks){g->residual, g->Q, g->c_br, g->c_kap, g->c_psi};
}

static inline void locate(position *g, const kernel_geometry *L, start from, real phi, real kappa) {
  posture at;
  find_posture(&at, L, from, phi, kappa);
  place(g, L, &at);
}

// Where beta_r is known: for derivatives by phi and kappa. The error of a step of Newton's method
// is quadratic in that of its start, so that the derivatives of one step from the root, which is a
// constant, are those of the root. Those of further steps cancel more and more.
static inline void locate_known(position *g, const kernel_geometry *L, real s_br, real c_br,
                                real phi, real kappa) {
  posture at;
  real nought = s_br - s_br;
  real_sincos(phi, &at.s_phi, &at.c_phi);
  real_sincos(kappa, &at.s_kap, &at.c_kap);
  newton_rear_angle(1, &at, L, (start){s_br, c_br, 1.0 - nought});
  place(g, L, &at);
}

#endif
