// SPDX-License-Identifier: Apache-2.0
#include "paper_motion.h"
#include <stddef.h>

// What all parts of one bicycle share at one instant, as jets in time.
typedef struct frames {
  jetvec omega;       // of the moving basis, (11)
  jetmat rear, front; // D of (8)
  jetvec omega_rear, omega_front;
  jetvec hub_rear, hub_front;  // e_N, e_N^f
  jet rear_total, front_total; // rates of the wheels about their hubs, as in (16), (15)
  jet speed, slide;            // v, v + T_r'
  jetvec T_r;
} frames;

static jetvec along(int axis, jet length) {
  jetvec out = {{{0}}};
  out.c[axis] = length;
  return out;
}

enum { N, R, A };

// Basis velocity (11)-(13) and the speed of the front contact (14).
static void roll(paper_motion *m, frames *f, jet speed) {
  const paper_pose *p = &m->pose;
  jet sine = jet_sin(p->phi_tilde), cosine = jet_cos(p->phi_tilde);
  f->speed = speed;
  f->slide = jet_add(speed, jet_rate(p->T_r));
  // (13) corrected: Omega = ((v + T_r') sin + T_f phi_tilde') / (T_r cos - T_f)
  m->yaw_rate = jet_div(jet_add(jet_mul(f->slide, sine), jet_mul(p->T_f, jet_rate(p->phi_tilde))),
                        jet_sub(jet_mul(p->T_r, cosine), p->T_f));
  // (14)
  m->front_speed = jet_add(jet_sub(jet_mul(f->slide, cosine), jet_rate(p->T_f)),
                           jet_mul(jet_mul(p->T_r, m->yaw_rate), sine));
  // (11)
  f->omega = (jetvec){{jet_neg(jet_mul(m->yaw_rate, jet_sin(p->kappa))), jet_rate(p->kappa),
                       jet_mul(m->yaw_rate, jet_cos(p->kappa))}};
}

// Rotations of the frames and the spins of the wheels.
static void turn(paper_motion *m, frames *f, const bike_geometry *g) {
  const paper_pose *p = &m->pose;
  jetmat steer = jetmat_rotation(A, p->phi);
  f->rear = jetmat_rotation(N, p->beta_r);
  f->front = jetmat_multiply(&f->rear, &steer);
  f->hub_rear = jetmat_column(&f->rear, N);
  f->hub_front = jetmat_column(&f->front, N);
  f->omega_rear = jetvec_add(f->omega, along(N, jet_rate(p->beta_r)));
  f->omega_front =
      jetvec_add(f->omega_rear, jetvec_scale(jetmat_column(&f->front, A), jet_rate(p->phi)));
  // (16), (15)
  f->rear_total = jet_neg(
      jet_add(jet_scale(f->speed, 1 / (real)g->R_r), jet_mul(m->yaw_rate, jet_sin(p->kappa))));
  jet front_turn = jet_add(m->yaw_rate, jet_rate(p->phi_tilde));
  f->front_total = jet_neg(
      jet_add(jet_scale(m->front_speed, 1 / (real)g->R_f), jet_mul(front_turn, jet_sin(p->psi))));
  m->rear_wheel = jet_sub(jetvec_dot(f->omega_rear, f->hub_rear), f->rear_total);
  m->front_wheel = jet_sub(jetvec_dot(f->omega_front, f->hub_front), f->front_total);
}

// Contact points, and (12) corrected.
static void contacts(paper_motion *m, frames *f) {
  const paper_pose *p = &m->pose;
  jet zero = jet_constant(0), sine = jet_sin(p->phi_tilde), cosine = jet_cos(p->phi_tilde);
  jetvec e_z = {{jet_neg(jet_sin(p->kappa)), zero, jet_cos(p->kappa)}};
  jetvec e_R = along(R, jet_constant(1));
  jetvec left = jetvec_cross(e_z, e_R);
  jetvec e_R_front = jetvec_add(jetvec_scale(e_R, cosine), jetvec_scale(left, sine));
  f->T_r = along(R, jet_neg(p->T_r));
  m->T_r = jetvec_value(f->T_r);
  m->T_f = vec_scale(jetvec_value(e_R_front), -p->T_f.v);
  m->e_z = jetvec_value(e_z);
  m->e_S = jetvec_value(jetmat_column(&f->front, A));
  m->e_R_front = jetvec_value(e_R_front);
  m->e_N_front = jetvec_value(f->hub_front);
  vec turned = vec_scale(vec_cross(m->e_z, vec_sub(m->T_f, m->T_r)), m->yaw_rate.v);
  vec swung = vec_scale(vec_cross(m->e_z, m->e_R_front), -p->T_f.v * p->phi_tilde.d);
  vec stretched = vec_scale(m->e_R_front, -p->T_f.d);
  m->front_contact_rate = vec_add(vec_add(turned, swung), stretched);
  m->front_contact_rate.c[R] += p->T_r.d;
}

// x0 of a part: its place in the plane reference position, where e_S is the third axis.
static jetvec reference_place(const bike_part *part, const bike_input *input,
                              const paper_pose *upright) {
  real s = sinl(upright->beta_r.v), c = cosl(upright->beta_r.v);
  real ahead = part->position[0] - upright->T_r.v; // of the origin
  jetvec x0 = {{jet_constant(-part->position[1]), jet_constant(c * ahead + s * part->position[2]),
                jet_constant(-s * ahead + c * part->position[2] - upright->Z_0.v)}};
  if (part->rider)
    x0.c[N] = jet_add(x0.c[N],
                      (jet){input->rider_offset, input->rider_velocity, input->rider_acceleration});
  return x0;
}

// I w for the part's tensor, given in (forward, left, up), with w in the reference axes (N, p, S).
static jetvec reference_inertia(const double I[6], real tilt, jetvec w) {
  jetmat tilted = jetmat_rotation(N, jet_constant(tilt));
  jetvec upright = jetmat_apply(&tilted, w); // (right, forward, up)
  // right = -left, so that products of inertia with y change sign
  real tensor[3][3] = {{I[1], -I[3], -I[5]}, {-I[3], I[0], I[4]}, {-I[5], I[4], I[2]}};
  jetmat inertia;
  for (int i = 0; i < 9; i++) inertia.c[i / 3][i % 3] = jet_constant(tensor[i / 3][i % 3]);
  return jetmat_apply_transposed(&tilted, jetmat_apply(&inertia, upright));
}

// (8)-(10) for one part. A y stands for omega x y.
static void move(paper_part *q, const frames *f, const jetmat *D, jetvec x1) {
  jetvec turned = jetmat_apply(D, x1); // second derivative: D'' x1 + 2 D' x1' + D x1''
  jetvec arm = turned;
  arm.c[R] = jet_sub(arm.c[R], f->T_r.c[R]); // x - T_r
  jetvec slide = along(R, f->slide);
  // (9) corrected: x' = D' x1 + D x1' + A (x - T_r) + (v + T_r') e_R
  jetvec velocity = jetvec_add(jetvec_add(jetvec_rate(turned), jetvec_cross(f->omega, arm)), slide);
  vec w = jetvec_value(f->omega), dw = jetvec_first(f->omega), x = jetvec_value(arm);
  q->place = jetvec_value(turned);
  q->velocity = jetvec_value(velocity);
  q->derived = vec_add(jetvec_first(velocity), vec_cross(w, q->velocity));
  // (10) corrected: x'' = (D x1)'' + (A' - A^2)(x - T_r) + (v' + T_r'') e_R + A (2 x' - v e_R)
  vec twice = vec_scale(q->velocity, 2);
  twice.c[R] -= f->speed.v;
  q->acceleration = vec_add(jetvec_second(turned), vec_cross(w, twice));
  q->acceleration =
      vec_add(q->acceleration, vec_sub(vec_cross(dw, x), vec_cross(w, vec_cross(w, x))));
  q->acceleration.c[R] += f->slide.d;
}

static void spin(paper_part *q, const frames *f, const bike_part *part, real tilt) {
  const jetmat *D = q->front ? &f->front : &f->rear;
  jetvec omega = q->front ? f->omega_front : f->omega_rear;
  if (part->assembly == BIKE_REAR_WHEEL || part->assembly == BIKE_FRONT_WHEEL) {
    // A wheel has its frame's rates across the hub, and the rolling rate about it.
    jetvec hub = q->front ? f->hub_front : f->hub_rear;
    jet total = q->front ? f->front_total : f->rear_total;
    omega = jetvec_add(omega, jetvec_scale(hub, jet_sub(total, jetvec_dot(omega, hub))));
  }
  // (15)-(17) with the full tensor: L = D I D^T omega, L' = its derivative + A L
  jetvec local = reference_inertia(part->inertia, tilt, jetmat_apply_transposed(D, omega));
  jetvec L = jetmat_apply(D, local);
  q->angular_velocity = jetvec_value(omega);
  q->angular_momentum = jetvec_value(L);
  q->torque = vec_add(jetvec_first(L), vec_cross(jetvec_value(f->omega), q->angular_momentum));
}

bool paper_roots_of(paper_roots *out, const bike_geometry *geometry, const bike_state *state) {
  return paper_root(&out->upright, NULL, geometry, 0, 0) &&
         paper_root(&out->here, NULL, geometry, state->steer, state->lean);
}

paper_motion paper_motion_of(const bike_bicycle *bicycle, const paper_roots *roots,
                             const bike_state *state, const bike_input *input,
                             paper_acceleration acceleration) {
  const bike_geometry *g = &bicycle->geometry;
  paper_motion m = {.part_count = bicycle->part_count};
  paper_pose upright = paper_pose_of(g, jet_constant(0), jet_constant(0), roots->upright);
  m.pose = paper_pose_of(g, (jet){state->steer, state->steer_rate, acceleration.phi},
                         (jet){state->lean, state->lean_rate, acceleration.kappa}, roots->here);
  frames f;
  roll(&m, &f, (jet){state->speed, acceleration.v, NAN});
  turn(&m, &f, g);
  contacts(&m, &f);
  m.tilt = upright.beta_r.v;
  for (int i = 0; i < bicycle->part_count; i++) {
    const bike_part *part = &bicycle->parts[i];
    paper_part *q = &m.part[i];
    q->mass = part->mass;
    q->front = part->assembly == BIKE_FRONT_FRAME || part->assembly == BIKE_FRONT_WHEEL;
    jetvec x1 = reference_place(part, input, &upright);
    x1.c[A] = jet_add(x1.c[A], m.pose.Z_0);
    move(q, &f, q->front ? &f.front : &f.rear, x1);
    spin(q, &f, part, m.tilt);
  }
  return m;
}

real paper_kinetic(const paper_motion *m) {
  real twice = 0;
  for (const paper_part *q = m->part; q < m->part + m->part_count; q++)
    twice += q->mass * vec_dot(q->velocity, q->velocity) +
             vec_dot(q->angular_velocity, q->angular_momentum);
  return twice / 2;
}

real paper_potential(const paper_motion *m, real gravity) {
  real sum = 0;
  for (const paper_part *q = m->part; q < m->part + m->part_count; q++)
    sum += q->mass * gravity * vec_dot(m->e_z, q->place);
  return sum;
}

real paper_energy_rate(const paper_motion *m, real gravity) {
  real sum = 0;
  for (const paper_part *q = m->part; q < m->part + m->part_count; q++)
    sum += q->mass * vec_dot(q->velocity, q->acceleration) +
           q->mass * gravity * vec_dot(m->e_z, q->velocity) +
           vec_dot(q->angular_velocity, q->torque);
  return sum;
}
