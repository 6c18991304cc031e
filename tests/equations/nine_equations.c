// SPDX-License-Identifier: Apache-2.0
#include "nine_equations.h"

enum { UNKNOWNS = 9 };

// Motion and inputs, with what the sums over the parts need.
typedef struct scene {
  const paper_motion *motion;
  real gravity;
  real steer_moment; // M_S with the damper
  real roll_moment;  // about e_R, on the rear frame
} scene;

static scene scene_of(const bike_bicycle *b, const bike_state *state, const bike_input *input,
                      const paper_motion *motion) {
  return (scene){motion, b->gravity,
                 input->steer_torque - (real)b->steer_damping * state->steer_rate,
                 input->roll_torque};
}

// p' - G of a part.
static vec inertial(const scene *s, const paper_part *q) {
  return vec_scale(vec_add(q->acceleration, vec_scale(s->motion->e_z, s->gravity)), q->mass);
}

// Sum of L' + x x (p' - G) over the rear (front = 0) or front (front = 1) parts.
static vec moment_of(const scene *s, bool front) {
  vec sum = {{0}};
  for (const paper_part *q = s->motion->part; q < s->motion->part + s->motion->part_count; q++)
    if (q->front == front)
      sum = vec_add(sum, vec_add(q->torque, vec_cross(q->place, inertial(s, q))));
  return sum;
}

// L' of both wheels about their hubs; the torque on a wheel that has no such part is zero.
static void wheel_torques(const scene *s, const bike_bicycle *b, real *rear, real *front) {
  *rear = *front = 0;
  for (int i = 0; i < b->part_count; i++) {
    const vec torque = s->motion->part[i].torque;
    if (b->parts[i].assembly == BIKE_REAR_WHEEL) *rear += torque.c[0];
    if (b->parts[i].assembly == BIKE_FRONT_WHEEL) *front += vec_dot(s->motion->e_N_front, torque);
  }
}

static const vec e_R = {{0, 1, 0}};

// Left sides of (18)-(22) less the torques that act, without the ground forces.
static void without_ground(real out[UNKNOWNS], const scene *s, const bike_bicycle *b) {
  vec force = {{0}};
  for (int i = 0; i < s->motion->part_count; i++)
    force = vec_add(force, inertial(s, &s->motion->part[i]));
  vec front = moment_of(s, true);
  vec moment = vec_add(front, moment_of(s, false));
  moment = vec_sub(moment, vec_scale(e_R, s->roll_moment));
  for (int i = 0; i < 3; i++) {
    out[i] = force.c[i];      // (18)
    out[3 + i] = moment.c[i]; // (19)
  }
  wheel_torques(s, b, &out[6], &out[7]);                     // (20), (21)
  out[8] = vec_dot(s->motion->e_S, front) - s->steer_moment; // (22)
}

// Right sides of (18)-(22) for a ground force on one wheel.
static void ground(real out[UNKNOWNS], const paper_motion *m, const bike_geometry *g, bool front,
                   vec force) {
  vec moment = vec_cross(front ? m->T_f : m->T_r, force);
  for (int i = 0; i < 3; i++) {
    out[i] = force.c[i];
    out[3 + i] = moment.c[i];
  }
  out[6] = front ? 0 : g->R_r * force.c[1];
  out[7] = front ? g->R_f * vec_dot(m->e_R_front, force) : 0;
  out[8] = front ? vec_dot(m->e_S, moment) : 0;
}

// Gaussian elimination with scaled partial pivoting; false when singular to working precision.
static bool eliminate(real a[UNKNOWNS][UNKNOWNS + 1]) {
  for (int i = 0; i < UNKNOWNS; i++) {
    real largest = 0;
    for (int j = 0; j < UNKNOWNS; j++) largest = fmaxl(largest, fabsl(a[i][j]));
    if (!(largest > 0)) return false;
    for (int j = 0; j <= UNKNOWNS; j++) a[i][j] /= largest;
  }
  for (int k = 0; k < UNKNOWNS; k++) {
    int pivot = k;
    for (int i = k + 1; i < UNKNOWNS; i++)
      if (fabsl(a[i][k]) > fabsl(a[pivot][k])) pivot = i;
    if (!(fabsl(a[pivot][k]) > 1e-15L)) return false; // rows are scaled to 1: 4 digits left
    for (int j = k; j <= UNKNOWNS; j++) {
      real swap = a[k][j];
      a[k][j] = a[pivot][j];
      a[pivot][j] = swap;
    }
    for (int i = 0; i < UNKNOWNS; i++) {
      real factor = a[i][k] / a[k][k];
      for (int j = k; i != k && j <= UNKNOWNS; j++) a[i][j] -= factor * a[k][j];
    }
  }
  for (int k = 0; k < UNKNOWNS; k++) a[k][UNKNOWNS] /= a[k][k];
  return true;
}

// The equations are affine in the unknowns: their columns are differences at unit accelerations.
static void assemble(real a[UNKNOWNS][UNKNOWNS + 1], const bike_bicycle *b,
                     const paper_roots *roots, const bike_state *state, const bike_input *input) {
  const paper_acceleration trial[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  real column[UNKNOWNS], base[UNKNOWNS];
  for (int t = 0; t < 4; t++) {
    paper_motion m = paper_motion_of(b, roots, state, input, trial[t]);
    scene s = scene_of(b, state, input, &m);
    without_ground(t == 0 ? base : column, &s, b);
    for (int i = 0; i < UNKNOWNS && t > 0; i++) a[i][t - 1] = column[i] - base[i];
    for (int k = 0; k < 6 && t == 0; k++) {
      vec unit = {{k % 3 == 0, k % 3 == 1, k % 3 == 2}};
      ground(column, &m, &b->geometry, k >= 3, unit);
      for (int i = 0; i < UNKNOWNS; i++) a[i][3 + k] = -column[i];
    }
  }
  for (int i = 0; i < UNKNOWNS; i++) a[i][UNKNOWNS] = -base[i];
}

bool nine_solve(nine_solution *out, const bike_bicycle *bicycle, const bike_state *state,
                const bike_input *input) {
  real a[UNKNOWNS][UNKNOWNS + 1];
  paper_roots roots;
  if (!paper_roots_of(&roots, &bicycle->geometry, state)) return false;
  assemble(a, bicycle, &roots, state, input);
  if (!eliminate(a)) return false;
  out->acceleration = (paper_acceleration){a[0][9], a[1][9], a[2][9]};
  out->F_r = (vec){{a[3][9], a[4][9], a[5][9]}};
  out->F_f = (vec){{a[6][9], a[7][9], a[8][9]}};
  out->motion = paper_motion_of(bicycle, &roots, state, input, out->acceleration);
  return true;
}

void nine_level(double out[3], const paper_motion *motion, vec force) {
  out[0] = (double)force.c[1];
  out[1] = (double)vec_dot(vec_cross(motion->e_z, e_R), force);
  out[2] = (double)vec_dot(motion->e_z, force);
}
