// SPDX-License-Identifier: Apache-2.0
// Which discs roll: the tuple "rolling_discs", read from the model at every call (0.1 us), so that
// nothing needs to be remembered about a model.
#include "rolling_internal.h"

#include <math.h>

roll_marker roll_find_marker(const mjModel *m) {
  int id = m->ntuple ? mj_name2id(m, mjOBJ_TUPLE, "rolling_discs") : -1;
  if (id < 0) return (roll_marker){0, 0};
  return (roll_marker){m->tuple_adr[id], m->tuple_size[id]};
}

// The last joint of a body, if it is a hinge: the only one whose axis is fixed in the body.
static int last_hinge(const mjModel *m, int body) {
  int last = m->body_jntadr[body] + m->body_jntnum[body] - 1;
  int is_hinge = m->body_jntnum[body] > 0 && m->jnt_type[last] == mjJNT_HINGE;
  return is_hinge ? last : -1;
}

roll_error roll_read_wheel(roll_wheel *wheel, const mjModel *m, int address) {
  int type = m->tuple_objtype[address], id = m->tuple_objid[address];
  if (type != mjOBJ_BODY && type != mjOBJ_GEOM) return ROLL_BAD_OBJECT;
  wheel->geom = type == mjOBJ_GEOM ? id : -1;
  wheel->body = type == mjOBJ_GEOM ? m->geom_bodyid[id] : id;
  wheel->hinge = last_hinge(m, wheel->body);
  wheel->radius = m->tuple_objprm[address];
  if (!(wheel->radius > 0 && isfinite(wheel->radius))) return ROLL_BAD_RADIUS;
  if (m->body_weldid[wheel->body] == 0) return ROLL_FIXED_BODY;
  if (wheel->hinge < 0 && wheel->geom < 0) return ROLL_NO_AXLE;
  return ROLL_OK;
}

const roll_plane *roll_ground(void) {
  static const roll_plane floor = {{0, 0, 0}, {0, 0, 1}};
  return &floor;
}

int roll_disc_count(const mjModel *m) {
  return roll_find_marker(m).count;
}

roll_error roll_check(int *element, const mjModel *m) {
  roll_marker marker = roll_find_marker(m);
  roll_error error = marker.count ? ROLL_OK : ROLL_NO_MARKER;
  int i = 0;
  for (; error == ROLL_OK && i < marker.count; i++) {
    roll_wheel wheel;
    error = roll_read_wheel(&wheel, m, marker.first + i);
  }
  if (element) *element = error && marker.count ? i - 1 : -1;
  return error;
}
