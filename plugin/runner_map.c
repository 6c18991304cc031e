// SPDX-License-Identifier: Apache-2.0
// Finding the bicycle in a model: names, types and directions, each checked.
#include "runner_internal.h"

#include <math.h>
#include <string.h>

// Directions of a generated model are exact but for the rounding of a normalisation.
static const double direction_tolerance = 1e-12;

static bool find_body(int *out, const mjModel *m, const char *name, int parent, mjcf_error *error) {
  *out = mj_name2id(m, mjOBJ_BODY, name);
  if (*out < 0) return mjcf_fail(error, "not a bicycle: there is no body '%s'", name);
  if (m->body_parentid[*out] != parent)
    return mjcf_fail(error, "not a bicycle: the parent of body '%s' is not '%s'", name,
                     m->names + m->name_bodyadr[parent]);
  static const double unit[4] = {1, 0, 0, 0};
  for (int k = 0; k < 4; k++)
    if (fabs(m->body_quat[4 * *out + k] - unit[k]) > direction_tolerance)
      return mjcf_fail(error, "not a bicycle: body '%s' is turned at qpos 0", name);
  return true;
}

static bool find_joint(runner_hinge *out, const mjModel *m, const char *name, int body, int type,
                       mjcf_error *error) {
  out->joint = mj_name2id(m, mjOBJ_JOINT, name);
  if (out->joint < 0) return mjcf_fail(error, "not a bicycle: there is no joint '%s'", name);
  if (m->jnt_bodyid[out->joint] != body)
    return mjcf_fail(error, "not a bicycle: joint '%s' is not in body '%s'", name,
                     m->names + m->name_bodyadr[body]);
  if (m->jnt_type[out->joint] != type)
    return mjcf_fail(error, "not a bicycle: joint '%s' has another type", name);
  if (mju_norm3(m->jnt_pos + 3 * out->joint) > direction_tolerance)
    return mjcf_fail(error, "not a bicycle: joint '%s' is not in the origin of its body", name);
  *out = (runner_hinge){out->joint, m->jnt_qposadr[out->joint], m->jnt_dofadr[out->joint], 1, 0};
  return true;
}

// A joint about or along a coordinate axis.
static bool find_axis_joint(runner_hinge *out, const mjModel *m, const char *name, int body,
                            int type, int axis, mjcf_error *error) {
  if (!find_joint(out, m, name, body, type, error)) return false;
  for (int k = 0; k < 3; k++)
    if (fabs(m->jnt_axis[3 * out->joint + k] - (k == axis)) > direction_tolerance)
      return mjcf_fail(error, "not a bicycle: joint '%s' has another axis", name);
  return true;
}

static bool find_root(runner_map *map, const mjModel *m, mjcf_error *error) {
  int first = m->body_jntnum[map->frame] > 0 ? m->body_jntadr[map->frame] : -1;
  if (first >= 0 && m->jnt_type[first] == mjJNT_FREE) {
    map->free_root = true;
    map->root_qpos = m->jnt_qposadr[first];
    map->root_dof = m->jnt_dofadr[first];
    return true;
  }
  static const struct {
    const char *name;
    int type, axis;
  } joints[6] = {{"x", mjJNT_SLIDE, 0},   {"y", mjJNT_SLIDE, 1},    {"z", mjJNT_SLIDE, 2},
                 {"yaw", mjJNT_HINGE, 2}, {"roll", mjJNT_HINGE, 0}, {"pitch", mjJNT_HINGE, 1}};
  for (int i = 0; i < 6; i++) {
    runner_hinge joint;
    if (!find_axis_joint(&joint, m, joints[i].name, map->frame, joints[i].type, joints[i].axis,
                         error))
      return false;
    if (i == 0) map->root_qpos = joint.qpos, map->root_dof = joint.dof;
    if (joint.qpos != map->root_qpos + i)
      return mjcf_fail(error, "not a bicycle: the root's joints are not x, y, z, yaw, roll, pitch");
  }
  return true;
}

static bool find_radius(runner_wheel *wheel, const mjModel *m, int tuple, mjcf_error *error) {
  for (int i = 0; i < m->tuple_size[tuple]; i++) {
    int element = m->tuple_adr[tuple] + i;
    if (m->tuple_objtype[element] != mjOBJ_BODY || m->tuple_objid[element] != wheel->body) continue;
    wheel->radius = m->tuple_objprm[element];
    if (isfinite(wheel->radius) && wheel->radius > 0) return true;
    return mjcf_fail(error, "not a bicycle: the radius (prm) of '%s' is not positive",
                     m->names + m->name_bodyadr[wheel->body]);
  }
  return mjcf_fail(error, "not a bicycle: tuple '%s' does not name body '%s'",
                   m->names + m->name_tupleadr[tuple], m->names + m->name_bodyadr[wheel->body]);
}

static bool find_radii(runner_map *map, const mjModel *m, mjcf_error *error) {
  int tuple = mj_name2id(m, mjOBJ_TUPLE, "rolling_discs");
  map->exact = tuple >= 0;
  if (!map->exact) tuple = mj_name2id(m, mjOBJ_TUPLE, "contact_discs");
  if (tuple < 0)
    return mjcf_fail(error, "not a bicycle: there is no tuple 'rolling_discs' or 'contact_discs'");
  if (map->exact && runner_check_marker(m, error) != ROLL_OK) return false;
  return find_radius(&map->wheel[RUNNER_REAR], m, tuple, error) &&
         find_radius(&map->wheel[RUNNER_FRONT], m, tuple, error);
}

// A slide to the right of the frame.
static bool points_right(const mjModel *m, int joint, int frame) {
  const mjtNum *axis = m->jnt_axis + 3 * joint;
  int body = m->jnt_bodyid[joint];
  return m->jnt_type[joint] == mjJNT_SLIDE && m->body_parentid[body] == frame && axis[1] < 0 &&
         hypot(axis[0], axis[2]) <= direction_tolerance &&
         mju_norm3(m->body_quat + 4 * body + 1) <= direction_tolerance;
}

// The rider whose place userdata says; one who sways by a numeric of his own needs nobody, but does
// work all the same.
static void find_rider(runner_rider *out, const mjModel *m, int frame) {
  int joint = mj_name2id(m, mjOBJ_JOINT, "rider");
  int tuple = mj_name2id(m, mjOBJ_TUPLE, "rolling_driven");
  int actuator = mj_name2id(m, mjOBJ_ACTUATOR, "rolling:rider:work");
  if (joint < 0 || tuple < 0 || actuator < 0 || !points_right(m, joint, frame)) return;
  bool by_himself = mj_name2id(m, mjOBJ_NUMERIC, "driven:rider") >= 0;
  // Activations belong to the last actuators.
  int work = actuator - (m->nu - m->na);
  if (work < 0) return;
  for (int i = m->tuple_adr[tuple]; i < m->tuple_adr[tuple] + m->tuple_size[tuple]; i++)
    if (m->tuple_objtype[i] == mjOBJ_JOINT && m->tuple_objid[i] == joint)
      *out = (runner_rider){.moves = !by_himself,
                            .works = true,
                            .qpos = m->jnt_qposadr[joint],
                            .dof = m->jnt_dofadr[joint],
                            .userdata = (int)m->tuple_objprm[i],
                            .work = work};
}

bool runner_find_map(runner_map *map, const mjModel *m, mjcf_error *error) {
  *map = (runner_map){0};
  runner_wheel *rear = &map->wheel[RUNNER_REAR], *front = &map->wheel[RUNNER_FRONT];
  int fork;
  if (!find_body(&map->frame, m, "rear_frame", 0, error) ||
      !find_body(&rear->body, m, "rear_wheel", map->frame, error) ||
      !find_body(&fork, m, "front_frame", map->frame, error) ||
      !find_body(&front->body, m, "front_wheel", fork, error) || !find_root(map, m, error) ||
      !find_joint(&map->steer, m, "steer", fork, mjJNT_HINGE, error) ||
      !find_axis_joint(&rear->hinge, m, "rear_spin", rear->body, mjJNT_HINGE, 1, error) ||
      !find_axis_joint(&front->hinge, m, "front_spin", front->body, mjJNT_HINGE, 1, error))
    return false;
  if (!(m->jnt_axis[3 * map->steer.joint + 2] > 0))
    return mjcf_fail(error, "not a bicycle: the steering axis does not point upwards");
  const int spin[IMPORT_WHEELS] = {rear->hinge.joint, front->hinge.joint};
  if (!find_radii(map, m, error) || !import_check_physics(m, map->steer.joint, spin, error))
    return false;
  if (map->exact) find_rider(&map->rider, m, map->frame); // its drive is checked
  return true;
}

static runner_hinge foreign_hinge(const mjModel *m, int joint, int sign) {
  int qpos = m->jnt_qposadr[joint];
  return (runner_hinge){joint, qpos, m->jnt_dofadr[joint], sign, m->qpos0[qpos]};
}

bool runner_find_foreign_map(runner_map *map, const mjModel *m, mjcf_error *error) {
  bike_bicycle bicycle;
  import_map found;
  bool exact = mj_name2id(m, mjOBJ_TUPLE, "rolling_discs") >= 0;
  *map = (runner_map){.foreign = true, .exact = exact};
  if (!import_bicycle(&bicycle, &found, m, error)) return false;
  map->frame = found.half[IMPORT_REAR];
  for (int k = 0; k < 3; k++) {
    map->axes[3 * k] = found.forward[k];
    map->axes[3 * k + 1] = found.left[k];
    map->axes[3 * k + 2] = found.up[k];
  }
  map->steer = foreign_hinge(m, found.steer, found.steer_sign);
  for (int i = 0; i < RUNNER_WHEELS; i++) {
    runner_wheel *wheel = &map->wheel[i];
    *wheel = (runner_wheel){.body = found.wheel[i], .radius = found.radius[i]};
    wheel->hinge = foreign_hinge(m, found.spin[i], found.spin_sign[i]);
    mju_copy3(wheel->hub, found.hub[i]);
  }
  return !exact || runner_check_marker(m, error) == ROLL_OK;
}
