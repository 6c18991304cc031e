// SPDX-License-Identifier: Apache-2.0
// libmujoco_rolling.so: loading it (linked, dlopen, LD_PRELOAD) installs the callbacks.
//
// For programs that start every model at rest (mujoco-simulate), the environment variable
// ROLL_KEYFRAME names a keyframe to start from instead. Only on demand: rest is a state like any
// other, and a library cannot know that it is not meant.
#include "rolling.h"

#include <stdlib.h>

// Set while the library is loaded, read-only after.
static const char *keyframe;
static mjfGeneric previous_control;

static int are_equal(const mjtNum *a, const mjtNum *b, int n) {
  for (int i = 0; i < n; i++)
    if (a[i] != b[i]) return 0;
  return 1;
}

// As mj_resetData leaves it.
static int is_fresh(const mjModel *m, const mjData *d) {
  return d->time == 0 && are_equal(d->qpos, m->qpos0, m->nq) && mju_isZero(d->qvel, m->nv);
}

// Puts the keyframe in place of the fresh state and computes what mj_forward had computed so far.
// mj_resetDataKeyframe would free the stack that a caller of mj_forward may hold.
static void start_from_keyframe(const mjModel *m, mjData *d) {
  int key = is_fresh(m, d) ? mj_name2id(m, mjOBJ_KEY, keyframe) : -1;
  if (key >= 0) {
    mju_copy(d->qpos, m->key_qpos + key * m->nq, m->nq);
    mju_copy(d->qvel, m->key_qvel + key * m->nv, m->nv);
    mju_copy(d->act, m->key_act + key * m->na, m->na);
    mju_copy(d->ctrl, m->key_ctrl + key * m->nu, m->nu);
    d->time = m->key_time[key];
    if (!is_fresh(m, d)) mj_forwardSkip(m, d, mjSTAGE_NONE, 1); // comes here again
  }
  if (previous_control) previous_control(m, d);
}

__attribute__((constructor)) static void install(void) {
  keyframe = getenv("ROLL_KEYFRAME");
  if (keyframe && *keyframe) {
    previous_control = mjcb_control;
    mjcb_control = start_from_keyframe;
  }
  roll_install();
}

__attribute__((destructor)) static void uninstall(void) {
  (void)roll_uninstall(); // a host that has taken mjcb_control keeps it
  if (mjcb_control == start_from_keyframe) mjcb_control = previous_control;
}
