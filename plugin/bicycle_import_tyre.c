// SPDX-License-Identifier: Apache-2.0
// Whether what was taken for a wheel's tyre can be it. A brake disc and a hub shell are as round as
// a tyre; but other geoms of the wheel reach farther from the axle, its inertia needs mass farther
// out, or its hub stands higher than the radius.
#include "bicycle_import_internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

// A radius may fall short of what speaks against it by a fifth of that.
static const double least = 0.8;

static bool refuse(const import_view *v, int wheel, mjcf_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// Every refusal tells what the radius is, what speaks against it, and how to say which it is.
static bool refuse(const import_view *v, int wheel, mjcf_error *error, const char *format, ...) {
  const import_map *map = &v->map;
  const char *bodies[IMPORT_WHEELS];
  char why[160], name[64], geom[64], from[80];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(why, sizeof why, format, arguments);
  va_end(arguments);
  if (map->source[wheel] == IMPORT_GEOM)
    snprintf(
        from, sizeof from, "geom %s",
        import_name(geom, v->m->names + v->m->name_geomadr[map->geom[wheel]], map->geom[wheel]));
  else
    snprintf(from, sizeof from, "the height of its hub");
  for (int i = 0; i < IMPORT_WHEELS; i++) {
    bodies[i] = v->m->names + v->m->name_bodyadr[map->wheel[i]];
    if (!*bodies[i]) bodies[i] = "BODY";
  }
  return mjcf_fail(error,
                   "wheel %s: radius %.4g m from %s, but %s; mark both wheels with their radii R: "
                   "<custom><tuple name=\"rolling_discs\"><element objtype=\"body\" objname=\"%s\" "
                   "prm=\"R\"/><element objtype=\"body\" objname=\"%s\" "
                   "prm=\"R\"/></tuple></custom>",
                   import_body_name(name, v->m, map->wheel[wheel]), map->radius[wheel], from, why,
                   bodies[0], bodies[1]);
}

// How far a geom reaches along a unit vector from its centre. A box counts with its faces: a wheel
// may be drawn as one.
static double extent(const mjModel *m, int geom, const double along[3]) {
  const double *size = m->geom_size + 3 * geom;
  double scaled[3] = {size[0] * along[0], size[1] * along[1], size[2] * along[2]};
  double most = 0;
  switch (m->geom_type[geom]) {
  case mjGEOM_SPHERE:
    return size[0];
  case mjGEOM_CAPSULE:
    return size[0] + size[1] * fabs(along[2]);
  case mjGEOM_CYLINDER:
    return size[0] * hypot(along[0], along[1]) + size[1] * fabs(along[2]);
  case mjGEOM_ELLIPSOID:
    return mju_norm3(scaled);
  case mjGEOM_BOX:
    return fmax(fabs(scaled[0]), fmax(fabs(scaled[1]), fabs(scaled[2])));
  case mjGEOM_MESH: {
    int mesh = m->geom_dataid[geom];
    const float *vertex = m->mesh_vert + 3 * m->mesh_vertadr[mesh];
    for (int i = 0; i < m->mesh_vertnum[mesh]; i++, vertex += 3)
      most = fmax(most, vertex[0] * along[0] + vertex[1] * along[1] + vertex[2] * along[2]);
    return most;
  }
  default:
    return 0;
  }
}

// How far a geom reaches from the axle, to half a per cent.
static double reach(const import_view *v, int wheel, int geom) {
  enum { DIRECTIONS = 32 };
  const double *axle = import_axis(v, v->map.spin[wheel]);
  double first[3], second[3], arm[3], most = 0;
  const double other[3] = {fabs(axle[0]) < 0.5, fabs(axle[0]) >= 0.5, 0};
  mju_cross(first, axle, other);
  mju_normalize3(first);
  mju_cross(second, axle, first);
  mju_sub3(arm, v->d->geom_xpos + 3 * geom, import_anchor(v, v->map.spin[wheel]));
  for (int i = 0; i < DIRECTIONS; i++) {
    double direction[3], along[3], angle = 2 * mjPI * i / DIRECTIONS;
    mju_scl3(direction, first, cos(angle));
    mju_addToScl3(direction, second, sin(angle));
    mju_rotVecMatT(along, direction, v->d->geom_xmat + 9 * geom);
    most = fmax(most, mju_dot3(arm, direction) + extent(v->m, geom, along));
  }
  return most;
}

// Root of the moment about the axle over the mass: less than the radius of what holds the mass.
static double gyration(const import_view *v, int wheel) {
  const double *axle = import_axis(v, v->map.spin[wheel]);
  double centre[3], tensor[9], half[3];
  double mass = import_mass(centre, tensor, v, v->map.wheel[wheel]);
  mju_rotVecMat(half, axle, tensor);
  return sqrt(mju_dot3(half, axle) / mass);
}

bool import_check_tyre(const import_view *v, int wheel, mjcf_error *error) {
  double radius = v->map.radius[wheel], farthest = 0, turns = gyration(v, wheel);
  int outer = -1;
  char name[64];
  for (int g = 0; g < v->m->ngeom; g++) {
    if (v->assembly[v->m->geom_bodyid[g]] != v->map.wheel[wheel]) continue;
    double one = reach(v, wheel, g);
    if (one > farthest) farthest = one, outer = g;
  }
  bool too_small = radius < least * farthest;
  if (outer >= 0 &&
      (too_small || (v->map.source[wheel] == IMPORT_HEIGHT && farthest < least * radius)))
    return refuse(v, wheel, error, "geom %s of that wheel reaches %s%.4g m from the axle",
                  import_name(name, v->m->names + v->m->name_geomadr[outer], outer),
                  too_small ? "" : "farthest, ", farthest);
  return !(radius < least * turns) ||
         refuse(v, wheel, error, "the wheel's radius of gyration is %.4g m", turns);
}

// The bicycle is set down, without turning it, until a wheel touches the ground: it may hang in the
// air at qpos 0, and a little askew.
bool import_check_heights(const import_view *v, mjcf_error *error) {
  const import_map *map = &v->map;
  double down = fmin(map->clearance[0], map->clearance[1]);
  for (int i = 0; i < IMPORT_WHEELS; i++) {
    double height = map->radius[i] + map->clearance[i] - down;
    if (map->source[i] != IMPORT_MARKER && map->radius[i] < least * height)
      return refuse(v, i, error,
                    "its hub is %.4g m above the ground where the other wheel touches it", height);
  }
  return true;
}
