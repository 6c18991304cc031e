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

static void find_hub(mjtNum hub[3], const roll_wheel *wheel, const mjData *d) {
  const mjtNum *xpos = wheel->objtype == mjOBJ_BODY   ? d->xpos
                       : wheel->objtype == mjOBJ_GEOM ? d->geom_xpos
                                                      : d->site_xpos;
  mju_copy3(hub, xpos + 3 * wheel->objid);
}

static void find_axle(mjtNum axle[3], const roll_wheel *wheel, const mjData *d) {
  if (wheel->hinge >= 0) {
    mju_copy3(axle, d->xaxis + 3 * wheel->hinge);
  } else {
    const mjtNum *xmat = wheel->objtype == mjOBJ_GEOM ? d->geom_xmat : d->site_xmat;
    for (int k = 0; k < 3; k++) axle[k] = xmat[9 * wheel->objid + 3 * k + 2];
  }
}

// A disc is held along all three axes of the world; a blade along the normal and sideways:
// along the part of its axle that lies in the ground, (n - (n.u) u)/s.
static void set_directions(roll_contact *c) {
  mju_zero(c->direction[0], 9);
  c->rows = c->skate ? 2 : 3;
  if (!c->skate) {
    for (int k = 0; k < 3; k++) c->direction[k][k] = 1;
    return;
  }
  mju_copy3(c->direction[0], c->ground.normal);
  mju_addScl3(c->direction[1], c->axle, c->ground.normal, -c->cosine);
  mju_scl3(c->direction[1], c->direction[1], 1 / c->sine);
}

roll_error roll_place_contact(roll_contact *contact, const roll_wheel *wheel, int ground,
                              const mjData *d) {
  const mjtNum *u = contact->ground.normal, *n = contact->axle;
  mjtNum hub[3];
  find_hub(hub, wheel, d);
  find_axle(contact->axle, wheel, d);
  contact->body = wheel->body;
  contact->skate = wheel->skate;
  contact->radius = wheel->radius;
  contact->ground = roll_read_ground(d, ground);

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
  mju_sub3(from_origin, hub, contact->ground.origin);
  contact->height = mju_dot3(from_origin, u) - wheel->radius * s;
  set_directions(contact);
  return ROLL_OK;
}

mjtNum roll_upward(const roll_contact *contact, int row) {
  return mju_dot3(contact->direction[row], contact->ground.normal);
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
// e' = ((n'.u) n + (n.u) n' + e (n.u)(n'.u)/s)/s
static void relative_rate(mjtNum rate[3], const roll_contact *contact, const mjtNum w[3],
                          const mjtNum n_rate[3]) {
  const mjtNum *n = contact->axle, *e = contact->down;
  mjtNum turning[3];
  mju_cross(turning, w, e);
  mjtNum nu = contact->cosine, s = contact->sine,
         nu_rate = mju_dot3(n_rate, contact->ground.normal);
  for (int k = 0; k < 3; k++)
    rate[k] = (nu_rate * n[k] + nu * n_rate[k] + e[k] * nu * nu_rate / s) / s - turning[k];
}

// Of l = (n - (n.u) u)/s:  s s' = -(n.u)(n'.u);  l' = (n' - (n'.u) u - s' l)/s
static void set_sideways_rate(roll_contact *contact, const mjtNum n_rate[3]) {
  const mjtNum *u = contact->ground.normal, *l = contact->direction[1];
  mjtNum s = contact->sine, nu_rate = mju_dot3(n_rate, u), s_rate = -contact->cosine * nu_rate / s;
  for (int k = 0; k < 3; k++)
    contact->sideways_rate[k] = (n_rate[k] - nu_rate * u[k] - s_rate * l[k]) / s;
}

void roll_move_contact(roll_contact *contact, const mjModel *m, const mjData *d) {
  const mjtNum *w = d->cvel + 6 * contact->body, *v_com = w + 3;
  mjtNum acceleration[6], r[3], rate[3], n_rate[3], a[3], b[3], c[3];
  convective_acceleration(acceleration, m, d, contact->body);
  mju_sub3(r, contact->point, d->subtree_com + 3 * m->body_rootid[contact->body]);

  // v_p = v_O + w x r
  mju_cross(a, w, r);
  mju_add3(contact->velocity, v_com, a);

  // n' = w x n;  Jdot v = ab_lin + ab_rot x r + w x v_p + w x R (e' - w x e)
  mju_cross(n_rate, w, contact->axle);
  relative_rate(rate, contact, w, n_rate);
  if (contact->skate) set_sideways_rate(contact, n_rate);
  mju_cross(a, acceleration, r);
  mju_cross(b, w, contact->velocity);
  mju_cross(c, w, rate);
  for (int k = 0; k < 3; k++)
    contact->convective[k] = acceleration[3 + k] + a[k] + b[k] + contact->radius * c[k];
}
