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

// Where Newton's method for beta_r starts.
typedef struct start {
  real s, c; // sin, cos beta_r
} start;

// Within 60 deg of steer and 45 deg of lean (penny-farthing 45, 35) three steps from the guess
// below bring the shipped bicycles to rounding; what has not converged shows in the residual and is
// the caller's to judge.
enum { NEWTON_STEPS = 3 };

// The start near upright, of second order: dbeta_r = (T_f cos br/Q) ((kap - phi sin br) dphi +
// phi dkap) there. (s, c) need not be normalised.
static inline start guessed(const kernel_model *m, real phi, real kappa) {
  real d = m->tilt_gain * phi * (kappa - 0.5 * m->s_tilt * phi);
  return (start){m->s_tilt + m->c_tilt * d, m->c_tilt - m->s_tilt * d};
}

// Solves (4) with (1) put in, times cos kappa cos beta_r:
//   G = L_r cos kap sin br + R_r cos kap + L_f tau - R_f cos psi - L_s cos kap cos br = 0.
// (sin br, cos br) is carried as (s, c)/r. A Newton step delta = -G/G' = -p/q becomes the rotation
// by 2 atan(-p/2q), the same to third order; r keeps it a rotation without waiting for a division
// (`even` only keeps r from growing, and is ready before the square root is).
static inline void solve_rear_angle(position *g, const kernel_geometry *L, start from) {
  real s = from.s, c = from.c, r = real_sqrt(s * s + c * c);
  real across = g->s_kap * g->s_phi;
  for (int step = 0; step < NEWTON_STEPS; step++) {
    real even = 1.0 / (r * r);
    real cs = g->c_kap * s, a = g->c_kap * c;
    real tau = cs * g->c_phi + across * r;
    real c_psi = real_sqrt(tau * tau + a * a);
    // G' = (L_r + L_f cos phi) a + L_s cs - R_f a (tau cos phi - cs)/cos psi
    real part = L->L_r * cs + L->R_r * g->c_kap * r + L->L_f * tau - L->L_s * a;
    real slope = (L->L_r + L->L_f * g->c_phi) * a + L->L_s * cs;
    real even_psi = even * c_psi;
    real p = (part - L->R_f * c_psi) * even_psi;
    real q = 2.0 * (slope * even_psi - L->R_f * a * (tau * g->c_phi - cs) * even);
    real along = q * q - p * p, turn = -2.0 * p * q;
    real s_new = along * s + turn * c;
    c = along * c - turn * s;
    s = s_new;
    r = r * (q * q + p * p);
  }
  real norm = 1.0 / r, over_a = 1.0 / (g->c_kap * c); // side by side
  g->s_br = s * norm;
  g->c_br = c * norm;
  g->over_a = r * over_a;
}

static inline void locate(position *g, const kernel_geometry *L, start from, real phi, real kappa) {
  real_sincos(phi, &g->s_phi, &g->c_phi);
  real_sincos(kappa, &g->s_kap, &g->c_kap);
  solve_rear_angle(g, L, from);

  // (2), and (1) times cos kappa cos beta_r
  real cs = g->c_kap * g->s_br;
  g->s_psi = g->c_phi * g->s_kap - g->s_phi * cs;
  g->tau = g->c_phi * cs + g->s_phi * g->s_kap;
  g->a = g->c_kap * g->c_br;
  g->c_psi = real_sqrt(g->tau * g->tau + g->a * g->a);
  real over_a = g->over_a;
  g->over_c_kap = g->c_br * over_a;
  g->over_c_br = g->c_kap * over_a;
  g->over_c_bf = g->c_psi * over_a;
  g->over_c_psi = 1.0 / g->c_psi;
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

#endif
