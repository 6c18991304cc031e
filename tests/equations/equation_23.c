// SPDX-License-Identifier: Apache-2.0
// The paper's own elimination of the ground forces, its equation (23).
#include "nine_equations.h"

typedef struct tally {
  vec sum;      // of the terms
  real lengths; // of the terms
} tally;

static void count(tally *t, vec term) {
  t->sum = vec_add(t->sum, term);
  t->lengths += vec_norm(term);
}

// A term direction (a . b), whose size is that before a and b cancel within the product: at nearly
// straight riding e_R^f . p' is a small difference of large numbers.
static void count_product(tally *t, vec direction, vec a, vec b) {
  t->sum = vec_add(t->sum, vec_scale(direction, vec_dot(a, b)));
  t->lengths += vec_norm(direction) * vec_norm(a) * vec_norm(b);
}

real equation_23(const bike_bicycle *bicycle, const bike_state *state, const bike_input *input,
                 const paper_motion *m, int weight_sign) {
  const vec e_R = {{0, 1, 0}}, e_A = {{0, 0, 1}};
  const bike_geometry *g = &bicycle->geometry;
  const real kappa = m->pose.kappa.v, turn = m->pose.phi_tilde.v;
  const real s = -sinl(kappa) * sinl(turn);
  const vec K = vec_sub(m->T_f, m->T_r);
  const vec w1 = vec_scale(m->e_z, sinl(turn) / (m->pose.T_r.v * cosl(m->pose.beta_r.v)));
  const vec w2 = vec_add(vec_scale(e_R, s), vec_scale(e_A, -cosl(turn)));
  const vec K_A = vec_cross(K, e_A), K_1 = vec_cross(K, w1), K_2 = vec_cross(K, w2);
  tally t = {{{0}}, 0};
  for (int i = 0; i < m->part_count; i++) {
    const paper_part *q = &m->part[i];
    const bike_assembly assembly = bicycle->parts[i].assembly;
    // p' + sign G, the weight G = -m g e_z
    vec force = vec_add(q->acceleration, vec_scale(m->e_z, -weight_sign * bicycle->gravity));
    force = vec_scale(force, q->mass);
    count(&t, vec_scale(q->torque, s));
    count(&t, vec_scale(vec_cross(vec_sub(q->place, m->T_f), force), s));
    count_product(&t, vec_scale(K_A, q->mass), m->e_R_front, q->acceleration);
    if (!q->front) {
      count_product(&t, K_1, vec_cross(m->e_S, q->place), force);
      count_product(&t, K_1, m->e_S, q->torque);
    }
    if (assembly == BIKE_REAR_WHEEL) count(&t, vec_scale(K_2, q->torque.c[0] / g->R_r));
    if (assembly == BIKE_FRONT_WHEEL)
      count_product(&t, vec_scale(K_A, -1 / (real)g->R_f), m->e_N_front, q->torque);
  }
  real M_S = input->steer_torque - (real)bicycle->steer_damping * state->steer_rate;
  count(&t, vec_scale(K_1, M_S));
  // A roll torque about e_R acts on the rear frame: it is in both sums, over all parts and rear.
  count(&t, vec_scale(e_R, -s * input->roll_torque));
  count(&t, vec_scale(K_1, -input->roll_torque * vec_dot(m->e_S, e_R)));
  return vec_norm(t.sum) / t.lengths;
}
