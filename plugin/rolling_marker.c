// SPDX-License-Identifier: Apache-2.0
// What rolls: the tuples of the marker, read from the model at every call (0.1 us), so that nothing
// needs to be remembered about a model.
#include "rolling_internal.h"

#include <math.h>
#include <string.h>

roll_kind roll_kind_of(const char *name) {
  static const char prefix[] = "rolling_";
  if (strncmp(name, prefix, sizeof prefix - 1) != 0) return ROLL_KIND_FOREIGN;
  const char *word = name + sizeof prefix - 1;
  if (strcmp(word, "discs") == 0) return ROLL_KIND_DISCS;
  if (strcmp(word, "skates") == 0) return ROLL_KIND_SKATES;
  return strcmp(word, "driven") == 0 ? ROLL_KIND_DRIVEN : ROLL_KIND_UNKNOWN;
}

roll_marker roll_find_marker(const mjModel *m) {
  roll_marker marker = {{0, 0}, {0, 0}, {0, 0}};
  for (int i = 0; i < m->ntuple; i++) {
    roll_kind kind = roll_kind_of(m->names + m->name_tupleadr[i]);
    roll_span span = {m->tuple_adr[i], m->tuple_size[i]};
    if (kind == ROLL_KIND_DISCS) marker.discs = span;
    if (kind == ROLL_KIND_SKATES) marker.skates = span;
    if (kind == ROLL_KIND_DRIVEN) marker.driven = span;
  }
  return marker;
}

int roll_is_marked(const roll_marker *marker) {
  return marker->discs.count + marker->skates.count + marker->driven.count > 0;
}

int roll_is_ground(const mjModel *m, int address) {
  return m->tuple_objtype[address] == mjOBJ_GEOM &&
         m->geom_type[m->tuple_objid[address]] == mjGEOM_PLANE;
}

int roll_count_wheels(const mjModel *m, roll_span span) {
  int count = 0;
  for (int i = 0; i < span.count; i++) count += !roll_is_ground(m, span.first + i);
  return count;
}

roll_object roll_element(const mjModel *m, int address) {
  return (roll_object){m->tuple_objtype[address], m->tuple_objid[address]};
}

const char *roll_element_name(const mjModel *m, int address) {
  roll_object object = roll_element(m, address);
  const char *name = mj_id2name(m, object.type, object.id);
  return name ? name : "";
}

//---------------------------------- ground --------------------------------------------------------

static int moves(const mjModel *m, int ground) {
  if (ground < 0) return 0;
  int body = m->geom_bodyid[ground], moves = m->body_weldid[body] != 0;
  for (; body > 0; body = m->body_parentid[body]) moves |= m->body_mocapid[body] >= 0;
  return moves;
}

roll_plane roll_read_ground(const mjData *d, int ground) {
  roll_plane plane = {{0, 0, 0}, {0, 0, 1}};
  if (ground < 0) return plane;
  const mjtNum *R = d->geom_xmat + 9 * ground;
  mju_copy3(plane.origin, d->geom_xpos + 3 * ground);
  for (int k = 0; k < 3; k++) plane.normal[k] = R[3 * k + 2];
  return plane;
}

//---------------------------------- wheels --------------------------------------------------------

// The last joint of a body, if it is a hinge: the only one whose axis is fixed in the body.
static int last_hinge(const mjModel *m, int body) {
  int last = m->body_jntadr[body] + m->body_jntnum[body] - 1;
  int is_hinge = m->body_jntnum[body] > 0 && m->jnt_type[last] == mjJNT_HINGE;
  return is_hinge ? last : -1;
}

// 0 for a geom that is not round.
static mjtNum geom_radius(const mjModel *m, int geom) {
  const mjtNum *size = m->geom_size + 3 * geom;
  switch (m->geom_type[geom]) {
  case mjGEOM_SPHERE:
  case mjGEOM_CYLINDER:
    return size[0];
  case mjGEOM_ELLIPSOID:
    return fmax(size[0], fmax(size[1], size[2]));
  default:
    return 0;
  }
}

// Radius of the body's only round geom; 0 without one or with several.
static mjtNum body_radius(const mjModel *m, int body) {
  mjtNum radius = 0;
  for (int i = 0; i < m->body_geomnum[body]; i++) {
    mjtNum r = geom_radius(m, m->body_geomadr[body] + i);
    if (r > 0 && radius > 0) return 0;
    radius = fmax(radius, r);
  }
  return radius;
}

static mjtNum own_radius(const mjModel *m, int objtype, int objid) {
  if (objtype == mjOBJ_BODY) return body_radius(m, objid);
  return objtype == mjOBJ_GEOM ? geom_radius(m, objid) : 0;
}

static int body_of(const mjModel *m, int objtype, int objid) {
  switch (objtype) {
  case mjOBJ_BODY:
    return objid;
  case mjOBJ_GEOM:
    return m->geom_bodyid[objid];
  case mjOBJ_SITE:
    return m->site_bodyid[objid];
  default:
    return -1;
  }
}

roll_error roll_read_wheel(roll_wheel *wheel, const mjModel *m, int address, int ground,
                           int skate) {
  int type = wheel->objtype = m->tuple_objtype[address];
  int id = wheel->objid = m->tuple_objid[address];
  wheel->skate = skate;
  wheel->body = body_of(m, type, id);
  if (wheel->body < 0) return skate ? ROLL_BAD_SKATE : ROLL_BAD_OBJECT;
  if (skate && type == mjOBJ_BODY) return ROLL_BAD_SKATE;
  wheel->hinge = skate ? -1 : last_hinge(m, wheel->body);
  wheel->radius = m->tuple_objprm[address];
  if (wheel->radius == 0 && !skate) wheel->radius = own_radius(m, type, id);
  int has_size = wheel->radius > 0 || (skate && wheel->radius == 0);
  if (!has_size || !isfinite(wheel->radius)) return ROLL_BAD_RADIUS;
  if (m->body_weldid[wheel->body] == 0) return ROLL_FIXED_BODY;
  if (wheel->hinge < 0 && type == mjOBJ_BODY) return ROLL_NO_AXLE;
  return moves(m, ground) ? ROLL_BAD_GROUND : ROLL_OK;
}

roll_object roll_wheel_fault(roll_error error, const mjModel *m, int address, int ground) {
  return error == ROLL_BAD_GROUND ? (roll_object){mjOBJ_GEOM, ground} : roll_element(m, address);
}

//---------------------------------- for the host --------------------------------------------------

int roll_disc_count(const mjModel *m) {
  roll_marker marker = roll_find_marker(m);
  return roll_count_wheels(m, marker.discs) + roll_count_wheels(m, marker.skates);
}

int roll_drive_count(const mjModel *m) {
  return roll_find_marker(m).driven.count;
}
