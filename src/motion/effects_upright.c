// SPDX-License-Identifier: Apache-2.0
#include "motion/effects_upright.h"

// Mass, first and second moments about the rear contact in (x forward, z down), and spins.
typedef struct moments {
  number m, mx, mz, xx, xz, zz;
} moments;

static void add_part(moments *sum, const vary_part *p) {
  number x = p->x, z = -p->up;
  sum->m += p->mass;
  sum->mx += p->mass * x;
  sum->mz += p->mass * z;
  sum->xx += p->inertia[0] + p->mass * z * z;
  sum->xz += -p->inertia[4] - p->mass * x * z; // up = -z turns the sign of the product
  sum->zz += p->inertia[2] + p->mass * x * x;
}

typedef struct sums {
  moments T, A;    // total, front assembly
  number S_R, S_F; // I_yy/r of the wheels
} sums;

static sums sums_of(const vary_bicycle *b) {
  sums s = {0};
  for (int i = 0; i < b->part_count; i++) {
    const vary_part *p = &b->parts[i];
    bool front = p->assembly == BIKE_FRONT_FRAME || p->assembly == BIKE_FRONT_WHEEL;
    add_part(&s.T, p);
    if (front) add_part(&s.A, p);
    if (p->assembly == BIKE_REAR_WHEEL) s.S_R += p->inertia[1] / b->R_r;
    if (p->assembly == BIKE_FRONT_WHEEL) s.S_F += p->inertia[1] / b->R_f;
  }
  return s;
}

upright_equations upright_equations_of(const vary_bicycle *b) {
  sums sum = sums_of(b);
  const moments *T = &sum.T, *A = &sum.A;
  number sl = csin(b->tilt), cl = ccos(b->tilt), cw = cl / b->wheelbase;
  number mu = b->trail * cw;
  // (A7)-(A9): the front assembly about the steering axis, u before it
  number axis = b->wheelbase + b->trail;
  number mu_A = (A->mx - A->m * axis) * cl - A->mz * sl; // m_A u_A
  number lx = axis * cl * A->mz + A->xx * sl + A->xz * cl;
  number lz = -axis * cl * A->mx + A->xz * sl + A->zz * cl;
  number ll = lx * sl + lz * cl - axis * cl * mu_A;
  number S_A = mu_A + mu * T->mx, S_T = sum.S_R + sum.S_F; // (A10)-(A12)
  number gyro = mu * S_T + sum.S_F * cl;
  number M_pd = lx + mu * T->xz;
  return (upright_equations){
      .M = {T->xx, M_pd, M_pd, ll + 2 * mu * lz + mu * mu * T->zz},
      .C1 = {0, gyro + T->xz * cw - mu * T->mz, -gyro, lz * cw + mu * (S_A + T->zz * cw)},
      .K0 = {T->mz, -S_A, -S_A, -S_A * sl},
      .K2 = {0, (S_T - T->mz) * cw, 0, (S_A + sum.S_F * sl) * cw},
  };
}

critical_functions critical_functions_at(const vary_bicycle *b, number v) {
  upright_equations e = upright_equations_of(b);
  number C[4], K[4], a[5];
  for (int i = 0; i < 4; i++) {
    C[i] = v * e.C1[i] + (i == 3 ? b->steer_damping : 0);
    K[i] = b->gravity * e.K0[i] + v * v * e.K2[i];
  }
  // det(M s^2 + C s + K) = a4 s^4 + ... + a0
  const number *M = e.M;
  a[4] = M[0] * M[3] - M[1] * M[2];
  a[3] = M[0] * C[3] + C[0] * M[3] - M[1] * C[2] - C[1] * M[2];
  a[2] = M[0] * K[3] + K[0] * M[3] - M[1] * K[2] - K[1] * M[2] + C[0] * C[3] - C[1] * C[2];
  a[1] = C[0] * K[3] + K[0] * C[3] - C[1] * K[2] - K[1] * C[2];
  a[0] = K[0] * K[3] - K[1] * K[2];
  return (critical_functions){
      .capsize = a[0],
      .weave = a[1] * a[2] * a[3] - a[1] * a[1] * a[4] - a[0] * a[3] * a[3],
  };
}
