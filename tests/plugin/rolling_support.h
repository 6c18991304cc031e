// SPDX-License-Identifier: Apache-2.0
// What the tests of the rolling library share.
#ifndef ROLL_TESTS_ROLLING_SUPPORT_H
#define ROLL_TESTS_ROLLING_SUPPORT_H

#include "rolling.h"

#include <stdio.h>
#include <stdlib.h>

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

// The model rolling_models/NAME.
static inline mjModel *load(const char *name) {
  const char *folder = getenv("ROLL_MODELS");
  char path[1024], error[500] = "";
  snprintf(path, sizeof path, "%s/%s", folder ? folder : "rolling_models", name);
  mjModel *m = mj_loadXML(path, NULL, error, sizeof error);
  if (!m) fail_msg("%s: %s", path, error);
  return m;
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
