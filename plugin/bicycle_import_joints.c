// SPDX-License-Identifier: Apache-2.0
// Which joint is what: from how bodies hang on each other alone.
#include "bicycle_import_internal.h"

#include <stdio.h>
#include <string.h>

static const char *type_name(int type) {
  static const char *const names[] = {"free", "ball", "slide", "hinge"};
  return names[type];
}

// "hinge 'a', slide 'b', ..." of the model, as far as it fits.
static void list_joints(char *out, size_t size, const mjModel *m) {
  size_t used = 0;
  snprintf(out, size, "no joint at all");
  for (int j = 0; j < m->njnt && used + 80 < size; j++) {
    char name[64];
    used += (size_t)snprintf(out + used, size - used, "%s%s %s", j ? ", " : "",
                             type_name(m->jnt_type[j]), import_joint_name(name, m, j));
  }
}

// The text every refusal has: what was looked for, what is missing, what there is.
static bool refuse(const import_view *v, const char *missing, mjcf_error *error) {
  char joints[240];
  list_joints(joints, sizeof joints, v->m);
  return mjcf_fail(
      error,
      "not a bicycle: looked for two wheel hinges, a steer hinge between what they are "
      "on, and a root with six freedoms; %s; found: %s",
      missing, joints);
}

static int parent_of(const import_view *v, int assembly) {
  return v->assembly[v->m->body_parentid[assembly]];
}

static bool has_children(const import_view *v, int assembly) {
  for (int b = 1; b < v->m->nbody; b++)
    if (v->m->body_jntnum[b] > 0 && parent_of(v, b) == assembly) return true;
  return false;
}

// The joint of an assembly that has one hinge and nothing else, or -1.
static int only_hinge(const import_view *v, int assembly) {
  int joint = v->m->body_jntadr[assembly];
  bool one = v->m->body_jntnum[assembly] == 1 && v->m->jnt_type[joint] == mjJNT_HINGE;
  return one ? joint : -1;
}

// Assemblies on which nothing moves.
static int find_leaves(int leaf[IMPORT_WHEELS], const import_view *v) {
  int count = 0;
  for (int b = 1; b < v->m->nbody; b++) {
    if (v->m->body_jntnum[b] == 0 || has_children(v, b)) continue;
    if (count < IMPORT_WHEELS) leaf[count] = b;
    count++;
  }
  return count;
}

static int freedoms(const mjModel *m, int assembly) {
  return m->body_dofnum[assembly];
}

// From the world to `top`: six freedoms, and no mass on the way.
static bool check_root(const import_view *v, mjcf_error *error) {
  const mjModel *m = v->m;
  int count = 0;
  char missing[96], name[64];
  for (int a = v->map.top; a != 0; a = parent_of(v, a)) {
    count += freedoms(m, a);
    if (a == v->map.top) continue;
    for (int b = 1; b < m->nbody; b++)
      // MuJoCo demands some mass of a body that moves: what people give it then is not meant.
      if (v->assembly[b] == a && m->body_mass[b] > IMPORT_TOLERANCE * m->body_subtreemass[0])
        return mjcf_fail(error, "not a bicycle: body %s, between the world and the frame, has mass",
                         import_body_name(name, m, b));
  }
  if (count == 6 && m->nv == 9) return true;
  snprintf(missing, sizeof missing, "the root has %d freedom%s and the model %d", count,
           count == 1 ? "" : "s", m->nv);
  return refuse(v, missing, error);
}

bool import_find_joints(import_view *v, mjcf_error *error) {
  int leaf[IMPORT_WHEELS] = {0}, count = find_leaves(leaf, v);
  char missing[96];
  if (count != IMPORT_WHEELS) {
    snprintf(missing, sizeof missing, "%d bodies turn with nothing on them", count);
    return refuse(v, missing, error);
  }
  for (int i = 0; i < IMPORT_WHEELS; i++) {
    v->map.spin[i] = only_hinge(v, leaf[i]);
    if (v->map.spin[i] < 0) return refuse(v, "a wheel is not on a single hinge", error);
    v->map.wheel[i] = leaf[i];
    v->map.half[i] = parent_of(v, leaf[i]);
  }
  // One half hangs on the other.
  int *half = v->map.half;
  if (half[0] == half[1]) return refuse(v, "both wheels are on the same body", error);
  int lower = parent_of(v, half[0]) == half[1] ? 0 : parent_of(v, half[1]) == half[0] ? 1 : -1;
  if (lower < 0 || half[1 - lower] == 0)
    return refuse(v, "the wheels' bodies are not joined directly", error);
  v->map.steer = only_hinge(v, half[lower]);
  if (v->map.steer < 0) return refuse(v, "the wheels' bodies are not joined by one hinge", error);
  v->map.top = half[1 - lower];
  return check_root(v, error);
}
