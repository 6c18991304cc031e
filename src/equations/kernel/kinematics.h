// SPDX-License-Identifier: Apache-2.0
// Equations (9)-(14): rates of the auxiliary angles and lengths, linear in the speeds
// u = (phi', kappa', v), and what is left of their second derivatives where u' = 0.
#ifndef BICYCLE_KERNEL_KINEMATICS_H
#define BICYCLE_KERNEL_KINEMATICS_H

// A rate as a linear form in (phi', kappa', v).
typedef struct form {
  real phi, kap, v;
} form;

static inline real applied(form f, form u) {
  return f.phi * u.phi + f.kap * u.kap + f.v * u.v;
}

// The rates that both the mass matrix and the state need.
typedef struct rate_forms {
  form br;     // beta_r'
  form phit;   // phit'
  form yaw;    // Omega (13)
  form v_f;    // speed of the front contact point (14)
  form spin_r; // angular velocity of the rear wheel along its hub axis e_N (16)
  form spin_f; // angular velocity of the front wheel along its hub axis e_N^f (15)
} rate_forms;

// Values of the rates at the state's u.
typedef struct rates {
  form u;
  real br, bf, psi, phit; // rad/s
  real T_r, T_f, Z_0;     // m/s
  real yaw, v_f;          // rad/s, m/s
  real spin_r, spin_f;    // rad/s
} rates;

// Second derivatives at u' = 0.
typedef struct bias {
  real br, phit, yaw, spin_r, spin_f;
} bias;

static inline void rate_forms_of(rate_forms *f, const position *g, const kernel_model *m) {
  const kernel_geometry *L = &m->geometry;
  real over_c2 = g->over_c_psi * g->over_c_psi;
  real nought = g->Q - g->Q; // a zero of type `real`
  // beta_r' Q = T_f (cos br tan psi phi' + sin phit/cos kap kappa')
  real tf_Q = g->T_f * g->over_Q;
  f->br =
      (form){tf_Q * g->c_br * g->s_psi * g->over_c_psi, tf_Q * g->s_phit * g->over_c_kap, nought};
  // phit' cos^2 psi = a phi' + sin phi (sin psi cos br kappa' - tau beta_r')
  real st = g->s_phi * g->tau * over_c2;
  f->phit = (form){g->a * over_c2 - st * f->br.phi,
                   g->s_phi * g->s_psi * g->c_br * over_c2 - st * f->br.kap, nought};
  // T_r' = e beta_r';  (13): Omega D = (v + T_r') sin phit + T_f phit'
  real e = (g->Z_0 + L->L_s) * g->over_c_br;
  real over_D = g->over_D;
  f->yaw = (form){(e * f->br.phi * g->s_phit + g->T_f * f->phit.phi) * over_D,
                  (e * f->br.kap * g->s_phit + g->T_f * f->phit.kap) * over_D, g->s_phit * over_D};
  // beta_f' = phit' sin psi + kappa' sin phi cos br + beta_r' cos phi;  T_f' = z beta_f'
  real bf_phi = f->phit.phi * g->s_psi + f->br.phi * g->c_phi;
  real bf_kap = f->phit.kap * g->s_psi + g->s_phi * g->c_br + f->br.kap * g->c_phi;
  real z = g->Z_0 * g->over_c_bf, ts = g->T_r * g->s_phit;
  // (14): v_f = (v + T_r') cos phit - T_f' + T_r Omega sin phit
  f->v_f =
      (form){e * f->br.phi * g->c_phit - z * bf_phi + ts * f->yaw.phi,
             e * f->br.kap * g->c_phit - z * bf_kap + ts * f->yaw.kap, g->c_phit + ts * f->yaw.v};
  // (16): -(v/R_r + Omega sin kappa)
  f->spin_r =
      (form){-f->yaw.phi * g->s_kap, -f->yaw.kap * g->s_kap, -m->over_R_r - f->yaw.v * g->s_kap};
  // (15): -(v_f/R_f + (Omega + phit') sin psi)
  real over_R = m->over_R_f;
  f->spin_f = (form){-f->v_f.phi * over_R - (f->yaw.phi + f->phit.phi) * g->s_psi,
                     -f->v_f.kap * over_R - (f->yaw.kap + f->phit.kap) * g->s_psi,
                     -f->v_f.v * over_R - f->yaw.v * g->s_psi};
}

static inline void rates_at(rates *q, const rate_forms *f, const position *g,
                            const kernel_geometry *L, form u) {
  q->u = u;
  q->br = applied(f->br, u);
  q->phit = applied(f->phit, u);
  q->yaw = applied(f->yaw, u);
  q->v_f = applied(f->v_f, u);
  q->spin_r = applied(f->spin_r, u);
  q->spin_f = applied(f->spin_f, u);
  q->bf = q->phit * g->s_psi + u.kap * g->s_phi * g->c_br + q->br * g->c_phi;
  // psi' = kappa' cos phit - beta_r' sin phit cos kap - phi' sin bf
  q->psi = u.kap * g->c_phit - q->br * g->s_phit * g->c_kap - u.phi * g->s_bf;
  q->T_r = (g->Z_0 + L->L_s) * q->br * g->over_c_br;
  q->T_f = g->Z_0 * q->bf * g->over_c_bf;
  q->Z_0 = g->T_r * q->br * g->over_c_br;
}

// beta_r'' at u' = 0: (T_f A)' = (beta_r Q)'
static inline real rear_angle_bias(const position *g, const rates *q) {
  real over_c_psi = g->over_c_psi, over_c_kap = g->over_c_kap;
  real t_psi = g->s_psi * over_c_psi;
  real A = g->c_br * t_psi * q->u.phi + g->s_phit * over_c_kap * q->u.kap;
  real A_ =
      (g->c_br * q->psi * over_c_psi * over_c_psi - g->s_br * q->br * t_psi) * q->u.phi +
      (g->c_phit * q->phit + g->s_phit * g->s_kap * over_c_kap * q->u.kap) * over_c_kap * q->u.kap;
  real Q_ = q->T_r - q->T_f * g->c_phit + g->T_f * g->s_phit * q->phit;
  return (q->T_f * A + g->T_f * A_ - q->br * Q_) * g->over_Q;
}

// phit'' at u' = 0: derivative of phit' cos^2 psi = a phi' + sin phi (sin psi cos br kappa'
// - tau beta_r')
static inline real projected_steer_bias(const position *g, const rates *q, real br2) {
  real over_c_psi = g->over_c_psi;
  real a_ = -q->u.kap * g->s_kap * g->c_br - q->br * g->c_kap * g->s_br;
  real tau_ = g->a * g->c_phi * q->br + g->s_psi * q->u.phi +
              (g->c_kap * g->s_phi - g->s_kap * g->s_br * g->c_phi) * q->u.kap;
  real inner = g->s_psi * g->c_br * q->u.kap - g->tau * q->br;
  real inner_ = (g->c_psi * q->psi * g->c_br - g->s_psi * g->s_br * q->br) * q->u.kap -
                tau_ * q->br - g->tau * br2;
  return (a_ * q->u.phi + g->c_phi * q->u.phi * inner + g->s_phi * inner_) * over_c_psi *
             over_c_psi +
         2.0 * g->s_psi * over_c_psi * q->psi * q->phit;
}

static inline void bias_of(bias *b, const position *g, const kernel_model *m, const rates *q) {
  const kernel_geometry *L = &m->geometry;
  real over_c_br = g->over_c_br, over_c_bf = g->over_c_bf;
  b->br = rear_angle_bias(g, q);
  b->phit = projected_steer_bias(g, q, b->br);
  // beta_f'', T_r'', T_f''
  real bf2 = b->phit * g->s_psi + q->phit * g->c_psi * q->psi +
             q->u.kap * (g->c_phi * q->u.phi * g->c_br - g->s_phi * g->s_br * q->br) +
             b->br * g->c_phi - q->br * g->s_phi * q->u.phi;
  real T_r2 = (q->Z_0 * q->br + (g->Z_0 + L->L_s) * (b->br + q->br * q->br * g->t_br)) * over_c_br;
  real T_f2 = (q->Z_0 * q->bf + g->Z_0 * (bf2 + q->bf * q->bf * g->t_bf)) * over_c_bf;
  // (13)'
  real along = q->u.v + q->T_r;
  real D_ = q->T_r * g->c_phit - g->T_r * g->s_phit * q->phit - q->T_f;
  b->yaw = (T_r2 * g->s_phit + along * g->c_phit * q->phit + q->T_f * q->phit + g->T_f * b->phit -
            q->yaw * D_) *
           g->over_D;
  // (14)'
  real v_f2 = T_r2 * g->c_phit - along * g->s_phit * q->phit - T_f2 +
              (q->T_r * q->yaw + g->T_r * b->yaw) * g->s_phit +
              g->T_r * q->yaw * g->c_phit * q->phit;
  // (16)', (15)'
  b->spin_r = -b->yaw * g->s_kap - q->yaw * g->c_kap * q->u.kap;
  b->spin_f =
      -v_f2 * m->over_R_f - (b->yaw + b->phit) * g->s_psi - (q->yaw + q->phit) * g->c_psi * q->psi;
}

#endif
