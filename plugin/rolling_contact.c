// SPDX-License-Identifier: Apache-2.0
// Geometry and motion of one disc's contact point.
//
// u ground normal, n axle, R radius, c hub; e points from the hub to the lowest point of the disc:
//   s = |n x u|,  e = -(u - (n.u) n)/s,  p = c + R e,  height g = (c - o).u - R s.
// The disc rolls when the wheel's material at p is at rest; the rate of g is u times that velocity.
#include "rolling_internal.h"

#include <math.h>

// Below this sine of the angle to the ground's normal the contact point of a disc moves so fast
// (1/s) that its acceleration (1/s^2) has no correct digit left: the disc lies flat.
static const mjtNum flat_sine = 1e-6;

static void find_axle(mjtNum axle[3], const roll_wheel *wheel, const mjData *d) {
  if (wheel->hinge >= 0) {
    mju_copy3(axle, d->xaxis + 3 * wheel->hinge);
  } else {
    const mjtNum *R = d->geom_xmat + 9 * wheel->geom;
    axle[0] = R[2], axle[1] = R[5], axle[2] = R[8];
  }
}

roll_error roll_place_contact(roll_contact *contact, const roll_wheel *wheel, const mjData *d) {
  const roll_plane *ground = roll_ground();
  const mjtNum *u = ground->normal, *n = contact->axle;
  const mjtNum *hub = wheel->geom >= 0 ? d->geom_xpos + 3 * wheel->geom : d->xpos + 3 * wheel->body;
  find_axle(contact->axle, wheel, d);
  contact->body = wheel->body;
  contact->radius = wheel->radius;

  // s = |n x u|
  mjtNum across[3], from_origin[3];
  mju_cross(across, n, u);
  mjtNum s = contact->sine = mju_norm3(across);
  mjtNum cosine = contact->cosine = mju_dot3(n, u);
  if (s <= flat_sine) return ROLL_FLAT; // a NaN goes on, for MuJoCo to find in qacc

  // e = -(u - (n.u) n)/s;  p = c + R e;  g = (c - o).u - R s
  for (int k = 0; k < 3; k++) {
    contact->down[k] = -(u[k] - cosine * n[k]) / s;
    contact->point[k] = hub[k] + wheel->radius * contact->down[k];
  }
  mju_sub3(from_origin, hub, ground->origin);
  contact->height = mju_dot3(from_origin, u) - wheel->radius * s;
  return ROLL_OK;
}

// Sum over the dofs the body depends on of cdof_dot qvel: its spatial acceleration (rotation,
// translation of the point that is now at the subtree's centre of mass) for qacc = 0.
static void convective_acceleration(mjtNum acceleration[6], const mjModel *m, const mjData *d,
                                    int body) {
  mju_zero(acceleration, 6);
  while (body > 0 && m->body_dofnum[body] == 0) body = m->body_parentid[body];
  int dof = body > 0 ? m->body_dofadr[body] + m->body_dofnum[body] - 1 : -1;
  for (; dof >= 0; dof = m->dof_parentid[dof])
    mju_addToScl(acceleration, d->cdof_dot + 6 * dof, d->qvel[dof], 6);
}

// e' - w x e, the velocity of the contact point relative to the wheel's material, over R:
// n' = w x n;  e' = ((n'.u) n + (n.u) n' + e (n.u)(n'.u)/s)/s
static void relative_rate(mjtNum rate[3], const roll_contact *contact, const mjtNum w[3]) {
  const mjtNum *n = contact->axle, *e = contact->down, *u = roll_ground()->normal;
  mjtNum n_rate[3], turning[3];
  mju_cross(n_rate, w, n);
  mju_cross(turning, w, e);
  mjtNum nu = contact->cosine, nu_rate = mju_dot3(n_rate, u), s = contact->sine;
  for (int k = 0; k < 3; k++)
    rate[k] = (nu_rate * n[k] + nu * n_rate[k] + e[k] * nu * nu_rate / s) / s - turning[k];
}

void roll_move_contact(roll_contact *contact, const mjModel *m, const mjData *d) {
  const mjtNum *w = d->cvel + 6 * contact->body, *v_com = w + 3;
  mjtNum acceleration[6], r[3], rate[3], a[3], b[3], c[3];
  convective_acceleration(acceleration, m, d, contact->body);
  mju_sub3(r, contact->point, d->subtree_com + 3 * m->body_rootid[contact->body]);

  // v_p = v_O + w x r
  mju_cross(a, w, r);
  mju_add3(contact->velocity, v_com, a);

  // Jdot v = ab_lin + ab_rot x r + w x v_p + w x R (e' - w x e)
  relative_rate(rate, contact, w);
  mju_cross(a, acceleration, r);
  mju_cross(b, w, contact->velocity);
  mju_cross(c, w, rate);
  for (int k = 0; k < 3; k++)
    contact->convective[k] = acceleration[3 + k] + a[k] + b[k] + contact->radius * c[k];
}
