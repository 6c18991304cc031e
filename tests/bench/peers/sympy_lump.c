// SPDX-License-Identifier: Apache-2.0
// From a bicycle's parts to the four rigid bodies of sympy's model.
#include "equations/upright_axes.h"
#include "sympy_bicycle.h"

// One assembly as a rigid body: mass, centre and tensor about it, in (x forward, y left, z up along
// the steering axis).
typedef struct lump {
  double mass, x, z;
  double xx, yy, zz, xz;
  bool symmetric;
} lump;

static bool is_front(bike_assembly assembly) {
  return assembly == BIKE_FRONT_FRAME || assembly == BIKE_FRONT_WHEEL;
}

// (N right, p forward, S up) has y = -N: the products with N change their sign and must vanish.
static void add_part(lump *sum, const bike_part *part, const upright_axes *axes) {
  double r[3], J[6];
  upright_place(r, axes, part->position, is_front(part->assembly));
  upright_tensor(J, axes, part->inertia);
  double x = r[1], z = r[2], m = part->mass, mass = sum->mass + m;
  // Steiner between the centres of what is there and what comes
  double share = sum->mass * m / mass, dx = x - sum->x, dz = z - sum->z;
  sum->xx += J[1] + share * dz * dz;
  sum->yy += J[0] + share * (dx * dx + dz * dz);
  sum->zz += J[2] + share * dx * dx;
  sum->xz += J[5] - share * dx * dz;
  sum->x += m / mass * dx;
  sum->z += m / mass * dz;
  sum->mass = mass;
  sum->symmetric &= r[0] == 0 && J[3] == 0 && J[4] == 0;
}

static lump lump_of(const bike_bicycle *bicycle, const upright_axes *axes, bike_assembly assembly) {
  lump sum = {.symmetric = true};
  for (int i = 0; i < bicycle->part_count; i++)
    if (bicycle->parts[i].assembly == assembly) add_part(&sum, &bicycle->parts[i], axes);
  return sum;
}

bool sympy_bicycle_init(sympy_bicycle *out, const bike_bicycle *bicycle, const bike_model *model) {
  const bike_geometry *g = &bicycle->geometry;
  bike_upright upright;
  if (bike_upright_position(&upright, g)) return false;
  upright_axes axes = upright_axes_of(g, &upright);
  lump r = lump_of(bicycle, &axes, BIKE_REAR_FRAME), w = lump_of(bicycle, &axes, BIKE_REAR_WHEEL);
  lump f = lump_of(bicycle, &axes, BIKE_FRONT_FRAME), v = lump_of(bicycle, &axes, BIKE_FRONT_WHEEL);
  *out = (sympy_bicycle){.R_r = g->R_r,
                         .R_f = g->R_f,
                         .L_r = g->L_r,
                         .L_f = g->L_f,
                         .L_s = g->L_s,
                         .gravity = bicycle->gravity,
                         .damping = bicycle->steer_damping,
                         .m_r = r.mass,
                         .x_r = r.x,
                         .z_r = r.z,
                         .r_xx = r.xx,
                         .r_yy = r.yy,
                         .r_zz = r.zz,
                         .r_xz = r.xz,
                         .m_w = w.mass,
                         .w_xx = w.xx,
                         .w_yy = w.yy,
                         .m_f = f.mass,
                         .x_f = f.x,
                         .z_f = f.z,
                         .f_xx = f.xx,
                         .f_yy = f.yy,
                         .f_zz = f.zz,
                         .f_xz = f.xz,
                         .m_v = v.mass,
                         .v_xx = v.xx,
                         .v_yy = v.yy,
                         .tilt = model->tilt,
                         .tilt_gain = model->tilt_gain};
  return r.symmetric && f.symmetric;
}
