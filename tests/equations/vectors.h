// SPDX-License-Identifier: Apache-2.0
// Vectors of reals and of jets, and rotations of jets, for the oracle of the equations.
#ifndef BICYCLE_TESTS_VECTORS_H
#define BICYCLE_TESTS_VECTORS_H

#include "jet.h"

typedef struct vec {
  real c[3];
} vec;

typedef struct jetvec {
  jet c[3];
} jetvec;

typedef struct jetmat {
  jet c[3][3];
} jetmat;

static inline vec vec_add(vec a, vec b) {
  return (vec){{a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]}};
}

static inline vec vec_scale(vec a, real s) {
  return (vec){{a.c[0] * s, a.c[1] * s, a.c[2] * s}};
}

static inline vec vec_sub(vec a, vec b) {
  return vec_add(a, vec_scale(b, -1));
}

static inline real vec_dot(vec a, vec b) {
  return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}

static inline real vec_norm(vec a) {
  return sqrtl(vec_dot(a, a));
}

static inline vec vec_cross(vec a, vec b) {
  return (vec){{a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2],
                a.c[0] * b.c[1] - a.c[1] * b.c[0]}};
}

static inline jetvec jetvec_add(jetvec a, jetvec b) {
  jetvec sum;
  for (int i = 0; i < 3; i++) sum.c[i] = jet_add(a.c[i], b.c[i]);
  return sum;
}

static inline jetvec jetvec_scale(jetvec a, jet s) {
  jetvec scaled;
  for (int i = 0; i < 3; i++) scaled.c[i] = jet_mul(a.c[i], s);
  return scaled;
}

static inline jet jetvec_dot(jetvec a, jetvec b) {
  jet sum = jet_mul(a.c[0], b.c[0]);
  for (int i = 1; i < 3; i++) sum = jet_add(sum, jet_mul(a.c[i], b.c[i]));
  return sum;
}

static inline jetvec jetvec_cross(jetvec a, jetvec b) {
  jetvec product;
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    product.c[i] = jet_sub(jet_mul(a.c[j], b.c[k]), jet_mul(a.c[k], b.c[j]));
  }
  return product;
}

static inline jetvec jetvec_rate(jetvec a) {
  return (jetvec){{jet_rate(a.c[0]), jet_rate(a.c[1]), jet_rate(a.c[2])}};
}

// Values, first and second derivatives of the components.
static inline vec jetvec_value(jetvec a) {
  return (vec){{a.c[0].v, a.c[1].v, a.c[2].v}};
}

static inline vec jetvec_first(jetvec a) {
  return (vec){{a.c[0].d, a.c[1].d, a.c[2].d}};
}

static inline vec jetvec_second(jetvec a) {
  return (vec){{a.c[0].dd, a.c[1].dd, a.c[2].dd}};
}

static inline jetvec jetmat_apply(const jetmat *m, jetvec a) {
  jetvec out;
  for (int i = 0; i < 3; i++)
    out.c[i] = jetvec_dot((jetvec){{m->c[i][0], m->c[i][1], m->c[i][2]}}, a);
  return out;
}

static inline jetvec jetmat_apply_transposed(const jetmat *m, jetvec a) {
  jetvec out;
  for (int i = 0; i < 3; i++)
    out.c[i] = jetvec_dot((jetvec){{m->c[0][i], m->c[1][i], m->c[2][i]}}, a);
  return out;
}

static inline jetvec jetmat_column(const jetmat *m, int column) {
  return (jetvec){{m->c[0][column], m->c[1][column], m->c[2][column]}};
}

static inline jetmat jetmat_multiply(const jetmat *a, const jetmat *b) {
  jetmat out;
  for (int j = 0; j < 3; j++) {
    jetvec column = jetmat_apply(a, jetmat_column(b, j));
    for (int i = 0; i < 3; i++) out.c[i][j] = column.c[i];
  }
  return out;
}

// Right-handed rotation by an angle about a coordinate axis (0, 1, 2).
static inline jetmat jetmat_rotation(int axis, jet angle) {
  int j = (axis + 1) % 3, k = (axis + 2) % 3;
  jetmat out = {{{{0}}}};
  out.c[axis][axis] = jet_constant(1);
  out.c[j][j] = out.c[k][k] = jet_cos(angle);
  out.c[k][j] = jet_sin(angle);
  out.c[j][k] = jet_neg(jet_sin(angle));
  return out;
}

#endif
