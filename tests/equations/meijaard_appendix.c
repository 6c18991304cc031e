// SPDX-License-Identifier: Apache-2.0
#include "meijaard_appendix.h"
#include <math.h>

typedef long double real;

// Mass, first and second moments of some parts in Meijaard's axes (x forward, z down) about the
// rear contact.
typedef struct moments {
  real m, mx, mz;
  real xx, xz, zz;
} moments;

static moments gather(const bike_bicycle *b, bool front_only) {
  moments t = {0};
  for (int i = 0; i < b->part_count; i++) {
    const bike_part *p = &b->parts[i];
    if (front_only && p->assembly != BIKE_FRONT_FRAME && p->assembly != BIKE_FRONT_WHEEL) continue;
    real m = p->mass, x = p->position[0], z = -(real)p->position[2];
    t.m += m;
    t.mx += m * x;
    t.mz += m * z;
    t.xx += p->inertia[0] + m * z * z;
    t.xz += -p->inertia[4] - m * x * z; // up = -z turns the product's sign
    t.zz += p->inertia[2] + m * x * x;
  }
  return t;
}

// Wheel spin per metre: S = sum of I_yy / r.
static real spin(const bike_bicycle *b, bike_assembly wheel, double radius) {
  real sum = 0;
  for (int i = 0; i < b->part_count; i++)
    if (b->parts[i].assembly == wheel) sum += b->parts[i].inertia[1];
  return sum / radius;
}

// Front assembly about the steering axis, (A5)-(A9).
typedef struct front_moments {
  real ll, lx, lz, S;
} front_moments;

static front_moments front_about_axis(const bike_bicycle *b, real w, real c, real lambda,
                                      const moments *T, real mu) {
  const moments A = gather(b, true);
  const real sl = sinl(lambda), cl = cosl(lambda);
  const real x = A.mx / A.m, z = A.mz / A.m;
  const real Ixx = A.xx - A.m * z * z, Ixz = A.xz + A.m * x * z, Izz = A.zz - A.m * x * x;
  const real u = (x - w - c) * cl - z * sl;
  return (front_moments){
      .ll = A.m * u * u + Ixx * sl * sl + 2 * Ixz * sl * cl + Izz * cl * cl,
      .lx = -A.m * u * z + Ixx * sl + Ixz * cl,
      .lz = A.m * u * x + Ixz * sl + Izz * cl,
      .S = A.m * u + mu * T->mx,
  };
}

bike_upright_matrices meijaard_matrices(const bike_bicycle *b) {
  // The upright tilt, from (L_r + L_f) sin - L_s cos = R_f - R_r.
  const bike_geometry *g = &b->geometry;
  const real base = (real)g->L_r + g->L_f, rise = (real)g->R_f - g->R_r;
  const real lambda = atan2l(g->L_s, base) + asinl(rise / hypotl(base, g->L_s));
  const real sl = sinl(lambda), cl = cosl(lambda);
  const real c = g->R_f * tanl(lambda) - g->L_f / cl;
  const real w = g->L_r / cl + g->R_r * tanl(lambda) - c;
  const moments T = gather(b, false);
  const real mu = c / w * cl;
  const real S_F = spin(b, BIKE_FRONT_WHEEL, g->R_f);
  const real S_T = spin(b, BIKE_REAR_WHEEL, g->R_r) + S_F;
  const front_moments F = front_about_axis(b, w, c, lambda, &T, mu);

  const real M01 = F.lx + mu * T.xz;
  const real C01 = mu * S_T + S_F * cl + T.xz / w * cl - mu * T.mz;
  const real C10 = -(mu * S_T + S_F * cl);
  const real C11 = F.lz / w * cl + mu * (F.S + T.zz / w * cl);
  const real K2_01 = (S_T - T.mz) / w * cl, K2_11 = (F.S + S_F * sl) / w * cl;
  return (bike_upright_matrices){
      .M = {(double)T.xx, (double)-M01, (double)-M01,
            (double)(F.ll + 2 * mu * F.lz + mu * mu * T.zz)},
      .C1 = {0, (double)-C01, (double)-C10, (double)C11},
      .K0 = {(double)T.mz, (double)F.S, (double)F.S, (double)(-F.S * sl)},
      .K2 = {0, (double)-K2_01, 0, (double)K2_11},
  };
}
