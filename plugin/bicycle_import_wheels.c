// SPDX-License-Identifier: Apache-2.0
// Hubs and radii: from the marker of rolling discs, from the wheel's own shape, or from its height
// above the ground.
#include "bicycle_import_internal.h"

#include <math.h>

// What is known of a wheel: its centre in the world and its radius; 0: nothing.
typedef struct shape {
  double centre[3], radius;
  import_source source;
  int geom;
} shape;

// The marker's radius and centre (plugin/rolling.h); with contacts instead our models have the
// marker under another name.
static shape marked(const import_view *v, int body) {
  const mjModel *m = v->m;
  shape s = {.source = IMPORT_MARKER, .geom = -1};
  int tuple = mj_name2id(m, mjOBJ_TUPLE, "rolling_discs");
  if (tuple < 0) tuple = mj_name2id(m, mjOBJ_TUPLE, "contact_discs");
  for (int i = 0; tuple >= 0 && i < m->tuple_size[tuple]; i++) {
    int at = m->tuple_adr[tuple] + i, type = m->tuple_objtype[at], id = m->tuple_objid[at];
    if (!(m->tuple_objprm[at] > 0)) continue;
    if (type == mjOBJ_BODY && id == body)
      mju_copy3(s.centre, v->d->xpos + 3 * body);
    else if (type == mjOBJ_GEOM && v->assembly[m->geom_bodyid[id]] == body)
      mju_copy3(s.centre, v->d->geom_xpos + 3 * id);
    else if (type == mjOBJ_SITE && v->assembly[m->site_bodyid[id]] == body)
      mju_copy3(s.centre, v->d->site_xpos + 3 * id);
    else
      continue;
    s.radius = m->tuple_objprm[at];
  }
  return s;
}

// Radius of a geom as it turns about the axle; 0 where it is no round thing about it.
static double geom_radius(const import_view *v, int geom, const double axle[3]) {
  const double *size = v->m->geom_size + 3 * geom;
  double along[3];
  mju_rotVecMatT(along, axle, v->d->geom_xmat + 9 * geom);
  switch (v->m->geom_type[geom]) {
  case mjGEOM_SPHERE:
    return size[0];
  case mjGEOM_CYLINDER:
    return fabs(fabs(along[2]) - 1) <= IMPORT_TOLERANCE ? size[0] : 0;
  case mjGEOM_ELLIPSOID:
    for (int k = 0; k < 3; k++) {
      double a = size[(k + 1) % 3], b = size[(k + 2) % 3];
      if (fabs(fabs(along[k]) - 1) <= IMPORT_TOLERANCE && fabs(a - b) <= IMPORT_TOLERANCE * a)
        return a;
    }
    return 0;
  default:
    return 0;
  }
}

// The largest round geom; one that touches things before one that is only looked at.
static shape shaped(const import_view *v, int wheel) {
  const mjModel *m = v->m;
  shape best = {.source = IMPORT_GEOM, .geom = -1};
  bool touches = false;
  for (int g = 0; g < m->ngeom; g++) {
    if (v->assembly[m->geom_bodyid[g]] != v->map.wheel[wheel]) continue;
    double radius = geom_radius(v, g, import_axis(v, v->map.spin[wheel]));
    bool can_touch = m->geom_contype[g] != 0 || m->geom_conaffinity[g] != 0;
    if (radius == 0 || (touches && !can_touch)) continue;
    if (radius <= best.radius && touches == can_touch) continue;
    best.radius = radius;
    best.geom = g;
    mju_copy3(best.centre, v->d->geom_xpos + 3 * g);
    touches = can_touch;
  }
  return best;
}

// Distance of a point from the axle, which passes through the hinge's anchor.
static double off_axle(const import_view *v, int wheel, const double point[3]) {
  const double *n = import_axis(v, v->map.spin[wheel]);
  double arm[3];
  mju_sub3(arm, point, import_anchor(v, v->map.spin[wheel]));
  mju_addToScl3(arm, n, -mju_dot3(arm, n));
  return mju_norm3(arm);
}

// Height of a hub over the radius, of a wheel that stands on the ground: 1 of an upright one.
static double upright_share(const import_view *v, int wheel) {
  const double *n = import_axis(v, v->map.spin[wheel]);
  return hypot(n[0], n[1]);
}

// Of the plane that the model has for it; the wheels' discs roll on z = 0, which is as good.
static double ground_height(const import_view *v) {
  for (int g = 0; g < v->m->ngeom; g++)
    if (v->m->geom_type[g] == mjGEOM_PLANE && v->assembly[v->m->geom_bodyid[g]] == 0 &&
        v->d->geom_xmat[9 * g + 8] >= 1 - IMPORT_TOLERANCE)
      return v->d->geom_xpos[3 * g + 2];
  return 0;
}

static bool find_wheel(import_view *v, int wheel, mjcf_error *error) {
  int body = v->map.wheel[wheel];
  char name[64];
  double centre[3], tensor[9];
  import_mass(centre, tensor, v, body);
  if (!(off_axle(v, wheel, centre) <= IMPORT_TOLERANCE))
    return mjcf_fail(error, "not a bicycle: the mass centre of wheel %s is %.3g m off its axle",
                     import_body_name(name, v->m, body), off_axle(v, wheel, centre));
  shape s = marked(v, body);
  if (s.radius == 0 && mj_name2id(v->m, mjOBJ_TUPLE, "rolling_discs") >= 0)
    return mjcf_fail(error, "not a bicycle: the marker rolling_discs does not name wheel %s",
                     import_body_name(name, v->m, body));
  if (s.radius == 0) s = shaped(v, wheel);
  // A wheel of which nothing is said stands on the ground at qpos 0, its mass in its plane.
  if (s.radius == 0) {
    mju_copy3(s.centre, centre);
    s.radius = (centre[2] - ground_height(v)) / upright_share(v, wheel);
    s.source = IMPORT_HEIGHT;
  }
  if (!(s.radius > 0))
    return mjcf_fail(
        error,
        "not a bicycle: wheel %s has no radius: looked for the marker rolling_discs, a "
        "sphere, cylinder or ellipsoid about its axle, a height above the ground",
        import_body_name(name, v->m, body));
  if (!(off_axle(v, wheel, s.centre) <= IMPORT_TOLERANCE))
    return mjcf_fail(error, "not a bicycle: wheel %s is round about a point %.3g m off its axle",
                     import_body_name(name, v->m, body), off_axle(v, wheel, s.centre));
  double arm[3];
  mju_sub3(arm, s.centre, v->d->xpos + 3 * body);
  mju_rotVecMatT(v->map.hub[wheel], arm, v->d->xmat + 9 * body);
  v->map.radius[wheel] = s.radius;
  v->map.source[wheel] = s.source;
  v->map.geom[wheel] = s.geom;
  v->map.clearance[wheel] = s.centre[2] - ground_height(v) - s.radius * upright_share(v, wheel);
  return s.source == IMPORT_MARKER || import_check_tyre(v, wheel, error);
}

bool import_find_wheels(import_view *v, mjcf_error *error) {
  return find_wheel(v, 0, error) && find_wheel(v, 1, error) && import_check_heights(v, error);
}
