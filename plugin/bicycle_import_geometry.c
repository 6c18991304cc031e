// SPDX-License-Identifier: Apache-2.0
// Which wheel is which, where forward, left and up are, and the five lengths: all from hubs, axles
// and the steering axis relative to each other, so that the place at qpos 0 does not matter.
#include "bicycle_import_internal.h"

#include <bicycle/error.h>
#include <math.h>

typedef struct plane {
  double hub[IMPORT_WHEELS][3]; // m
  double anchor[3], axis[3];    // of the steer, axis upwards
  double forward[3], left[3], up[3];
} plane;

static void swap_wheels(import_map *map) {
  import_map old = *map;
  for (int i = 0; i < IMPORT_WHEELS; i++) {
    map->spin[i] = old.spin[1 - i];
    map->half[i] = old.half[1 - i];
    map->wheel[i] = old.wheel[1 - i];
    map->radius[i] = old.radius[1 - i];
    map->source[i] = old.source[1 - i];
    map->geom[i] = old.geom[1 - i];
    map->clearance[i] = old.clearance[1 - i];
    mju_copy3(map->hub[i], old.hub[1 - i]);
  }
}

static double off_steer(const import_view *v, int wheel) {
  double hub[3], arm[3];
  const double *axis = import_axis(v, v->map.steer);
  import_hub(hub, v, wheel);
  mju_sub3(arm, hub, import_anchor(v, v->map.steer));
  mju_addToScl3(arm, axis, -mju_dot3(arm, axis));
  return mju_norm3(arm);
}

// The plane of the wheels: left along the rear axle, so that up is up and the front wheel in front.
static bool find_plane(plane *p, const import_view *v, mjcf_error *error) {
  const double *rear = import_axis(v, v->map.spin[IMPORT_REAR]);
  const double *front = import_axis(v, v->map.spin[IMPORT_FRONT]);
  double between[3], cross[3];
  for (int i = 0; i < IMPORT_WHEELS; i++) import_hub(p->hub[i], v, i);
  mju_copy3(p->anchor, import_anchor(v, v->map.steer));
  mju_copy3(p->axis, import_axis(v, v->map.steer));
  mju_cross(cross, rear, front);
  if (!(mju_norm3(cross) <= IMPORT_TOLERANCE))
    return mjcf_fail(error,
                     "not a bicycle: at qpos 0 the axles are not parallel (%.3g rad): it must "
                     "be unsteered there",
                     asin(fmin(1, mju_norm3(cross))));
  if (!(fabs(rear[2]) < 0.7)) // 45 degrees: beyond, up could be meant either way
    return mjcf_fail(error, "not a bicycle: at qpos 0 it lies on its side");
  mju_copy3(p->left, rear);
  mju_sub3(between, p->hub[IMPORT_FRONT], p->hub[IMPORT_REAR]);
  // up = forward x left is upwards, or left is right.
  mju_cross(p->up, between, p->left);
  if (p->up[2] < 0) mju_scl3(p->left, p->left, -1);
  mju_cross(p->up, between, p->left);
  if (mju_dot3(p->up, p->axis) < 0) mju_scl3(p->axis, p->axis, -1);
  double off = fabs(mju_dot3(p->left, between)), arm[3];
  mju_sub3(arm, p->anchor, p->hub[IMPORT_REAR]);
  off = fmax(off, fabs(mju_dot3(p->left, arm)));
  if (!(off <= IMPORT_TOLERANCE && fabs(mju_dot3(p->left, p->axis)) <= IMPORT_TOLERANCE))
    return mjcf_fail(error,
                     "not a bicycle: hubs and steering axis are not in one plane (off by %.3g m, "
                     "the axis tilts sideways by %.3g rad)",
                     off, fabs(mju_dot3(p->left, p->axis)));
  return true;
}

// L_f = e_p.(front - a), L_r = -e_p.(rear - a), L_s = e_S.(rear - front);  e_p = left x e_S
static void find_lengths(bike_geometry *out, const plane *p, const import_map *map) {
  double e_p[3], to_rear[3], to_front[3], hubs[3];
  mju_cross(e_p, p->left, p->axis);
  mju_sub3(to_rear, p->hub[IMPORT_REAR], p->anchor);
  mju_sub3(to_front, p->hub[IMPORT_FRONT], p->anchor);
  mju_sub3(hubs, p->hub[IMPORT_REAR], p->hub[IMPORT_FRONT]);
  *out = (bike_geometry){.L_r = -mju_dot3(e_p, to_rear),
                         .L_f = mju_dot3(e_p, to_front),
                         .L_s = mju_dot3(p->axis, hubs),
                         .R_r = map->radius[IMPORT_REAR],
                         .R_f = map->radius[IMPORT_FRONT]};
}

// f = cos(tilt) e_p - sin(tilt) e_S,  u = sin(tilt) e_p + cos(tilt) e_S: as the bicycle stands.
static void find_upright_axes(plane *p, double tilt) {
  double e_p[3];
  mju_cross(e_p, p->left, p->axis);
  for (int k = 0; k < 3; k++) {
    p->forward[k] = cos(tilt) * e_p[k] - sin(tilt) * p->axis[k];
    p->up[k] = sin(tilt) * e_p[k] + cos(tilt) * p->axis[k];
  }
}

static int sign_of(double number) {
  return number < 0 ? -1 : 1;
}

bool import_find_geometry(import_view *v, mjcf_error *error) {
  plane p;
  if (off_steer(v, IMPORT_REAR) < off_steer(v, IMPORT_FRONT)) swap_wheels(&v->map);
  if (!find_plane(&p, v, error)) return false;
  find_lengths(&v->geometry, &p, &v->map);
  int code = bike_upright_position(&v->upright, &v->geometry);
  if (code != BIKE_OK) return mjcf_fail(error, "not a bicycle: %s", bike_error_string(code));
  find_upright_axes(&p, v->upright.tilt);
  mju_copy3(v->map.travel, p.forward);
  const double *frame = v->d->xmat + 9 * v->map.half[IMPORT_REAR];
  mju_rotVecMatT(v->map.forward, p.forward, frame);
  mju_rotVecMatT(v->map.left, p.left, frame);
  mju_rotVecMatT(v->map.up, p.up, frame);
  // A hinge turns what hangs on it: of a bicycle that hangs on its fork, the rear the other way.
  v->map.steer_sign = sign_of(mju_dot3(p.axis, import_axis(v, v->map.steer))) *
                      (v->map.top == v->map.half[IMPORT_REAR] ? 1 : -1);
  for (int i = 0; i < IMPORT_WHEELS; i++)
    v->map.spin_sign[i] = sign_of(mju_dot3(p.left, import_axis(v, v->map.spin[i])));
  return true;
}
