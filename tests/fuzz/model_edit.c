// SPDX-License-Identifier: Apache-2.0
#include "model_edit.h"

#include <math.h>
#include <string.h>

// An array of the model: `count` items of `width` numbers each.
typedef struct numbers {
  mjtNum *first;
  int count, width;
  enum { FREE, UNIT, NOT_NEGATIVE } rule; // UNIT: each item is a direction or a quaternion
} numbers;

static numbers pick_numbers(mjModel *m, fuzz_bytes *bytes) {
  const numbers all[] = {
      {m->body_pos, m->nbody, 3, FREE},
      {m->body_quat, m->nbody, 4, UNIT},
      {m->body_ipos, m->nbody, 3, FREE},
      {m->body_iquat, m->nbody, 4, UNIT},
      {m->body_mass, m->nbody, 1, NOT_NEGATIVE},
      {m->body_inertia, m->nbody, 3, NOT_NEGATIVE},
      {m->jnt_pos, m->njnt, 3, FREE},
      {m->jnt_axis, m->njnt, 3, UNIT},
      {m->jnt_stiffness, m->njnt, 1, NOT_NEGATIVE},
      {m->jnt_range, m->njnt, 2, FREE},
      {m->qpos_spring, m->nq, 1, FREE},
      {m->dof_armature, m->nv, 1, NOT_NEGATIVE},
      {m->dof_damping, m->nv, 1, NOT_NEGATIVE},
      {m->dof_frictionloss, m->nv, 1, NOT_NEGATIVE},
      {m->geom_pos, m->ngeom, 3, FREE},
      {m->geom_quat, m->ngeom, 4, UNIT},
      {m->geom_size, m->ngeom, 3, NOT_NEGATIVE},
      {m->site_pos, m->nsite, 3, FREE},
      {m->tendon_stiffness, m->ntendon, 1, NOT_NEGATIVE},
      {m->tendon_damping, m->ntendon, 1, NOT_NEGATIVE},
      {m->tendon_lengthspring, m->ntendon, 1, FREE},
      {m->actuator_gainprm, m->nu, mjNGAIN, FREE},
      {m->actuator_biasprm, m->nu, mjNBIAS, FREE},
      {m->actuator_gear, m->nu, 6, FREE},
      {m->numeric_data, m->nnumericdata, 1, FREE},
      {m->tuple_objprm, m->ntupledata, 1, FREE},
      {m->opt.gravity, 1, 3, FREE},
      {m->opt.wind, 1, 3, FREE},
      {&m->opt.density, 1, 1, NOT_NEGATIVE},
      {&m->opt.viscosity, 1, 1, NOT_NEGATIVE},
  };
  return all[fuzz_below(bytes, sizeof all / sizeof *all)];
}

static double changed(double old, fuzz_bytes *bytes) {
  switch (fuzz_below(bytes, 8)) {
  case 0:
    return 0;
  case 1:
    return -old;
  case 2:
    return old + 1e-7;
  case 3:
    return old * (1 + 1e-3);
  case 4:
    return old * 10;
  case 5:
    return old * 0.1;
  default:
    return fuzz_number(bytes);
  }
}

static void normalise(mjtNum *item, int width) {
  double size = mju_norm(item, width);
  if (!isfinite(size) || size < 1e-6 || size > 1e6) {
    mju_zero(item, width);
    item[0] = size = 1;
  }
  mju_scl(item, item, 1 / size, width);
}

static bool edit_number(mjModel *m, fuzz_bytes *bytes) {
  numbers n = pick_numbers(m, bytes);
  if (n.count == 0) return true;
  int index = (int)fuzz_below(bytes, (unsigned)n.count),
      place = (int)fuzz_below(bytes, (unsigned)n.width);
  mjtNum *item = n.first + n.width * index;
  item[place] = changed(item[place], bytes);
  if (n.rule == NOT_NEGATIVE) item[place] = fabs(item[place]);
  if (n.rule == UNIT) normalise(item, n.width);
  return isfinite(item[place]) && fabs(item[place]) < 1e9 &&
         (item[place] == 0 || fabs(item[place]) > 1e-12);
}

// What the compiler noted as short cuts: taken back, so that changed numbers count.
static void forget_short_cuts(mjModel *m) {
  memset(m->body_sameframe, 0, (size_t)m->nbody);
  memset(m->body_simple, 0, (size_t)m->nbody);
  memset(m->geom_sameframe, 0, (size_t)m->ngeom);
  memset(m->site_sameframe, 0, (size_t)m->nsite);
  memset(m->dof_simplenum, 0, (size_t)m->nv * sizeof(int));
}

static void flip(mjtByte *flags, int count, fuzz_bytes *bytes) {
  if (count > 0) flags[fuzz_below(bytes, (unsigned)count)] ^= 1;
}

static void set(int *values, int count, int limit, fuzz_bytes *bytes) {
  if (count == 0) return;
  int index = (int)fuzz_below(bytes, (unsigned)count);
  values[index] = (int)fuzz_below(bytes, (unsigned)limit);
}

static void swap_joint(mjModel *m, fuzz_bytes *bytes) {
  int j = (int)fuzz_below(bytes, (unsigned)m->njnt);
  if (m->jnt_type[j] == mjJNT_HINGE)
    m->jnt_type[j] = mjJNT_SLIDE;
  else if (m->jnt_type[j] == mjJNT_SLIDE)
    m->jnt_type[j] = mjJNT_HINGE;
}

static void edit_kind(mjModel *m, fuzz_bytes *bytes) {
  static const int shapes[] = {mjGEOM_SPHERE, mjGEOM_CAPSULE, mjGEOM_ELLIPSOID, mjGEOM_CYLINDER,
                               mjGEOM_BOX};
  switch (fuzz_below(bytes, 9)) {
  case 0:
    swap_joint(m, bytes);
    break;
  case 1:
    flip(m->jnt_limited, m->njnt, bytes);
    break;
  case 2:
    m->opt.disableflags ^= 1 << fuzz_below(bytes, mjNDISABLE);
    break;
  case 3:
    m->opt.enableflags ^= 1 << fuzz_below(bytes, mjNENABLE);
    break;
  case 4:
    set(m->actuator_biastype, m->nu, mjBIAS_MUSCLE, bytes);
    break;
  case 5:
    set(m->actuator_gaintype, m->nu, mjGAIN_MUSCLE, bytes);
    break;
  case 6:
    set(m->geom_contype, m->ngeom, 2, bytes);
    break;
  case 7:
    flip(m->tendon_limited, m->ntendon, bytes);
    break;
  default:
    if (m->ngeom > 1) {
      int g = 1 + (int)fuzz_below(bytes, (unsigned)m->ngeom - 1);
      if (m->geom_dataid[g] < 0) m->geom_type[g] = shapes[fuzz_below(bytes, 5)];
    }
  }
}

bool model_edit(mjModel *m, fuzz_bytes *bytes) {
  forget_short_cuts(m);
  if (fuzz_below(bytes, 4) > 0) return edit_number(m, bytes);
  edit_kind(m, bytes);
  return true;
}
