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
  form bf;     // beta_f'
  form phit;   // phit'
  form yaw;    // Omega (13)
  form v_f;    // speed of the front contact point (14)
  form spin_f; // angular velocity of the front wheel along its hub axis e_N^f (15)
  form swing;  // beta_r' Q/T_f
  real e, z;   // T_r'/beta_r', T_f'/beta_f', m
} rate_forms;

// Values of the rates at the state's u.
typedef struct rates {
  form u;
  real br, bf, psi, phit; // rad/s
  real T_r, T_f, Z_0;     // m/s
  real yaw, v_f;          // rad/s, m/s
  real spin_r, spin_f;    // rad/s, of the wheels along their hub axes (16), (15)
} rates;

// Second derivatives at u' = 0.
typedef struct bias {
  real br, phit, yaw, spin_f;
} bias;

static inline void rate_forms_of(rate_forms *f, const position *g, const kernel_model *m) {
  real nought = g->Q - g->Q; // a zero of type `real`
  // beta_r' Q = T_f (cos br tan psi phi' + sin phit/cos kap kappa')
  real t_psi = g->s_psi * g->over_c_psi, tf_Q = g->T_f * g->over_Q;
  f->swing = (form){g->c_br * t_psi, g->s_phit * g->over_c_kap, nought};
  f->br = (form){tf_Q * f->swing.phi, tf_Q * f->swing.kap, nought};
  // phit' cos^2 psi = a phi' + sin phi (sin psi cos br kappa' - tau beta_r')
  real st = g->s_phi * g->s_bf * g->over_c_psi;
  f->phit =
      (form){g->c_bf * g->over_c_psi - st * f->br.phi, g->s_phit * t_psi - st * f->br.kap, nought};
  // beta_f' = phit' sin psi + kappa' sin phi cos br + beta_r' cos phi
  f->bf = (form){f->phit.phi * g->s_psi + f->br.phi * g->c_phi,
                 f->phit.kap * g->s_psi + f->br.kap * g->c_phi + g->s_phi * g->c_br, nought};
  real e = (g->Z_0 + m->geometry.L_s) * g->over_c_br, z = g->Z_0 * g->over_c_bf;
  f->e = e;
  f->z = z;
  // (13): Omega D = (v + T_r') sin phit + T_f phit'
  real over_D = g->over_D, es = e * g->s_phit;
  f->yaw = (form){(es * f->br.phi + g->T_f * f->phit.phi) * over_D,
                  (es * f->br.kap + g->T_f * f->phit.kap) * over_D, g->s_phit * over_D};
  // (14): v_f = (v + T_r') cos phit - T_f' + T_r Omega sin phit
  real ec = e * g->c_phit, ts = g->T_r * g->s_phit;
  f->v_f = (form){ec * f->br.phi - z * f->bf.phi + ts * f->yaw.phi,
                  ec * f->br.kap - z * f->bf.kap + ts * f->yaw.kap, g->c_phit + ts * f->yaw.v};
  // (15): -(v_f/R_f + (Omega + phit') sin psi)
  real over_R = m->over_R_f;
  f->spin_f = (form){-f->v_f.phi * over_R - (f->yaw.phi + f->phit.phi) * g->s_psi,
                     -f->v_f.kap * over_R - (f->yaw.kap + f->phit.kap) * g->s_psi,
                     -f->v_f.v * over_R - f->yaw.v * g->s_psi};
}

static inline void rates_at(rates *q, const rate_forms *f, const position *g, const kernel_model *m,
                            form u) {
  q->u = u;
  q->br = applied(f->br, u);
  q->bf = applied(f->bf, u);
  q->phit = applied(f->phit, u);
  q->yaw = applied(f->yaw, u);
  q->v_f = applied(f->v_f, u);
  // (16)
  q->spin_r = -u.v * m->over_R_r - q->yaw * g->s_kap;
  q->spin_f = applied(f->spin_f, u);
  // psi' = kappa' cos phit - beta_r' sin phit cos kap - phi' sin bf
  q->psi = u.kap * g->c_phit - q->br * g->s_phit * g->c_kap - u.phi * g->s_bf;
  q->T_r = f->e * q->br;
  q->T_f = f->z * q->bf;
  q->Z_0 = g->T_r * q->br * g->over_c_br;
}

// beta_r'' at u' = 0: (T_f A)' = (beta_r' Q)', where A is `swing`
static inline real rear_angle_bias(const position *g, const rate_forms *f, const rates *q) {
  real over_c_psi = g->over_c_psi, t_psi = g->s_psi * over_c_psi;
  real A = applied(f->swing, q->u);
  real A_ =
      (g->c_br * (q->psi * over_c_psi) * over_c_psi - g->s_br * q->br * t_psi) * q->u.phi +
      (g->c_phit * q->phit * g->over_c_kap + f->swing.kap * g->s_kap * (q->u.kap * g->over_c_kap)) *
          q->u.kap;
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
  real all = (a_ * q->u.phi + g->c_phi * q->u.phi * inner + g->s_phi * inner_) * over_c_psi +
             2.0 * g->s_psi * q->psi * q->phit;
  return all * over_c_psi;
}

static inline void bias_of(bias *b, const position *g, const kernel_model *m, const rate_forms *f,
                           const rates *q) {
  b->br = rear_angle_bias(g, f, q);
  b->phit = projected_steer_bias(g, q, b->br);
  // beta_f'', and with T_r' = e beta_r', T_f' = z beta_f': T_r'', T_f''
  real bf2 = b->phit * g->s_psi + q->phit * g->c_psi * q->psi +
             q->u.kap * (g->c_phi * q->u.phi * g->c_br - g->s_phi * g->s_br * q->br) +
             b->br * g->c_phi - q->br * g->s_phi * q->u.phi;
  real T_r2 = q->Z_0 * (q->br * g->over_c_br) + f->e * (b->br + q->br * q->br * g->t_br);
  real T_f2 = q->Z_0 * (q->bf * g->over_c_bf) + f->z * (bf2 + q->bf * q->bf * g->t_bf);
  // (13)'
  real swept = (q->u.v + q->T_r) * q->phit;
  real ts = g->T_r * g->s_phit;
  real D_ = q->T_r * g->c_phit - ts * q->phit - q->T_f;
  b->yaw =
      (T_r2 * g->s_phit + swept * g->c_phit + q->T_f * q->phit + g->T_f * b->phit - q->yaw * D_) *
      g->over_D;
  // (14)'
  real v_f2 = T_r2 * g->c_phit - swept * g->s_phit - T_f2 + q->T_r * q->yaw * g->s_phit +
              ts * b->yaw + g->T_r * q->yaw * g->c_phit * q->phit;
  // (15)'
  b->spin_f =
      -v_f2 * m->over_R_f - (b->yaw + b->phit) * g->s_psi - (q->yaw + q->phit) * g->c_psi * q->psi;
}

#endif
