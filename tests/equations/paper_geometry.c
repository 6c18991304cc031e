// SPDX-License-Identifier: Apache-2.0
#include "paper_geometry.h"

// Equation (1).
static jet front_angle(jet phi, jet kappa, jet beta_r) {
  jet first = jet_mul(jet_tan(beta_r), jet_cos(phi));
  jet second = jet_div(jet_mul(jet_tan(kappa), jet_sin(phi)), jet_cos(beta_r));
  return jet_atan(jet_add(first, second));
}

// Equation (7).
static jet axis_foot(const bike_geometry *g, jet beta_r) {
  jet rear =
      jet_add(jet_scale(jet_tan(beta_r), g->L_r), jet_div(jet_constant(g->R_r), jet_cos(beta_r)));
  return jet_sub(rear, jet_constant(g->L_s));
}

// Left minus right side of (4): the height of Z_0 by the rear wheel less that by the front wheel.
static jet closure(const bike_geometry *g, jet phi, jet kappa, jet beta_r) {
  jet beta_f = front_angle(phi, kappa, beta_r);
  jet front =
      jet_sub(jet_div(jet_constant(g->R_f), jet_cos(beta_f)), jet_scale(jet_tan(beta_f), g->L_f));
  return jet_sub(axis_foot(g, beta_r), front);
}

// Everything but beta_r, from beta_r.
static paper_pose complete_pose(const bike_geometry *g, jet phi, jet kappa, jet beta_r) {
  paper_pose p = {.phi = phi, .kappa = kappa, .beta_r = beta_r};
  p.beta_f = front_angle(phi, kappa, beta_r);
  // (2)
  p.psi = jet_asin(jet_sub(jet_mul(jet_cos(phi), jet_sin(kappa)),
                           jet_mul(jet_mul(jet_sin(phi), jet_cos(kappa)), jet_sin(beta_r))));
  // (3), with its cosine so that the angle may pass 90 degrees; both times cos(kappa) cos(psi)
  jet sine = jet_mul(jet_mul(jet_sin(phi), jet_cos(p.beta_f)), jet_cos(p.psi));
  jet cosine = jet_add(jet_mul(jet_cos(phi), jet_cos(kappa)),
                       jet_mul(jet_mul(jet_sin(phi), jet_sin(kappa)), jet_sin(beta_r)));
  p.phi_tilde = jet_atan2(sine, jet_mul(cosine, jet_cos(kappa)));
  // (5), (6), (7)
  p.T_f = jet_sub(jet_scale(jet_tan(p.beta_f), g->R_f),
                  jet_div(jet_constant(g->L_f), jet_cos(p.beta_f)));
  p.T_r =
      jet_add(jet_scale(jet_tan(beta_r), g->R_r), jet_div(jet_constant(g->L_r), jet_cos(beta_r)));
  p.Z_0 = axis_foot(g, beta_r);
  return p;
}

// Newton on (4) at fixed phi, kappa; the slope comes from a jet in beta_r. False when it leaves
// the neighbourhood of its start or crosses the fold where the slope vanishes.
static bool newton(real *beta_r, const bike_geometry *g, real phi, real kappa) {
  const real start = *beta_r;
  const real reach = 0.1L;     // rad: the continuation's steps move the root by far less
  const real settled = 1e-10L; // rad: the next step, the last, errs by its square
  bool last = false;
  for (int i = 0; i < 30; i++) { // quadratic convergence needs about 6
    jet gap = closure(g, jet_constant(phi), jet_constant(kappa), (jet){*beta_r, 1, 0});
    if (!(gap.d > 0)) return false;
    real step = gap.v / gap.d;
    *beta_r -= step;
    if (!(fabsl(*beta_r - start) < reach)) return false;
    if (last) return true;
    last = fabsl(step) <= settled;
  }
  return false;
}

static real margin_at(const bike_geometry *g, real wheelbase, real phi, real kappa, real beta_r) {
  paper_pose p = complete_pose(g, jet_constant(phi), jet_constant(kappa), jet_constant(beta_r));
  real c = cosl(p.phi_tilde.v);
  real least = (p.T_r.v - p.T_f.v * c) / wheelbase;          // slope of (4)
  least = fminl(least, (p.T_r.v * c - p.T_f.v) / wheelbase); // denominator of (13)
  least = fminl(least, fminl(cosl(kappa), cosl(p.psi.v)));   // of (1)-(3)
  return fminl(least, fminl(cosl(p.beta_r.v), cosl(p.beta_f.v)));
}

// Root of (4) upright: (L_r + L_f) sin - L_s cos = R_f - R_r.
static real upright_root(const bike_geometry *g) {
  real angle = atan2l(g->L_s, (real)g->L_r + g->L_f); // of equal wheels
  for (int i = 0; i < 50; i++) {                      // far more than Newton needs
    jet gap = closure(g, jet_constant(0), jet_constant(0), (jet){angle, 1, 0});
    angle -= gap.v / gap.d;
  }
  return angle;
}

bool paper_root(real *beta_r, real *margin, const bike_geometry *geometry, real phi, real kappa) {
  const real right_angle = 2 * atanl(1);
  const real longest = 1 / 16.0L, shortest = 1e-7L; // of the way; a fold stops it at `shortest`
  if (!(fabsl(kappa) < right_angle)) return false;
  real angle = upright_root(geometry);
  paper_pose upright =
      complete_pose(geometry, jet_constant(0), jet_constant(0), jet_constant(angle));
  real wheelbase = upright.T_r.v - upright.T_f.v;
  real least = margin_at(geometry, wheelbase, 0, 0, angle);
  for (real done = 0, step = longest; done < 1;) {
    real next = fminl(done + step, 1), trial = angle;
    if (newton(&trial, geometry, next * phi, next * kappa)) {
      angle = trial;
      done = next;
      step = fminl(2 * step, longest);
      if (margin)
        least = fminl(least, margin_at(geometry, wheelbase, done * phi, done * kappa, angle));
    } else if ((step /= 2) < shortest) {
      return false;
    }
  }
  *beta_r = angle;
  if (margin) *margin = least;
  return true;
}

paper_pose paper_pose_of(const bike_geometry *geometry, jet phi, jet kappa, real root) {
  // Newton on jets gains one order of the derivative a step; the value is there already.
  jet beta_r = jet_constant(root);
  real slope = closure(geometry, jet_constant(phi.v), jet_constant(kappa.v), (jet){root, 1, 0}).d;
  for (int order = 0; order < 3; order++)
    beta_r = jet_sub(beta_r, jet_scale(closure(geometry, phi, kappa, beta_r), 1 / slope));
  return complete_pose(geometry, phi, kappa, beta_r);
}
