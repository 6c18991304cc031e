// SPDX-License-Identifier: Apache-2.0
// What a model asks of MuJoCo that the equations of the bicycle lack. They have gravity along -z,
// masses, wheels that roll, a damper on the steer, and inputs; whatever else acts on a bicycle that
// is left alone is refused by name.
#include "bicycle_import_internal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

static bool refuse(mjcf_error *error, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool refuse(mjcf_error *error, const char *format, ...) {
  char what[320];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(what, sizeof what, format, arguments);
  va_end(arguments);
  return mjcf_fail(error, "not a bicycle of these equations: %s", what);
}

static bool is_off(const mjModel *m, int flags) {
  return (m->opt.disableflags & flags) != 0;
}

static bool excludes_zero(const mjtNum range[2]) {
  return range[0] > 0 || range[1] < 0;
}

// Of the flags, `gravity` and `passive` switch off what the equations have; `constraint` and
// `contact` what keeps wheels on the ground, unless a marker does. `equality`, `frictionloss`,
// `limit` and `actuation` switch off what is refused or reported where it is on. The others, and
// those that enable something, touch contacts, control, solver, sensors and bookkeeping alone.
static bool check_flags(const mjModel *m, mjcf_error *error) {
  if (is_off(m, mjDSBL_GRAVITY)) return refuse(error, "gravity is switched off (flag gravity)");
  if (is_off(m, mjDSBL_PASSIVE))
    return refuse(error, "passive forces, such as the steer's damping, are switched off (flag "
                         "passive)");
  if (mj_name2id(m, mjOBJ_TUPLE, "rolling_discs") >= 0) return true;
  const char *flag = is_off(m, mjDSBL_CONSTRAINT) ? "constraint"
                     : is_off(m, mjDSBL_CONTACT)  ? "contact"
                                                  : NULL;
  return !flag || refuse(error,
                         "constraints that keep the wheels on the ground are switched off (flag "
                         "%s), and no marker rolling_discs makes them roll",
                         flag);
}

static bool check_gravity(const mjModel *m, mjcf_error *error) {
  const double *g = m->opt.gravity;
  if (g[2] < 0 && hypot(g[0], g[1]) <= IMPORT_TOLERANCE * fabs(g[2])) return true;
  return refuse(error, "gravity (%g, %g, %g) must point along -z, to the ground z = 0", g[0], g[1],
                g[2]);
}

static bool check_medium(const mjModel *m, mjcf_error *error) {
  const double *wind = m->opt.wind;
  if (m->opt.density != 0)
    return refuse(error, "it rides in a medium of density %g", m->opt.density);
  if (m->opt.viscosity != 0)
    return refuse(error, "it rides in a medium of viscosity %g", m->opt.viscosity);
  if (mju_norm3(wind) != 0)
    return refuse(error, "wind (%g, %g, %g) blows", wind[0], wind[1], wind[2]);
  return true;
}

static bool check_joints(const mjModel *m, int steer, mjcf_error *error) {
  char name[64];
  for (int j = 0; j < m->njnt; j++)
    if (m->jnt_stiffness[j] != 0)
      return refuse(error, "joint %s has stiffness (a spring)", import_joint_name(name, m, j));
  for (int i = 0; i < m->nv; i++) {
    int joint = m->dof_jntid[i];
    const char *what = m->dof_armature[i] != 0 ? "armature"
                       : m->dof_frictionloss[i] != 0 && !is_off(m, mjDSBL_FRICTIONLOSS)
                           ? "frictionloss"
                       : m->dof_damping[i] != 0 && joint != steer ? "damping"
                                                                  : NULL;
    if (what)
      return refuse(error, "joint %s has %s; only the steer may have damping",
                    import_joint_name(name, m, joint), what);
  }
  return true;
}

static bool check_tendons(const mjModel *m, mjcf_error *error) {
  char name[64];
  for (int i = 0; i < m->ntendon; i++) {
    const char *what = m->tendon_stiffness[i] != 0 ? "stiffness"
                       : m->tendon_damping[i] != 0 ? "damping"
                       : m->tendon_frictionloss[i] != 0 && !is_off(m, mjDSBL_FRICTIONLOSS)
                           ? "frictionloss"
                           : NULL;
    if (what)
      return refuse(error, "tendon %s has %s",
                    import_name(name, m->names + m->name_tendonadr[i], i), what);
  }
  return true;
}

// Why an actuator exerts a force, or may, while its control is zero; NULL: it does not.
static const char *acts_at_zero(const mjModel *m, int actuator) {
  const mjtNum *bias = m->actuator_biasprm + (size_t)mjNBIAS * (size_t)actuator;
  const mjtNum *gain = m->actuator_gainprm + (size_t)mjNGAIN * (size_t)actuator;
  int type = m->actuator_biastype[actuator];
  if (type == mjBIAS_AFFINE && (bias[0] != 0 || bias[1] != 0 || bias[2] != 0))
    return "biasprm, as that of a position or velocity servo";
  if (type == mjBIAS_MUSCLE) return "a muscle's passive force";
  if (type == mjBIAS_USER) return "a bias of the program's";
  if (m->actuator_forcelimited[actuator] && excludes_zero(m->actuator_forcerange + 2 * actuator))
    return "a forcerange without zero";
  // Force = gain * (control or activation), and an activation begins at zero.
  if (m->actuator_gaintype[actuator] == mjGAIN_FIXED && gain[0] == 0) return NULL;
  if (m->actuator_dyntype[actuator] == mjDYN_USER) return "an activation of the program's";
  if (m->actuator_ctrllimited[actuator] && !is_off(m, mjDSBL_CLAMPCTRL) &&
      excludes_zero(m->actuator_ctrlrange + 2 * actuator))
    return "a ctrlrange without zero";
  if (m->actuator_actlimited[actuator] && excludes_zero(m->actuator_actrange + 2 * actuator))
    return "an actrange without zero";
  return NULL;
}

static bool check_actuators(const mjModel *m, mjcf_error *error) {
  char name[64];
  for (int i = 0; i < m->nu && !is_off(m, mjDSBL_ACTUATION); i++) {
    const char *why = acts_at_zero(m, i);
    if (why)
      return refuse(error, "actuator %s acts while its control is zero: it has %s",
                    import_name(name, m->names + m->name_actuatoradr[i], i), why);
  }
  return true;
}

static bool is_limited(const mjModel *m, int joint) {
  return m->jnt_limited[joint] && !is_off(m, mjDSBL_LIMIT | mjDSBL_CONSTRAINT);
}

// Stops of steer and root are outside the equations, but a ride need not reach them.
static bool check_stops(const mjModel *m, int steer, const int spin[IMPORT_WHEELS],
                        mjcf_error *error) {
  char name[64];
  for (int i = 0; i < IMPORT_WHEELS; i++)
    if (is_limited(m, spin[i]))
      return refuse(error, "the hinge %s of a wheel is limited: it cannot roll on",
                    import_joint_name(name, m, spin[i]));
  const mjtNum *range = m->jnt_range + 2 * steer;
  double straight = m->qpos0[m->jnt_qposadr[steer]], margin = m->jnt_margin[steer];
  if (!is_limited(m, steer) || (straight - range[0] > margin && range[1] - straight > margin))
    return true;
  return refuse(error, "straight ahead the steer, joint %s, is at a stop of its range (%g to %g)",
                import_joint_name(name, m, steer), range[0], range[1]);
}

bool import_check_physics(const mjModel *m, int steer, const int spin[IMPORT_WHEELS],
                          mjcf_error *error) {
  if (m->neq > 0 && !is_off(m, mjDSBL_EQUALITY | mjDSBL_CONSTRAINT))
    return refuse(error, "it has %d equality constraint%s", m->neq, m->neq == 1 ? "" : "s");
  return check_flags(m, error) && check_gravity(m, error) && check_medium(m, error) &&
         check_joints(m, steer, error) && check_tendons(m, error) && check_actuators(m, error) &&
         check_stops(m, steer, spin, error);
}

bool import_stops(char *out, size_t size, const mjModel *m) {
  size_t used = 0;
  char name[64];
  *out = '\0';
  for (int j = 0; j < m->njnt && used < size; j++) {
    if (!is_limited(m, j)) continue;
    const mjtNum *range = m->jnt_range + 2 * j;
    used += (size_t)snprintf(out + used, size - used, "%sjoint %s at %.6g and %.6g %s",
                             used ? ", " : "", import_joint_name(name, m, j), range[0], range[1],
                             m->jnt_type[j] == mjJNT_SLIDE ? "m" : "rad");
  }
  for (int i = 0; i < m->ntendon && used < size; i++) {
    if (!m->tendon_limited[i] || is_off(m, mjDSBL_LIMIT | mjDSBL_CONSTRAINT)) continue;
    const mjtNum *range = m->tendon_range + 2 * i;
    used +=
        (size_t)snprintf(out + used, size - used, "%stendon %s at %.6g and %.6g", used ? ", " : "",
                         import_name(name, m->names + m->name_tendonadr[i], i), range[0], range[1]);
  }
  return used > 0;
}
