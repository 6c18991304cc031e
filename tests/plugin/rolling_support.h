// SPDX-License-Identifier: Apache-2.0
// What the tests of the rolling library share.
#ifndef ROLL_TESTS_ROLLING_SUPPORT_H
#define ROLL_TESTS_ROLLING_SUPPORT_H

#include "rolling.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "support/near.h"

enum { MOST_DISCS = 8 };

// The largest constraint errors of a ride.
typedef struct worst {
  mjtNum height, slip, energy; // m, m/s, relative
} worst;

// Set-up and tear-down of every group of tests.
static inline int install_rolling(void **unused) {
  (void)unused;
  roll_install();
  return 0;
}

static inline int uninstall_rolling(void **unused) {
  (void)unused;
  return roll_uninstall();
}

// The model NAME of plugin/examples or, where there is none, of rolling_models.
static inline mjModel *load(const char *name) {
  static const char *const folders[2] = {"ROLL_EXAMPLES", "ROLL_MODELS"};
  char path[1024], error[500] = "no folder";
  for (int i = 0; i < 2; i++) {
    const char *folder = getenv(folders[i]);
    snprintf(path, sizeof path, "%s/%s", folder ? folder : ".", name);
    if (access(path, R_OK) == 0) break;
  }
  mjModel *m = mj_loadXML(path, NULL, error, sizeof error);
  if (!m) fail_msg("%s: %s", path, error);
  return m;
}

// The model of a text.
static inline mjModel *load_text(const char *text) {
  int length = (int)strlen(text);
  mjVFS *files = malloc(sizeof *files); // 2 MB
  assert_non_null(files);
  mj_defaultVFS(files);
  assert_int_equal(mj_makeEmptyFileVFS(files, "model.xml", length), 0);
  memcpy(files->filedata[0], text, (size_t)length);
  char error[500] = "";
  mjModel *m = mj_loadXML("model.xml", files, error, sizeof error);
  if (!m) fail_msg("%s", error);
  mj_deleteVFS(files);
  free(files);
  return m;
}

// Data in the state of the keyframe "test".
static inline mjData *start_from_key(const mjModel *m) {
  mjData *d = mj_makeData(m);
  int key = mj_name2id(m, mjOBJ_KEY, "test");
  assert_true(key >= 0);
  mj_resetDataKeyframe(m, d, key);
  return d;
}

// Where a sensor's numbers are.
static inline const mjtNum *sensor(const mjModel *m, const mjData *d, const char *name) {
  int id = mj_name2id(m, mjOBJ_SENSOR, name);
  if (id < 0) fail_msg("no sensor %s", name);
  return d->sensordata + m->sensor_adr[id];
}

static inline mjtNum energy(const mjData *d) {
  return d->energy[0] + d->energy[1];
}

// Takes `steps` steps; the errors are looked up every tenth.
static inline worst ride(const mjModel *m, mjData *d, int steps) {
  worst w = {0, 0, 0};
  roll_disc disc[MOST_DISCS];
  mj_forward(m, d);
  mjtNum start = energy(d), time = d->time;
  for (int step = 1; step <= steps; step++) {
    mj_step(m, d);
    assert_true(d->time > time); // MuJoCo resets the state where it finds a NaN
    time = d->time;
    if (step % 10) continue;
    mj_forward(m, d);
    assert_int_equal(roll_discs(disc, roll_disc_count(m), m, d), ROLL_OK);
    for (int i = 0; i < roll_disc_count(m); i++) {
      w.height = fmax(w.height, fabs(disc[i].height));
      w.slip = fmax(w.slip, mju_norm3(disc[i].slip));
    }
    w.energy = fmax(w.energy, fabs(energy(d) / start - 1));
  }
  return w;
}

#endif
