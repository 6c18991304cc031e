// SPDX-License-Identifier: Apache-2.0
// Driven joints: the prescribed motion w(t) of one slide or hinge.
#include "rolling_internal.h"

#include <math.h>
#include <string.h>

// JOINT of a numeric "driven:JOINT"; NULL of any other.
static const char *joint_of(const mjModel *m, int numeric) {
  static const char prefix[] = "driven:";
  const char *name = m->names + m->name_numericadr[numeric];
  return strncmp(name, prefix, sizeof prefix - 1) == 0 ? name + sizeof prefix - 1 : NULL;
}

// Id of the numeric "driven:JOINT"; -1 without.
static int find_numeric(const mjModel *m, const char *joint) {
  for (int i = 0; i < m->nnumeric; i++) {
    const char *name = joint_of(m, i);
    if (name && strcmp(name, joint) == 0) return i;
  }
  return -1;
}

static int all_finite(const mjtNum *x, int n) {
  for (int i = 0; i < n; i++)
    if (!isfinite(x[i])) return 0;
  return 1;
}

static roll_error check_source(const mjModel *m, int numeric, mjtNum prm) {
  if (numeric >= 0) {
    int size = m->numeric_size[numeric];
    int fits = size % 3 == 1 && all_finite(m->numeric_data + m->numeric_adr[numeric], size);
    return fits ? ROLL_OK : ROLL_BAD_DRIVE;
  }
  int fits = prm >= 0 && prm + 3 <= m->nuserdata && prm == floor(prm);
  return fits ? ROLL_OK : ROLL_BAD_DRIVE;
}

// Also gives the numeric that holds the motion, -1 if it is in userdata.
static roll_error check(int *numeric, const mjModel *m, int address) {
  int joint = m->tuple_objid[address];
  if (m->tuple_objtype[address] != mjOBJ_JOINT) return ROLL_BAD_JOINT;
  if (m->jnt_type[joint] != mjJNT_SLIDE && m->jnt_type[joint] != mjJNT_HINGE) return ROLL_BAD_JOINT;
  *numeric = find_numeric(m, roll_element_name(m, address));
  return check_source(m, *numeric, m->tuple_objprm[address]);
}

roll_error roll_check_drive(const mjModel *m, int address) {
  int numeric;
  return check(&numeric, m, address);
}

roll_error roll_check_motions(roll_object *where, const mjModel *m) {
  for (int i = 0; i < m->nnumeric; i++) {
    const char *joint = joint_of(m, i);
    if (!joint || roll_find_drive(m, joint, (int)strlen(joint)) >= 0) continue;
    *where = (roll_object){mjOBJ_NUMERIC, i};
    return ROLL_NOT_DRIVEN;
  }
  return ROLL_OK;
}

// w = offset + sum a sin(omega t + phase)
static void sum_sines(mjtNum w[3], const mjtNum *data, int size, mjtNum time) {
  w[0] = data[0], w[1] = w[2] = 0;
  for (int i = 1; i < size; i += 3) {
    mjtNum a = data[i], omega = data[i + 1], angle = omega * time + data[i + 2];
    w[0] += a * sin(angle);
    w[1] += a * omega * cos(angle);
    w[2] -= a * omega * omega * sin(angle);
  }
}

roll_error roll_read_motion(roll_motion *motion, const mjModel *m, const mjData *d) {
  int numeric, joint = m->tuple_objid[motion->address];
  roll_error error = check(&numeric, m, motion->address);
  if (error) return error;
  motion->joint = joint;
  motion->dof = m->jnt_dofadr[joint];
  if (numeric >= 0) {
    const mjtNum *data = m->numeric_data + m->numeric_adr[numeric];
    sum_sines(motion->wanted, data, m->numeric_size[numeric], d->time);
  } else {
    mju_copy3(motion->wanted, d->userdata + (int)m->tuple_objprm[motion->address]);
  }
  motion->off = d->qpos[m->jnt_qposadr[joint]] - motion->wanted[0];
  return ROLL_OK;
}
