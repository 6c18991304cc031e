// SPDX-License-Identifier: Apache-2.0
// libmujoco_rolling.so as a host sees it that knows nothing of it: loading is all.
// Without roll_ functions of its own, so that none can stand in for the library's.
#include <dlfcn.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/near.h"

typedef struct fixture {
  mjModel *m;
  mjData *d;
} fixture;

static int load(void **state) {
  static fixture f;
  char path[1024], error[500] = "";
  snprintf(path, sizeof path, "%s/bicycle.xml", getenv("ROLL_EXAMPLES"));
  f.m = mj_loadXML(path, NULL, error, sizeof error);
  if (!f.m) return -1;
  f.d = mj_makeData(f.m);
  *state = &f;
  return 0;
}

static int unload(void **state) {
  fixture *f = *state;
  mj_deleteData(f->d);
  mj_deleteModel(f->m);
  return 0;
}

// At rest and upright the bicycle falls freely unless its wheels stand on the ground.
static void test_loading_installs(void **state) {
  fixture *f = *state;
  mj_forward(f->m, f->d);
  assert_near(f->d->qacc[2], -9.81, 1e-12);

  void *library = dlopen(getenv("ROLL_LIBRARY"), RTLD_NOW | RTLD_LOCAL);
  if (!library) fail_msg("%s", dlerror());
  assert_non_null(mjcb_control);
  mj_forward(f->m, f->d);
  assert_near(f->d->qacc[2], 0, 1e-10);

  assert_int_equal(dlclose(library), 0);
  assert_null(mjcb_control);
  mj_forward(f->m, f->d);
  assert_near(f->d->qacc[2], -9.81, 1e-12);
}

static void test_only_roll_symbols(void **state) {
  (void)state;
  void *library = dlopen(getenv("ROLL_LIBRARY"), RTLD_NOW | RTLD_LOCAL);
  assert_non_null(library);
  assert_non_null(dlsym(library, "roll_discs"));
  assert_null(dlsym(library, "roll_build_system"));
  assert_int_equal(dlclose(library), 0);
}

// With ROLL_KEYFRAME a fresh state starts from that keyframe, as if it had been loaded by hand; a
// state of its own is left alone.
static void test_start_from_keyframe(void **state) {
  fixture *f = *state;
  mjData *by_hand = mj_makeData(f->m), *own = mj_makeData(f->m);
  mj_resetDataKeyframe(f->m, by_hand, mj_name2id(f->m, mjOBJ_KEY, "test"));
  own->qvel[0] = 1;
  assert_int_equal(setenv("ROLL_KEYFRAME", "test", 1), 0);
  void *library = dlopen(getenv("ROLL_LIBRARY"), RTLD_NOW | RTLD_LOCAL);
  assert_int_equal(unsetenv("ROLL_KEYFRAME"), 0);
  assert_non_null(library);
  mj_resetData(f->m, f->d);
  mj_step(f->m, f->d);
  mj_step(f->m, by_hand);
  mj_step(f->m, own);
  for (int i = 0; i < f->m->nv; i++) assert_near(f->d->qvel[i], by_hand->qvel[i], 1e-12);
  assert_true(f->d->qvel[0] > 4.9);
  assert_true(own->qvel[0] < 1.1);
  assert_int_equal(dlclose(library), 0);
  assert_null(mjcb_control);
  mj_deleteData(own);
  mj_deleteData(by_hand);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_loading_installs),
      cmocka_unit_test(test_only_roll_symbols),
      cmocka_unit_test(test_start_from_keyframe),
  };
  return cmocka_run_group_tests(tests, load, unload);
}
